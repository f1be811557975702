#pragma once

#include <epoxy/gl.h>

#include <memory>
#include <type_traits>

namespace globe::gl {

/// A fence: passed once the GPU has done everything asked of it before. (glFenceSync)
class Sync {
 public:
  Sync() = default;
  static Sync create();

  /// True once passed; never waits.
  bool passed() const;
  void wait() const;

 private:
  struct Destroy {
    void operator()(GLsync fence) const { glDeleteSync(fence); }
  };
  std::unique_ptr<std::remove_pointer_t<GLsync>, Destroy> fence_;
};

}  // namespace globe::gl
