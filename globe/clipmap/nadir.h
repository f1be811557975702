#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "globe/planet/grid.h"

namespace globe::clipmap {

using glm::dvec2;
using glm::dvec3;
using glm::ivec2;
using planet::Node;

/// Lattice coordinates in 1/1024 of a cell: distances between them are exact, so both sides of a seam compute
/// the same.
inline constexpr std::int64_t kSubcell = 1024;

struct LatticePoint {
  std::int64_t i = 0;
  std::int64_t j = 0;

  friend bool operator==(const LatticePoint&, const LatticePoint&) = default;
};

/// A point of the sphere in grid coordinates: the place under the camera, or a node that stands for one.
struct GridPoint {
  int d = 0;
  int level = 0;
  LatticePoint at;  ///< inside diamond d, 1/1024 cells of `level`
};

/// The camera's nadir. Coordinates of all levels are the finest ones halved, so that levels nest.
class Nadir {
 public:
  explicit Nadir(const dvec3& u) : finest_(planet::locate(u, planet::kMaxLevel)) {}
  GridPoint at(int level) const;

 private:
  planet::Place finest_;
};

/// The same at one level.
inline GridPoint nadir(const dvec3& u, int level) { return Nadir(u).at(level); }

GridPoint grid_point(const Node& node);

/// Every place in the plane of diamond `d` at which the point is seen, the lattice being unfolded about
/// either pole both ways round. One image in the point's own diamond, two in its neighbours, four in the one
/// opposite.
std::vector<LatticePoint> images(const GridPoint& point, int d);

/// Length of the shortest lattice path from the nearest image, in 1/1024 cells.
///
/// Around an octahedron corner four triangles meet, 240 degrees of lattice: a place behind it sees two
/// images, and the nearer one is always in a straight line of sight.
std::int64_t hex_distance(const std::vector<LatticePoint>& images, LatticePoint p);

/// The node of the lattice of `step` cells (a power of two) nearest to the point; on a tie the one with the
/// least key.
Node nearest_lattice_node(const GridPoint& point, int step);

}  // namespace globe::clipmap
