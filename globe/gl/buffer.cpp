#include "globe/gl/buffer.h"

namespace globe::gl {

void Buffer::destroy(GLuint id) { glDeleteBuffers(1, &id); }

Buffer::Buffer(std::size_t size, const void* data) : size_(size) {
  assert(size > 0);
  GLuint id = 0;
  glCreateBuffers(1, &id);
  name_ = Name<&Buffer::destroy>(id);
  glNamedBufferStorage(id, static_cast<GLsizeiptr>(size), data, GL_DYNAMIC_STORAGE_BIT);
}

void Buffer::upload(std::size_t offset, const void* data, std::size_t size) {
  assert(offset + size <= size_);
  glNamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(size), data);
}

void Buffer::read(std::size_t offset, void* data, std::size_t size) const {
  assert(offset + size <= size_);
  glGetNamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(size), data);
}

void Buffer::bind_base(GLenum target, GLuint slot) const { glBindBufferBase(target, slot, id()); }

void Buffer::bind_range(GLenum target, GLuint slot, std::size_t offset, std::size_t size) const {
  assert(offset + size <= size_);
  glBindBufferRange(target, slot, id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(size));
}

void Buffer::bind(GLenum target) const { glBindBuffer(target, id()); }

}  // namespace globe::gl
