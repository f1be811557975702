#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "flat/height_grid.h"
#include "flat/terrain.h"

/// Hills of some kilometres with noise from post to post, deterministic: nothing that meshes could take
/// advantage of.
inline globe::flat::HeightGrid rough_heights(int patches_east, int patches_north, double spacing_m = 30.0) {
  using namespace globe::flat;
  const PostRect posts{-8 * patches_east, -8 * patches_north, 16 * patches_east + 1, 16 * patches_north + 1,
                       1};
  std::vector<float> heights;
  for (int row = 0; row < posts.rows; ++row) {
    for (int column = 0; column < posts.columns; ++column) {
      auto hash = static_cast<std::uint32_t>(row * 7919 + column * 104729);
      hash = (hash ^ (hash >> 15)) * 0x2c1b3c6du;
      hash = (hash ^ (hash >> 12)) * 0x297a2d39u;
      hash ^= hash >> 15;
      heights.push_back(static_cast<float>(800.0 + 300.0 * std::sin(0.11 * column) * std::cos(0.07 * row) +
                                           20.0 * static_cast<double>(hash) / 4294967296.0));
    }
  }
  return {spacing_m, posts, std::move(heights)};
}

inline std::shared_ptr<const globe::flat::Terrain> rough_terrain(int patches_east, int patches_north,
                                                                 double lat_deg = 46.2,
                                                                 double lon_deg = -122.19) {
  const globe::flat::HeightGrid grid = rough_heights(patches_east, patches_north);
  return std::make_shared<const globe::flat::Terrain>(
      globe::flat::TangentFrame(globe::geo::kWgs84, lat_deg, lon_deg), grid, *grid.extent());
}
