#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "globe/base/temporary_folder.h"

namespace tests {

/// A fresh folder that goes away with the object.
class TemporaryFolder : public globe::TemporaryFolder {
 public:
  TemporaryFolder() : globe::TemporaryFolder("globe-test") {}

  /// Everything in it, hidden names too, as paths from here.
  std::set<std::string> contents() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path()))
      names.insert(std::filesystem::relative(entry.path(), path()).string());
    return names;
  }
};

/// All of a file.
inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace tests
