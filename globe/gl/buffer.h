#pragma once

#include <cassert>
#include <cstddef>
#include <span>
#include <type_traits>
#include <vector>

#include "globe/gl/name.h"

namespace globe::gl {

/// A buffer of fixed size. (glCreateBuffers, glNamedBufferStorage with GL_DYNAMIC_STORAGE_BIT)
class Buffer {
 public:
  Buffer() = default;
  /// @param size  bytes, above 0; the contents are undefined without `data`
  explicit Buffer(std::size_t size, const void* data = nullptr);

  template <class T>
  static Buffer of(std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    return Buffer(values.size_bytes(), values.data());
  }
  template <class T>
  static Buffer of(const std::vector<T>& values) {
    return of(std::span<const T>(values));
  }

  GLuint id() const { return name_.id(); }
  std::size_t size() const { return size_; }

  /// Overwrites `size` bytes from `offset`. (glNamedBufferSubData)
  void upload(std::size_t offset, const void* data, std::size_t size);
  template <class T>
  void upload(std::size_t offset, std::span<const T> values) {
    static_assert(std::is_trivially_copyable_v<T>);
    upload(offset, values.data(), values.size_bytes());
  }

  /// Waits for the GPU and copies bytes out. (glGetNamedBufferSubData)
  void read(std::size_t offset, void* data, std::size_t size) const;
  template <class T>
  std::vector<T> read(std::size_t offset, std::size_t count) const {
    static_assert(std::is_trivially_copyable_v<T>);
    std::vector<T> values(count);
    read(offset, values.data(), count * sizeof(T));
    return values;
  }

  /// Binds the whole buffer to a numbered slot: GL_UNIFORM_BUFFER, GL_SHADER_STORAGE_BUFFER,
  /// GL_TRANSFORM_FEEDBACK_BUFFER. (glBindBufferBase)
  void bind_base(GLenum target, GLuint slot) const;
  /// Binds a part of it; `offset` on the target's alignment. (glBindBufferRange)
  void bind_range(GLenum target, GLuint slot, std::size_t offset, std::size_t size) const;
  /// Binds to a plain target: GL_DRAW_INDIRECT_BUFFER. (glBindBuffer)
  void bind(GLenum target) const;

 private:
  static void destroy(GLuint id);

  Name<&Buffer::destroy> name_;
  std::size_t size_ = 0;
};

}  // namespace globe::gl
