#include "globe/planet/drawn_ground.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "globe/htm/trixel.h"
#include "globe/planet/cell.h"

namespace globe::planet {
namespace {

/// The nodes of a trixel, in the order of its corners.
std::array<Node, 3> nodes_of(htm::Trixel trixel) {
  const auto [d, level, i, j, half] = cell_from_trixel(trixel);
  const auto at = [&, d = d, level = level](int x, int y) { return Node{d, level, x, y}; };
  std::array<Node, 3> nodes{at(i, j), at(i + 1, j), at(i, j + 1)};
  if (half == 1) nodes = {at(i + 1, j + 1), at(i, j + 1), at(i + 1, j)};
  const dvec3 first = htm::corners(trixel)[0];  // the same bits as the node's direction
  const auto begin = std::find_if(nodes.begin(), nodes.end(),
                                  [&](const Node& node) { return node_direction(node) == first; });
  std::rotate(nodes.begin(), begin, nodes.end());
  return nodes;
}

/// Where the line through E(u) along u meets the plane of a trixel's displaced corners. All positions are
/// taken from E(u): differences of near points keep their digits.
DrawnGround meet(const Surface& surface, const dvec3& u, htm::Trixel trixel) {
  const geo::Ellipsoid& ellipsoid = surface.ellipsoid();
  const dvec3 foot = geo::surface_point(ellipsoid, u);
  DrawnGround ground;
  ground.nodes = nodes_of(trixel);
  std::array<dvec3, 3> corner;
  for (std::size_t k = 0; k < 3; ++k) {
    const dvec3 normal = node_direction(ground.nodes[k]);
    const double height_m = surface.drawn_height(surface.height(ground.nodes[k]));
    corner[k] = (geo::surface_point(ellipsoid, normal) - foot) + height_m * normal;
  }
  const dvec3 across = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double steepness = glm::dot(across, u);
  ground.height_m = glm::dot(across, corner[0]) / steepness;
  for (std::size_t k = 0; k < 3; ++k)
    ground.weights[k] = glm::dot(u, glm::cross(corner[(k + 1) % 3], corner[(k + 2) % 3])) / steepness;
  return ground;
}

double least_weight(const DrawnGround& ground) {
  return *std::min_element(ground.weights.begin(), ground.weights.end());
}

}  // namespace

DrawnGround drawn_ground(const Surface& surface, const dvec3& u, int level) {
  htm::Trixel trixel = htm::trixel_at(u, level);
  DrawnGround best = meet(surface, u, trixel);
  // Across the edge that the line passes on the wrong side of, as long as that brings it nearer; on an edge
  // both sides give the same answer.
  while (least_weight(best) < 0.0) {
    const auto outermost = std::min_element(best.weights.begin(), best.weights.end());
    trixel = htm::neighbors(trixel)[static_cast<std::size_t>(outermost - best.weights.begin())];
    const DrawnGround beside = meet(surface, u, trixel);
    if (least_weight(beside) <= least_weight(best)) break;
    best = beside;
  }
  return best;
}

}  // namespace globe::planet
