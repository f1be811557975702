#pragma once

#include <epoxy/gl.h>

#include <string>
#include <vector>

namespace globe::gl {

/// Collects what the driver complains about: GL errors, undefined behaviour and deprecations of any severity,
/// and all else of high or medium severity. Left out are notifications and performance hints, which are no
/// faults.
///
/// The object is the callback's argument, so it stays where it is: neither copied nor moved.
class DebugLog {
 public:
  DebugLog() = default;
  DebugLog(const DebugLog&) = delete;
  DebugLog& operator=(const DebugLog&) = delete;

  /// Switches debug output of the current context on, delivered within the call that causes it.
  /// (glDebugMessageCallback)
  void listen();

  const std::vector<std::string>& messages() const { return messages_; }
  void clear() { messages_.clear(); }

 private:
  static void GLAPIENTRY receive(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                 const GLchar* message, const void* user);

  std::vector<std::string> messages_;
};

}  // namespace globe::gl
