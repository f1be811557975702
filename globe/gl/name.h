#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace globe::gl {

/// Sole owner of one OpenGL name: the shape every object of this folder is made of.
///
/// Move-only. The empty state (name 0) is what a default-constructed or moved-from object holds; it is safe
/// to destroy without a context, every other name wants its context current.
template <void (*kDestroy)(GLuint)>
class Name {
 public:
  Name() = default;
  explicit Name(GLuint id) : id_(id) {}
  Name(Name&& other) noexcept : id_(std::exchange(other.id_, 0)) {}
  Name& operator=(Name&& other) noexcept {
    std::swap(id_, other.id_);
    return *this;
  }
  ~Name() {
    if (id_ != 0) kDestroy(id_);
  }

  GLuint id() const { return id_; }

 private:
  GLuint id_ = 0;
};

}  // namespace globe::gl
