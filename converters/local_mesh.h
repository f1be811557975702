#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "converters/map_window.h"
#include "converters/raster_source.h"
#include "globe/planet/surface.h"

namespace converters {

/// Ground of a region as triangles: those trixels of a level whose middles lie in it.
///
/// Positions are metres in the frame of `origin`: x east, y up, z south, as glTF has its axes.
struct LocalMesh {
  int level = 0;
  globe::geo::Geodetic origin;  ///< the region's middle, on the ellipsoid
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<std::uint32_t> indices;  ///< three a triangle, counter-clockwise seen from above
  std::vector<glm::vec2> places;       ///< of each vertex on `map`, [0, 1] each way, (0, 0) its north-west
  MapWindow map;                       ///< holds every vertex; width and height not set
};

inline constexpr std::size_t kMaxMeshVertices = 4'000'000;
inline constexpr double kMaxMeshSide_deg = 90.0;

/// @param level  default: the finest data in the region, or the finest level with at most a million vertices;
///               finer than the data it is synthesised
/// Throws globe::UsageError for regions wider or higher than kMaxMeshSide_deg or with more than
/// kMaxMeshVertices vertices, globe::Error for those that hold no trixel's middle.
LocalMesh make_local_mesh(const globe::planet::Surface& surface, const Extent& extent,
                          const std::optional<int>& level);

}  // namespace converters
