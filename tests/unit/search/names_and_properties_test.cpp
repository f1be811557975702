#include <gtest/gtest.h>

#include "globe/search/folded_name.h"
#include "globe/search/property_test.h"

namespace globe::search {
namespace {

TEST(FoldedName, ForgetsCaseInEveryScript) {
  EXPECT_EQ(folded_name("WIEN"), folded_name("wien"));
  EXPECT_EQ(folded_name("ÖSTERREICH"), folded_name("österreich"));
  EXPECT_EQ(folded_name("O\xCC\x88sterreich"), folded_name("Österreich"));
  EXPECT_EQ(folded_name("STRASSE"), folded_name("straße"));
  EXPECT_EQ(folded_name("ΑΘΗΝΑΣ"), folded_name("αθηνας"));
  EXPECT_NE(folded_name("Wien"), folded_name("Wein"));
}

TEST(FoldedName, TakesBytesThatAreNoUtf8) { EXPECT_EQ(folded_name("a\xff"), "a\uFFFD"); }

TEST(PropertyTest, TextsAreEqualByteForByte) {
  EXPECT_TRUE(PropertyTest("a", "b").passes(R"({"a":"b"})"));
  EXPECT_FALSE(PropertyTest("a", "b").passes(R"({"a":"B"})"));
  EXPECT_FALSE(PropertyTest("a", "b").passes(R"({"b":"a"})"));
  EXPECT_FALSE(PropertyTest("a", "b").passes(""));
  EXPECT_TRUE(PropertyTest("a", "").passes(R"({"a":""})"));
}

TEST(PropertyTest, NumbersAreEqualByValue) {
  EXPECT_TRUE(PropertyTest("n", "1000").passes(R"({"n":1000})"));
  EXPECT_TRUE(PropertyTest("n", "1e3").passes(R"({"n":1000})"));
  EXPECT_TRUE(PropertyTest("n", "0.5").passes(R"({"n":0.50})"));
  EXPECT_FALSE(PropertyTest("n", "1e3").passes(R"({"n":"1000"})"));
  EXPECT_FALSE(PropertyTest("n", "9007199254740993").passes(R"({"n":9007199254740992})"));
  EXPECT_FALSE(PropertyTest("n", "x").passes(R"({"n":0})"));
}

TEST(PropertyTest, WordsOfJsonAreWords) {
  EXPECT_TRUE(PropertyTest("a", "true").passes(R"({"a":true})"));
  EXPECT_FALSE(PropertyTest("a", "1").passes(R"({"a":true})"));
  EXPECT_TRUE(PropertyTest("a", "null").passes(R"({"a":null})"));
  EXPECT_FALSE(PropertyTest("a", "[1]").passes(R"({"a":[1]})"));
}

TEST(PropertyTest, OnlyTheOutermostKeysCount) {
  EXPECT_FALSE(PropertyTest("a", "b").passes(R"({"c":{"a":"b"}})"));
  EXPECT_TRUE(PropertyTest("a", "b").passes(R"({"c":{"a":"d"},"a":"b"})"));
  EXPECT_FALSE(PropertyTest("a", "b").passes(R"({"c":"\"a\":\"b\""})"));
}

TEST(PropertyTest, QuotesAndSqlAreLettersLikeAnyOther) {
  EXPECT_TRUE(PropertyTest("a\"b'", "x' OR '1'='1").passes(R"({"a\"b'":"x' OR '1'='1"})"));
  EXPECT_TRUE(PropertyTest("k", "\"\\\n%_").passes(R"({"k":"\"\\\n%_"})"));
  EXPECT_FALSE(PropertyTest("k", "%").passes(R"({"k":"x"})"));
}

}  // namespace
}  // namespace globe::search
