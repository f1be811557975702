#pragma once

#include <cstddef>
#include <vector>

#include "globe/gl/name.h"

namespace globe::gl {

/// How client memory of a texture's texels looks; taken from the texture's own format, so that nothing is
/// converted on the way.
struct PixelLayout {
  GLenum format;  ///< GL_RED, GL_RGBA, ...
  GLenum type;    ///< GL_FLOAT, GL_UNSIGNED_BYTE, ...
  std::size_t bytes_per_texel;
};
/// Of a sized format out of: R8, RG8, RGBA8, SRGB8_ALPHA8, R16, RG16, RGBA16, R16F, RG16F, RGBA16F, R32F,
/// RG32F, RGB32F, RGBA32F, R32I, R32UI, R16UI, R8UI, DEPTH_COMPONENT24, DEPTH_COMPONENT32F. Others: asserted
/// against.
PixelLayout pixel_layout(GLenum format);

/// A rectangle of texels; for arrays, of one layer.
struct TexelBox {
  int x = 0, y = 0, width = 0, height = 0;
  int layer = 0;
  int level = 0;
};

/// A 2D texture or an array of them, with storage of fixed size. (glTextureStorage2D, glTextureStorage3D)
class Texture {
 public:
  Texture() = default;
  static Texture flat(GLenum format, int width, int height, int levels = 1);
  static Texture array(GLenum format, int width, int height, int layers, int levels = 1);

  GLuint id() const { return name_.id(); }
  GLenum format() const { return format_; }
  int width() const { return width_; }
  int height() const { return height_; }
  int layers() const { return layers_; }
  int levels() const { return levels_; }
  bool is_array() const { return is_array_; }
  std::size_t bytes() const;

  /// Overwrites a box from memory laid out as pixel_layout(format()), first row first.
  /// @param row_length  texels from one row of `data` to the next; 0: the box's width
  /// (glTextureSubImage2D, glTextureSubImage3D)
  void upload(const TexelBox& box, const void* data, int row_length = 0);

  /// Toroidal upload: the box may stand anywhere in the plane (x, y of any sign), texel (x, y) lands at
  /// (x mod width, y mod height). The box is at most as large as the texture. Up to four uploads.
  void upload_wrapped(const TexelBox& box, const void* data, int row_length = 0);

  /// Toroidal copy of a box from layer `from_layer` of `from`, which has this texture's format, width and
  /// height, to the same texels of box.layer here, on the GPU. Not onto itself. (glCopyImageSubData)
  void copy_wrapped(const Texture& from, int from_layer, const TexelBox& box);

  /// Waits for the GPU and copies a box out, in pixel_layout(format()). (glGetTextureSubImage)
  void read(const TexelBox& box, void* data, std::size_t size) const;
  template <class T>
  std::vector<T> read(const TexelBox& box) const {
    std::vector<T> texels(static_cast<std::size_t>(box.width) * static_cast<std::size_t>(box.height) *
                          pixel_layout(format_).bytes_per_texel / sizeof(T));
    read(box, texels.data(), texels.size() * sizeof(T));
    return texels;
  }

  /// GL_NEAREST, GL_LINEAR and, to minify, the mipmap filters. (glTextureParameteri)
  void set_filter(GLenum minify, GLenum magnify);
  /// GL_REPEAT (also right for a toroidal window), GL_CLAMP_TO_EDGE, ... in both directions.
  void set_wrap(GLenum mode);
  /// (glGenerateTextureMipmap)
  void generate_mipmaps();

  /// (glBindTextureUnit)
  void bind(GLuint unit) const;

 private:
  static void destroy(GLuint id);
  Texture(GLenum target, GLenum format, int width, int height, int layers, int levels);

  Name<&Texture::destroy> name_;
  GLenum format_ = 0;
  int width_ = 0, height_ = 0, layers_ = 0, levels_ = 0;
  bool is_array_ = false;
};

}  // namespace globe::gl
