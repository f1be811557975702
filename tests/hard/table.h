#pragma once

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <string>

/// What the hard cases share: one table of what was seen, and two sizes.
namespace hard {

/// True when every case is to run at the size that HARD-CASES.md states (./dev test --full).
inline bool full() { return std::getenv("GLOBE_TEST_FULL") != nullptr; }

/// Cases to run of the `stated` ones: all of them, or a seeded tenth.
inline std::size_t cases(std::size_t stated) { return full() ? stated : stated / 10; }

/// One row of the table: printed, and appended to the file that GLOBE_HARD_TABLE names, if set.
inline void report(const std::string& id, const std::string& quantity, const std::string& threshold,
                   const std::string& seen) {
  const std::string row = "HARD | " + id + " | " + quantity + " | " + threshold + " | " + seen + "\n";
  std::fputs(row.c_str(), stdout);
  const char* path = std::getenv("GLOBE_HARD_TABLE");
  if (path == nullptr) return;
  if (std::FILE* file = std::fopen(path, "a")) {
    std::fputs(row.c_str(), file);
    std::fclose(file);
  }
}

/// A number as the table shows it: three digits.
inline std::string figure(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace hard
