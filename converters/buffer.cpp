#include "converters/buffer.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "globe/base/error.h"

namespace converters {
namespace {

globe::Error no_room(const std::filesystem::path& where, std::size_t bytes, int failure) {
  return {where.string(),
          "no room for " + std::to_string(bytes >> 20) + " MB of scratch (" + std::strerror(failure) + ")",
          "free some disk, or give more --memory"};
}

/// Allocated now: writing to a hole of a full disk through a mapping would end the program. Takes the
/// descriptor.
std::byte* map_new_file(int file, std::size_t bytes, const std::filesystem::path& where) {
  if (file < 0) throw no_room(where, bytes, errno);
  const int failure = ::posix_fallocate(file, 0, static_cast<off_t>(bytes));
  void* data =
      failure != 0 ? MAP_FAILED : ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  const int why = failure != 0 ? failure : errno;
  ::close(file);
  if (data == MAP_FAILED) throw no_room(where, bytes, why);
  return static_cast<std::byte*>(data);
}

std::byte* map_nameless_file(std::size_t bytes, const std::filesystem::path& folder) {
  std::string name = (folder / "scratch-XXXXXX").string();
  const int file = ::mkstemp(name.data());
  if (file >= 0) ::unlink(name.c_str());
  return map_new_file(file, bytes, folder);
}

}  // namespace

Buffer::Buffer(std::size_t bytes, MemoryBudget& budget) : bytes_(bytes) {
  if (bytes == 0) return;
  if (bytes <= budget.bytes_left) {
    void* data = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (data != MAP_FAILED) {
      ::madvise(data, bytes, MADV_HUGEPAGE);  // a fault for each 4 KiB would cost more than filling them
      data_ = static_cast<std::byte*>(data);
      budget_ = &budget;
      budget.bytes_left -= bytes;
      return;
    }
  }
  data_ = map_nameless_file(bytes, budget.scratch_folder);
}

Buffer::Buffer(const std::filesystem::path& file, std::size_t bytes) : bytes_(bytes) {
  const auto refuse = [&](const std::string& why) -> globe::Error {
    return {file.string(), "cannot be read (" + why + ")", "remove its folder and convert again"};
  };
  const int descriptor = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) throw refuse(std::strerror(errno));
  struct stat status {};
  void* data = MAP_FAILED;
  std::string why = "not the size it should have";
  if (::fstat(descriptor, &status) == 0 && static_cast<std::size_t>(status.st_size) == bytes) {
    data = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    why = std::strerror(errno);
  }
  ::close(descriptor);
  if (data == MAP_FAILED) throw refuse(why);
  data_ = static_cast<std::byte*>(data);
}

Buffer Buffer::in_new_file(const std::filesystem::path& file, std::size_t bytes) {
  Buffer buffer;
  buffer.data_ =
      map_new_file(::open(file.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666), bytes, file);
  buffer.bytes_ = bytes;
  return buffer;
}

Buffer::~Buffer() {
  if (data_ != nullptr) ::munmap(data_, bytes_);
  if (budget_ != nullptr) budget_->bytes_left += bytes_;
}

Buffer::Buffer(Buffer&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)),
      bytes_(std::exchange(other.bytes_, 0)),
      budget_(std::exchange(other.budget_, nullptr)) {}

Buffer& Buffer::operator=(Buffer&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(bytes_, other.bytes_);
  std::swap(budget_, other.budget_);
  return *this;
}

void Buffer::drop_pages() const {
  if (data_ != nullptr && budget_ == nullptr) ::madvise(data_, bytes_, MADV_DONTNEED);
}

}  // namespace converters
