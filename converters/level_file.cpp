#include "converters/level_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "globe/base/error.h"
#include "globe/planet/grid.h"

namespace converters {

LevelFile::LevelFile(const std::filesystem::path& path, int level, int channels)
    : path_(path),
      side_(static_cast<std::size_t>(globe::planet::nodes_per_side(level)) + 1),
      channels_(static_cast<std::size_t>(channels)),
      descriptor_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  const auto bytes = static_cast<off_t>(globe::planet::kDiamonds * side_ * side_ * channels_ * sizeof(float));
  if (descriptor_ < 0 || ::ftruncate(descriptor_, bytes) != 0) fail();
}

LevelFile::~LevelFile() { ::close(descriptor_); }

void LevelFile::write(int d, int i, int j, int count, const float* values) const {
  const std::size_t node = (static_cast<std::size_t>(d) * side_ + static_cast<std::size_t>(j)) * side_ +
                           static_cast<std::size_t>(i);
  auto offset = static_cast<off_t>(node * channels_ * sizeof(float));
  auto left = static_cast<std::size_t>(count) * channels_ * sizeof(float);
  const auto* from = reinterpret_cast<const std::byte*>(values);
  while (left > 0) {
    const ssize_t done = ::pwrite(descriptor_, from, left, offset);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) fail();
    from += done;
    offset += done;
    left -= static_cast<std::size_t>(done);
  }
}

void LevelFile::sync() const {
  if (::fdatasync(descriptor_) != 0) fail();
}

void LevelFile::fail() const {
  throw globe::Error(path_.string(), std::string("cannot be written (") + std::strerror(errno) + ")",
                     "free some disk, then the same command goes on");
}

}  // namespace converters
