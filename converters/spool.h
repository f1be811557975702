#pragma once

#include <cstddef>
#include <filesystem>

namespace converters {

/// Where a map's decoded samples may go, so that other processes, and the next one after an interruption,
/// need not decode it again.
struct Spool {
  std::filesystem::path file;  ///< "": nowhere
  bool always = false;         ///< also when memory has room for them

  std::filesystem::path lock() const { return file.string() + ".lock"; }
  /// What is known of the voids, beside the samples.
  std::filesystem::path voids() const { return file.string() + ".voids"; }
  /// The samples while they are being written.
  std::filesystem::path temporary() const { return file.string() + ".partial"; }
};

}  // namespace converters
