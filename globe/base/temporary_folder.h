#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace globe {

/// A fresh folder, of this user alone, among the system's temporary files; goes away with the object and all
/// that is in it.
class TemporaryFolder {
 public:
  /// @param name  begins the folder's name. Throws std::system_error where none can be made.
  explicit TemporaryFolder(std::string_view name);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace globe
