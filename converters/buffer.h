#pragma once

#include <cstddef>
#include <filesystem>

namespace converters {

/// How much memory a conversion may still take, and where what does not fit goes.
struct MemoryBudget {
  std::size_t bytes_left;
  std::filesystem::path scratch_folder;
};

/// A large zeroed block: in memory while the budget lasts, else in a nameless file of the scratch folder,
/// mapped. Either way it is plain memory to those who use it.
class Buffer {
 public:
  Buffer() = default;
  /// Throws globe::Error when neither memory nor disk has room.
  Buffer(std::size_t bytes, MemoryBudget& budget);
  /// The contents of a file, mapped; changes reach the file. Throws globe::Error when it cannot be mapped or
  /// is not of that size.
  Buffer(const std::filesystem::path& file, std::size_t bytes);
  /// A new file of that size, mapped likewise. Throws globe::Error when the disk has no room.
  static Buffer in_new_file(const std::filesystem::path& file, std::size_t bytes);
  ~Buffer();
  Buffer(Buffer&& other) noexcept;
  Buffer& operator=(Buffer&& other) noexcept;

  std::byte* data() { return data_; }
  const std::byte* data() const { return data_; }
  template <typename T>
  T* as() {
    return reinterpret_cast<T*>(data_);
  }
  template <typename T>
  const T* as() const {
    return reinterpret_cast<const T*>(data_);
  }
  std::size_t size() const { return bytes_; }

  /// Lets go of the pages in memory when the block lies in a file; contents stay. Others may read meanwhile.
  void drop_pages() const;

 private:
  std::byte* data_ = nullptr;
  std::size_t bytes_ = 0;
  MemoryBudget* budget_ = nullptr;  ///< to give back to; null when the block lies in a file
};

}  // namespace converters
