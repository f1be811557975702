#pragma once

#include <epoxy/gl.h>

#include <type_traits>

#include "globe/gl/buffer.h"

namespace globe::effects {

/// The uniform block of an effect, on the GPU from its first use on. T mirrors the block of the shader
/// (std140).
template <class T>
class UniformBlock {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  /// Overwrites it and binds it to a numbered slot.
  void bind(const T& values, unsigned slot) {
    if (buffer_.size() == 0) buffer_ = gl::Buffer(sizeof(T));
    buffer_.upload(0, &values, sizeof(T));
    buffer_.bind_base(GL_UNIFORM_BUFFER, slot);
  }

  std::size_t bytes() const { return buffer_.size(); }

 private:
  gl::Buffer buffer_;
};

}  // namespace globe::effects
