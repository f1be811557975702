#pragma once

#include <filesystem>

namespace globe {

/// A file that appears under its final name whole or not at all: it is written under temporary() and renamed
/// by publish(). Without publish() the destructor removes it.
///
/// The temporary name stands beside the final one and keeps its extension, ".NAME.PID.partial.EXT".
class PendingFile {
 public:
  /// Throws Error when the folder is missing, or the file exists and `overwrite` is false.
  PendingFile(std::filesystem::path final_path, bool overwrite);
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;
  ~PendingFile();

  const std::filesystem::path& temporary() const { return temporary_; }
  const std::filesystem::path& final_path() const { return final_; }

  /// Brings the bytes to the disk, then the final name to the file. Throws Error when either fails.
  void publish();

 private:
  std::filesystem::path final_;
  std::filesystem::path temporary_;
};

/// Throws Error, telling of --overwrite, when the path exists and `overwrite` is false.
void refuse_existing(const std::filesystem::path& path, bool overwrite);

/// fsync of a file or folder; false when it fails.
bool flush_to_disk(const std::filesystem::path& path);

}  // namespace globe
