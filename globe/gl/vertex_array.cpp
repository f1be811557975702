#include "globe/gl/vertex_array.h"

namespace globe::gl {

void VertexArray::destroy(GLuint id) { glDeleteVertexArrays(1, &id); }

VertexArray VertexArray::create() {
  VertexArray result;
  GLuint id = 0;
  glCreateVertexArrays(1, &id);
  result.name_ = Name<&VertexArray::destroy>(id);
  return result;
}

void VertexArray::set_vertices(GLuint binding, const Buffer& buffer, std::size_t offset, int stride,
                               GLuint divisor) {
  glVertexArrayVertexBuffer(id(), binding, buffer.id(), static_cast<GLintptr>(offset), stride);
  glVertexArrayBindingDivisor(id(), binding, divisor);
}

void VertexArray::set_attribute(GLuint binding, const Attribute& attribute) {
  glEnableVertexArrayAttrib(id(), attribute.location);
  if (attribute.kind == Attribute::Kind::kInteger) {
    glVertexArrayAttribIFormat(id(), attribute.location, attribute.components, attribute.type,
                               attribute.offset);
  } else {
    const GLboolean normalized = attribute.kind == Attribute::Kind::kNormalized ? GL_TRUE : GL_FALSE;
    glVertexArrayAttribFormat(id(), attribute.location, attribute.components, attribute.type, normalized,
                              attribute.offset);
  }
  glVertexArrayAttribBinding(id(), attribute.location, binding);
}

void VertexArray::set_indices(const Buffer& buffer) { glVertexArrayElementBuffer(id(), buffer.id()); }

void VertexArray::bind() const { glBindVertexArray(id()); }

}  // namespace globe::gl
