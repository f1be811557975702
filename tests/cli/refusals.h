#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/cli/run_program.h"

namespace cli {

/// Words after a command that it has to refuse, and the exit status it does so with.
struct Refusal {
  std::vector<std::string> words;
  int status;
};

/// Each is refused with its status, one line on standard error and nothing on standard output.
inline void expect_refusals(const std::string& command, const std::vector<Refusal>& refusals) {
  for (const Refusal& refusal : refusals) {
    std::vector<std::string> words{command};
    words.insert(words.end(), refusal.words.begin(), refusal.words.end());
    const Outcome run = run_program(words);
    EXPECT_EQ(run.status, refusal.status) << words.back() << run.err;
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err.substr(0, 7), "globe: ");
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
}

}  // namespace cli
