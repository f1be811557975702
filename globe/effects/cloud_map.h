#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "globe/effects/lat_long_image.h"

namespace globe::effects {

/// How much clouds a place is given to, 0 to 1, on the six faces of a cube about the planet: (geodetic)
/// normals as directions, the texels of a face's border on the cube's edges, so that faces agree there.
///
/// Face 2k looks along axis k, face 2k + 1 against it; columns follow axis k + 1, rows axis k + 2.
struct CloudCover {
  int side = 0;               ///< texels of a face, a power of two
  std::vector<float> values;  ///< 6 faces, row by row

  float& at(int face, int column, int row);
  float at(int face, int column, int row) const;
  /// Bilinear, of a direction of any length.
  float at(const glm::dvec3& direction) const;
};

/// Direction of a texel's centre, not of unit length.
glm::dvec3 cube_direction(int face, double column, double row, int side);

/// Weather made up from a seed: fronts and whirls of the middle latitudes, a belt of storms at the equator,
/// deserts between. Any value is as frequent as another over the sphere: above 1 - c lies c of it. The same
/// on every machine but for the last bits of exp.
CloudCover made_up_cover(std::uint32_t seed, int side);

/// A picture's brightness.
CloudCover cover_of(const LatLongImage& image, int side);

/// As the texture has it: levels from `side` down to 2 texels a face, each 6 faces of RGBA: the cover, and
/// its gradient by radians in `kGradientRange` (shaders/effects/clouds.glsl), in the axes of the planet.
std::vector<std::vector<std::uint8_t>> cloud_texels(const CloudCover& cover);

/// The cover of a direction by the texels of one level, bilinear.
double cover_at(const std::vector<std::uint8_t>& texels, int side, const glm::dvec3& direction);

/// A square of heaped clouds that repeats: `side`² texels of RGBA, the cover from -1 to 1 of mean 0, and its
/// gradient by the square's side in `kDetailRange` along columns and rows.
std::vector<std::uint8_t> cloud_detail(std::uint32_t seed, int side);

}  // namespace globe::effects
