#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "globe/planet/surface.h"

namespace globe::planet {

/// What the look of the ground at a node is decided from.
struct Ground {
  double height_m = 0;    ///< solid ground
  glm::dvec2 slope{0.0};  ///< rise over run of the drawn ground along two perpendicular directions
  double cavity = 0;  ///< height above the mean of the neighbours, in cells: > 0 on a crest, < 0 in a hollow
  double sin_latitude = 0;
  double edge_m = 1;  ///< distance between neighbouring nodes of the level being coloured
  float roughness = 0;
  float prominence = 0;  ///< [-1, 1], valley floor to crest; 0 where nothing is synthesised
  float moisture = 0.5f;
  float mottle = 0;
  glm::vec3 color{0.0f};  ///< ground colour of the map, linear light; ignored unless has_color
  bool has_color = false;
  bool has_sea = false;     ///< ground below height 0 is under water
  bool bare_floor = false;  ///< that ground itself is to be seen, not the water
  bool airless = false;     ///< no plants, no snow
};

/// Albedo of the ground, linear light, [0, 1] a channel: the map's colour with the detail it is too coarse to
/// hold, or height-and-slope colours (Christopoulos 5.4.1) where there is no map.
glm::vec3 albedo(const Ground& ground);

/// A look of one's own: an albedo in place of the one that albedo() gives.
using Coloring = std::function<glm::vec3(const Ground& ground, const glm::vec3& albedo)>;

/// Share of pack ice over ground below the sea, [0, 1].
float pack_ice(const Ground& ground);

/// Whether a sea lies open over ground, not under pack ice.
/// @param albedo  of that ground
bool is_open_water(const Ground& ground, const glm::vec3& albedo);

/// Slope of the drawn ground (the sea's surface where it lies above the ground) from a node's neighbours.
struct GroundSlope {
  dvec3 gradient{0.0};  ///< tangent vector, rise over run
  double cavity = 0;    ///< as Ground::cavity
};
/// `directions`: node_directions of the tile.
GroundSlope slope_at(const Surface& surface, const SurfaceTile& tile, const TileValues<dvec3>& directions,
                     int i, int j);

/// Slope of a tile's shading_height at one of its nodes: of the plane through the node that fits its
/// neighbours best where they truly lie. The same, but for rounding, by every name of the node, and right
/// where the lattice has a kink, the octahedron's corners with their four neighbours included.
GroundSlope exact_slope(const Surface& surface, const SurfaceTile& tile, int i, int j);

/// What a tile itself knows of a node for albedo: all but slope, cavity and latitude.
Ground tile_ground(const Surface& surface, const SurfaceTile& tile, int i, int j);

/// Everything albedo asks for at a node of a tile (no guard nodes).
Ground ground_at(const Surface& surface, const SurfaceTile& tile, const TileValues<dvec3>& directions, int i,
                 int j);

}  // namespace globe::planet
