#include "globe/gl/debug_log.h"

namespace globe::gl {
namespace {

/// A thousand lines of the same complaint tell no more than the first few.
constexpr std::size_t kMaxMessages = 100;

bool is_fault(GLenum source, GLenum type, GLenum severity) {
  if (source == GL_DEBUG_SOURCE_SHADER_COMPILER) return false;
  if (type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
      type == GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR) {
    return true;
  }
  if (type == GL_DEBUG_TYPE_PERFORMANCE) return false;
  return severity == GL_DEBUG_SEVERITY_HIGH || severity == GL_DEBUG_SEVERITY_MEDIUM;
}

}  // namespace

void DebugLog::listen() {
  glEnable(GL_DEBUG_OUTPUT);
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageCallback(&DebugLog::receive, this);
}

void GLAPIENTRY DebugLog::receive(GLenum source, GLenum type, GLuint, GLenum severity, GLsizei length,
                                  const GLchar* message, const void* user) {
  if (!is_fault(source, type, severity)) return;
  // GL hands the user pointer back as const; it is the non-const object given to glDebugMessageCallback.
  auto& messages = static_cast<DebugLog*>(const_cast<void*>(user))->messages_;
  if (messages.size() >= kMaxMessages) return;
  std::string text =
      length < 0 ? std::string(message) : std::string(message, static_cast<std::size_t>(length));
  while (!text.empty() && (text.back() == '\n' || text.back() == '\0')) text.pop_back();
  messages.push_back(std::move(text));
}

}  // namespace globe::gl
