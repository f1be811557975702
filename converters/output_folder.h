#pragma once

#include <filesystem>

namespace converters {

/// A planet in the making: everything goes into PLANET.partial, which takes PLANET's name when it is whole.
///
/// A killed program leaves PLANET.partial behind; the next conversion to the same name clears it away. A
/// failed one (the object dies before finish) removes it.
class OutputFolder {
 public:
  /// Throws globe::Error when PLANET exists and may not be replaced (only planets ever are), when another
  /// conversion is writing it, or the folder cannot be made.
  OutputFolder(const std::filesystem::path& planet, bool overwrite);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::filesystem::path& path() const { return partial_; }

  /// Gives the folder its final name, in one step even when it replaces an older planet.
  void finish();

 private:
  std::filesystem::path planet_;
  std::filesystem::path partial_;
  int lock_ = -1;
  bool finished_ = false;
};

}  // namespace converters
