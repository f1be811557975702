#pragma once

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>

namespace hard {

/// Reports one row of the table of hard cases: `HARD | id | quantity | threshold | seen` on standard output,
/// and at the end of the file $GLOBE_HARD_TABLE when it is set.
inline void report(const std::string& id, const std::string& quantity, const std::string& threshold,
                   const std::string& seen) {
  const std::string row = "HARD | " + id + " | " + quantity + " | " + threshold + " | " + seen + "\n";
  std::fputs(row.c_str(), stdout);
  const char* path = std::getenv("GLOBE_HARD_TABLE");
  if (path == nullptr || *path == '\0') return;
  if (const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path, "a"), &std::fclose); file) {
    std::fputs(row.c_str(), file.get());
  }
}

}  // namespace hard
