#pragma once

#include <span>

namespace globe::gl {

/// A file of shaders/ as it was when the program was built.
struct EmbeddedShader {
  const char* name;  ///< path under shaders/
  const char* text;
};

/// Defined in the source that cmake/embed_shaders.cmake writes.
std::span<const EmbeddedShader> embedded_shaders();

}  // namespace globe::gl
