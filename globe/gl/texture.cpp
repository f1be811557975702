#include "globe/gl/texture.h"

#include <algorithm>
#include <cassert>

namespace globe::gl {
namespace {

/// Remainder in [0, n), also for negative x.
int wrapped(int x, int n) {
  const int remainder = x % n;
  return remainder < 0 ? remainder + n : remainder;
}

/// The up to four parts of a box that a torus of a width and height keeps together: visit(texels, columns and
/// rows of the box before them).
template <class Visit>
void for_each_unwrapped(const TexelBox& box, int torus_width, int torus_height, const Visit& visit) {
  for (int row = 0; row < box.height;) {
    const int y = wrapped(box.y + row, torus_height);
    const int rows = std::min(box.height - row, torus_height - y);
    for (int column = 0; column < box.width;) {
      const int x = wrapped(box.x + column, torus_width);
      const int columns = std::min(box.width - column, torus_width - x);
      visit(TexelBox{x, y, columns, rows, box.layer, 0}, column, row);
      column += columns;
    }
    row += rows;
  }
}

}  // namespace

PixelLayout pixel_layout(GLenum format) {
  switch (format) {
    case GL_R8:
      return {GL_RED, GL_UNSIGNED_BYTE, 1};
    case GL_RG8:
      return {GL_RG, GL_UNSIGNED_BYTE, 2};
    case GL_RGBA8:
    case GL_SRGB8_ALPHA8:
      return {GL_RGBA, GL_UNSIGNED_BYTE, 4};
    case GL_R16:
      return {GL_RED, GL_UNSIGNED_SHORT, 2};
    case GL_RG16:
      return {GL_RG, GL_UNSIGNED_SHORT, 4};
    case GL_RGBA16:
      return {GL_RGBA, GL_UNSIGNED_SHORT, 8};
    case GL_R16F:
      return {GL_RED, GL_HALF_FLOAT, 2};
    case GL_RG16F:
      return {GL_RG, GL_HALF_FLOAT, 4};
    case GL_RGBA16F:
      return {GL_RGBA, GL_HALF_FLOAT, 8};
    case GL_R32F:
      return {GL_RED, GL_FLOAT, 4};
    case GL_RG32F:
      return {GL_RG, GL_FLOAT, 8};
    case GL_RGB32F:
      return {GL_RGB, GL_FLOAT, 12};
    case GL_RGBA32F:
      return {GL_RGBA, GL_FLOAT, 16};
    case GL_R32I:
      return {GL_RED_INTEGER, GL_INT, 4};
    case GL_R32UI:
      return {GL_RED_INTEGER, GL_UNSIGNED_INT, 4};
    case GL_R16UI:
      return {GL_RED_INTEGER, GL_UNSIGNED_SHORT, 2};
    case GL_R8UI:
      return {GL_RED_INTEGER, GL_UNSIGNED_BYTE, 1};
    case GL_DEPTH_COMPONENT24:
    case GL_DEPTH_COMPONENT32F:
      return {GL_DEPTH_COMPONENT, GL_FLOAT, 4};
    default:
      assert(false && "format without a pixel layout");
      return {};
  }
}

void Texture::destroy(GLuint id) { glDeleteTextures(1, &id); }

Texture::Texture(GLenum target, GLenum format, int width, int height, int layers, int levels)
    : format_(format),
      width_(width),
      height_(height),
      layers_(layers),
      levels_(levels),
      is_array_(target == GL_TEXTURE_2D_ARRAY) {
  assert(width > 0 && height > 0 && layers > 0 && levels > 0);
  GLuint id = 0;
  glCreateTextures(target, 1, &id);
  name_ = Name<&Texture::destroy>(id);
  if (is_array_) {
    glTextureStorage3D(id, levels, format, width, height, layers);
  } else {
    glTextureStorage2D(id, levels, format, width, height);
  }
  // The default filter minifies through mipmaps, which a texture of one level does not have.
  if (levels == 1) set_filter(GL_NEAREST, GL_NEAREST);
}

Texture Texture::flat(GLenum format, int width, int height, int levels) {
  return {GL_TEXTURE_2D, format, width, height, 1, levels};
}

Texture Texture::array(GLenum format, int width, int height, int layers, int levels) {
  return {GL_TEXTURE_2D_ARRAY, format, width, height, layers, levels};
}

std::size_t Texture::bytes() const {
  std::size_t texels = 0;
  for (int level = 0; level < levels_; ++level) {
    texels += static_cast<std::size_t>(std::max(1, width_ >> level)) *
              static_cast<std::size_t>(std::max(1, height_ >> level));
  }
  return id() == 0 ? 0 : texels * static_cast<std::size_t>(layers_) * pixel_layout(format_).bytes_per_texel;
}

void Texture::upload(const TexelBox& box, const void* data, int row_length) {
  const PixelLayout layout = pixel_layout(format_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ROW_LENGTH, row_length);
  if (is_array_) {
    glTextureSubImage3D(id(), box.level, box.x, box.y, box.layer, box.width, box.height, 1, layout.format,
                        layout.type, data);
  } else {
    glTextureSubImage2D(id(), box.level, box.x, box.y, box.width, box.height, layout.format, layout.type,
                        data);
  }
}

void Texture::upload_wrapped(const TexelBox& box, const void* data, int row_length) {
  assert(box.level == 0 && box.width <= width_ && box.height <= height_);
  const std::size_t texel = pixel_layout(format_).bytes_per_texel;
  const int stride = row_length == 0 ? box.width : row_length;
  for_each_unwrapped(box, width_, height_, [&](const TexelBox& texels, int column, int row) {
    const std::size_t first =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(stride) + static_cast<std::size_t>(column);
    upload(texels, static_cast<const std::byte*>(data) + first * texel, stride);
  });
}

void Texture::copy_wrapped(const Texture& from, int from_layer, const TexelBox& box) {
  assert(is_array_ && box.level == 0 && box.width <= width_ && box.height <= height_);
  assert(from.format_ == format_ && from.width_ == width_ && from.height_ == height_);
  for_each_unwrapped(box, width_, height_, [&](const TexelBox& texels, int, int) {
    glCopyImageSubData(from.id(), GL_TEXTURE_2D_ARRAY, 0, texels.x, texels.y, from_layer, id(),
                       GL_TEXTURE_2D_ARRAY, 0, texels.x, texels.y, texels.layer, texels.width, texels.height,
                       1);
  });
}

void Texture::read(const TexelBox& box, void* data, std::size_t size) const {
  const PixelLayout layout = pixel_layout(format_);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glGetTextureSubImage(id(), box.level, box.x, box.y, box.layer, box.width, box.height, 1, layout.format,
                       layout.type, static_cast<GLsizei>(size), data);
}

void Texture::set_filter(GLenum minify, GLenum magnify) {
  glTextureParameteri(id(), GL_TEXTURE_MIN_FILTER, static_cast<GLint>(minify));
  glTextureParameteri(id(), GL_TEXTURE_MAG_FILTER, static_cast<GLint>(magnify));
}

void Texture::set_wrap(GLenum mode) {
  glTextureParameteri(id(), GL_TEXTURE_WRAP_S, static_cast<GLint>(mode));
  glTextureParameteri(id(), GL_TEXTURE_WRAP_T, static_cast<GLint>(mode));
}

void Texture::generate_mipmaps() { glGenerateTextureMipmap(id()); }

void Texture::bind(GLuint unit) const { glBindTextureUnit(unit, id()); }

}  // namespace globe::gl
