#include "globe/effects/planet_texture.h"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace globe::effects {

gl::Texture planet_texture(LatLongImage& image, GLenum format) {
  const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const auto channels = static_cast<std::size_t>(image.channels);
  std::vector<std::uint8_t> rgba(pixels * 4, 255);
  for (std::size_t k = 0; k < pixels; ++k) {
    for (std::size_t c = 0; c < 3; ++c)
      rgba[4 * k + c] = image.pixels[k * channels + (channels == 1 ? 0 : c)];
  }
  image.pixels = {};
  const int levels =
      static_cast<int>(std::bit_width(static_cast<unsigned>(std::min(image.width, image.height))));
  gl::Texture texture = gl::Texture::flat(format, image.width, image.height, levels);
  texture.upload({0, 0, image.width, image.height, 0, 0}, rgba.data());
  texture.generate_mipmaps();
  texture.set_filter(GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR);
  glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTextureParameteri(texture.id(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace globe::effects
