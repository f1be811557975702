#pragma once

#include <epoxy/gl.h>

#include "globe/effects/lat_long_image.h"
#include "globe/gl/texture.h"

namespace globe::effects {

/// A map of the whole planet for shaders/lib/lat_long.glsl, with mipmaps. Takes the image's pixels: they are
/// gone afterwards.
///
/// @param format  GL_RGBA8, or GL_SRGB8_ALPHA8 for pixels that look-ups make linear
gl::Texture planet_texture(LatLongImage& image, GLenum format);

}  // namespace globe::effects
