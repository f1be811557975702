#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/temporary_folder.h"

namespace fuzz {

/// A folder for one run of a target, with one file in it that takes the fuzzer's bytes.
class ScratchFile {
 public:
  explicit ScratchFile(const std::string& name) : path_(folder_ / name) {}

  void write(const std::uint8_t* data, std::size_t size) const {
    std::ofstream file(path_, std::ios::binary | std::ios::trunc);
    file.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  const std::filesystem::path& folder() const { return folder_.path(); }
  const std::filesystem::path& path() const { return path_; }

 private:
  tests::TemporaryFolder folder_;
  std::filesystem::path path_;
};

}  // namespace fuzz
