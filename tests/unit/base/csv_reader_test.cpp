#include "globe/base/csv_reader.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace globe {
namespace {

using Fields = std::vector<std::string>;

std::vector<CsvRecord> read(const std::string& text) {
  std::istringstream stream(text);
  CsvReader reader(stream);
  std::vector<CsvRecord> records;
  while (auto record = reader.next()) records.push_back(std::move(*record));
  return records;
}

TEST(CsvReader, QuotedFieldsHoldCommasQuotesAndNewlines) {
  const auto records = read("a,\"b, \"\"c\"\"\nd\",e\nf,g,h\n");
  ASSERT_EQ(records.size(), 2u);
  EXPECT_EQ(records[0].fields, (Fields{"a", "b, \"c\"\nd", "e"}));
  EXPECT_EQ(records[1].fields, (Fields{"f", "g", "h"}));
  EXPECT_EQ(records[1].line, 3u);
}

TEST(CsvReader, LinesEndInEitherWayAndTheLastNeedNot) {
  for (const char* text : {"a,b\nc,d\n", "a,b\r\nc,d\r\n", "a,b\r\nc,d",
                           "\xEF\xBB\xBF\x61,b\nc,d",  // a byte order mark, then a,b
                           "\n a , b \n\n\r\nc,d\n\n"}) {
    const auto records = read(text);
    ASSERT_EQ(records.size(), 2u) << text;
    EXPECT_EQ(records[0].fields, (Fields{"a", "b"})) << text;
    EXPECT_EQ(records[1].fields, (Fields{"c", "d"})) << text;
  }
  EXPECT_EQ(read("\n\na\n")[0].line, 3u);
}

TEST(CsvReader, EmptyFieldsAreFields) {
  const auto records = read(",\n\"\",,\n");
  EXPECT_EQ(records[0].fields, (Fields{"", ""}));
  EXPECT_EQ(records[1].fields, (Fields{"", "", ""}));
}

TEST(CsvReader, EmptyFilesHaveNoRecords) {
  for (const char* text : {"", "\n", "\r\n\n", "\xEF\xBB\xBF"}) EXPECT_TRUE(read(text).empty());
}

TEST(CsvReader, AFaultCostsOneLine) {
  // Line 1 opens a quote that line 2 closes in the middle of a word.
  const auto records = read("1,\"never closed\n2,\"x\"\n3,y\"z\n4,w\n");
  ASSERT_EQ(records.size(), 4u);
  EXPECT_FALSE(records[0].fault.empty());
  EXPECT_EQ(records[0].line, 1u);
  EXPECT_EQ(records[1].fields, (Fields{"2", "x"}));
  EXPECT_EQ(records[1].line, 2u);
  EXPECT_FALSE(records[2].fault.empty());
  EXPECT_EQ(records[2].line, 3u);
  EXPECT_EQ(records[3].fields, (Fields{"4", "w"}));
  EXPECT_EQ(records[3].line, 4u);
}

TEST(CsvReader, AQuoteWithoutEndLosesOnlyItsLine) {
  const auto records = read("1,\"a\n2,b\n3,c\n");
  ASSERT_EQ(records.size(), 3u);
  EXPECT_FALSE(records[0].fault.empty());
  EXPECT_EQ(records[1].fields, (Fields{"2", "b"}));
  EXPECT_EQ(records[2].fields, (Fields{"3", "c"}));
}

TEST(CsvReader, LinesAndFieldsWithoutEndAreRefusedInBoundedMemory) {
  const std::string megabyte(CsvReader::kLongest, 'x');
  auto records = read("1," + megabyte + megabyte + "\n2,b\n");
  ASSERT_EQ(records.size(), 2u);
  EXPECT_FALSE(records[0].fault.empty());
  EXPECT_EQ(records[1].fields, (Fields{"2", "b"}));
  std::string lines = "1,\"a\n";
  while (lines.size() < 2 * CsvReader::kLongest) lines += "2,bbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbbb\n";
  records = read(lines);
  EXPECT_FALSE(records[0].fault.empty());
  EXPECT_EQ(records[1].fields[0], "2");
  EXPECT_EQ(records.back().line, records.size());
}

RC_GTEST_PROP(CsvReader, ReadsBackWhateverIsQuoted, (const std::vector<std::vector<std::string>>& written)) {
  std::string text;
  std::vector<Fields> expected;
  for (const auto& fields : written) {
    if (fields.empty()) continue;
    expected.push_back(fields);
    for (std::size_t k = 0; k < fields.size(); ++k) {
      text += k == 0 ? "\"" : ",\"";
      for (const char c : fields[k]) text += c == '"' ? std::string("\"\"") : std::string(1, c);
      text += '"';
    }
    text += '\n';
  }
  std::vector<Fields> seen;
  for (const CsvRecord& record : read(text)) seen.push_back(record.fields);
  RC_ASSERT(seen == expected);
}

}  // namespace
}  // namespace globe
