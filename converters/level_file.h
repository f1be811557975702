#pragma once

#include <cstddef>
#include <filesystem>

namespace converters {

/// Floats at every node of one level in a file, laid out like a NodeGrid<float>, written piece by piece by
/// any number of processes.
class LevelFile {
 public:
  /// Opens the file, making it when it is missing. Throws globe::Error when that fails.
  LevelFile(const std::filesystem::path& path, int level, int channels);
  ~LevelFile();
  LevelFile(const LevelFile&) = delete;
  LevelFile& operator=(const LevelFile&) = delete;

  /// Nodes i .. i+count-1 of row j of diamond d. Throws globe::Error when the disk has no room.
  void write(int d, int i, int j, int count, const float* values) const;
  void sync() const;

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  std::size_t side_;
  std::size_t channels_;
  int descriptor_;
};

}  // namespace converters
