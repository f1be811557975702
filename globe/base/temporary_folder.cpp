#include "globe/base/temporary_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <system_error>

namespace globe {

TemporaryFolder::TemporaryFolder(std::string_view name) {
  std::string path = (std::filesystem::temp_directory_path() / name).string() + "-XXXXXX";
  if (::mkdtemp(path.data()) == nullptr) throw std::system_error(errno, std::generic_category(), path);
  path_ = path;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace globe
