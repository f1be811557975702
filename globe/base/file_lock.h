#pragma once

#include <filesystem>

namespace globe {

/// Holds a file's lock among processes while it lives; waits until others let go. The file is made when it is
/// missing, and stays. On a file system without locks nobody waits.
class FileLock {
 public:
  explicit FileLock(const std::filesystem::path& path);
  ~FileLock();
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;

 private:
  int file_;
};

}  // namespace globe
