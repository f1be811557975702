#include "globe/base/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace globe {

FileLock::FileLock(const std::filesystem::path& path)
    : file_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  if (file_ >= 0) ::flock(file_, LOCK_EX);
}

FileLock::~FileLock() {
  if (file_ >= 0) ::close(file_);
}

}  // namespace globe
