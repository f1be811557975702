#include "globe/base/pending_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "globe/base/error.h"

namespace globe {
namespace {

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

}  // namespace

void refuse_existing(const std::filesystem::path& path, bool overwrite) {
  if (overwrite || !std::filesystem::exists(path)) return;
  throw Error(path.string(), "it exists", "give another name or --overwrite");
}

bool flush_to_disk(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool flushed = ::fsync(file) == 0;
  ::close(file);
  return flushed;
}

PendingFile::PendingFile(std::filesystem::path final_path, bool overwrite) : final_(std::move(final_path)) {
  refuse_existing(final_, overwrite);
  const std::filesystem::path folder = folder_of(final_);
  if (!std::filesystem::is_directory(folder)) {
    throw Error(final_.string(), "there is no folder " + folder.string(), "make it or give another name");
  }
  temporary_ = folder / ("." + final_.stem().string() + "." + std::to_string(::getpid()) + ".partial" +
                         final_.extension().string());
}

PendingFile::~PendingFile() {
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void PendingFile::publish() {
  std::error_code failure;
  if (!flush_to_disk(temporary_)) failure = std::error_code(errno, std::generic_category());
  if (!failure) std::filesystem::rename(temporary_, final_, failure);
  if (failure) throw Error(final_.string(), failure.message(), "check the disk and its free space");
  temporary_.clear();
  // The new name is lost with the power until the folder is on the disk too; some file systems cannot flush
  // folders.
  static_cast<void>(flush_to_disk(folder_of(final_)));
}

}  // namespace globe
