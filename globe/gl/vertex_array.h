#pragma once

#include "globe/gl/buffer.h"

namespace globe::gl {

/// One vertex attribute: where it lies in a vertex and how it reaches the shader.
struct Attribute {
  enum class Kind { kFloat, kNormalized, kInteger };

  GLuint location = 0;
  GLint components = 1;
  GLenum type = GL_FLOAT;
  GLuint offset = 0;  ///< bytes from the start of the vertex
  Kind kind = Kind::kFloat;
};

/// Where the vertices come from. Buffers are referred to, not owned. An array with no buffer at all is fine
/// for shaders that work from gl_VertexID. (glCreateVertexArrays)
class VertexArray {
 public:
  VertexArray() = default;
  static VertexArray create();

  GLuint id() const { return name_.id(); }

  /// @param stride   bytes from one vertex to the next
  /// @param divisor  0: a vertex a vertex; 1: one an instance
  /// (glVertexArrayVertexBuffer, glVertexArrayBindingDivisor)
  void set_vertices(GLuint binding, const Buffer& buffer, std::size_t offset, int stride, GLuint divisor = 0);
  /// (glVertexArrayAttribFormat, glVertexArrayAttribIFormat)
  void set_attribute(GLuint binding, const Attribute& attribute);
  /// (glVertexArrayElementBuffer)
  void set_indices(const Buffer& buffer);

  void bind() const;

 private:
  static void destroy(GLuint id);

  Name<&VertexArray::destroy> name_;
};

}  // namespace globe::gl
