#pragma once

#include <gtest/gtest.h>

#include <string>

#include "globe/base/error.h"

namespace scene_tests {

/// What is done is refused by an Error of one line that begins and goes on as told.
template <class Do>
void expect_refusal(const Do& what_is_done, const std::string& begin, const std::string& part = "") {
  try {
    what_is_done();
    ADD_FAILURE() << "not refused: " << begin << " " << part;
  } catch (const globe::Error& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.substr(0, begin.size()), begin) << text;
    EXPECT_NE(text.find(part), std::string::npos) << text << "\nlacks: " << part;
    EXPECT_NE(text.find("; "), std::string::npos) << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

}  // namespace scene_tests
