#pragma once

#include <array>

#include "globe/planet/surface.h"

namespace globe::planet {

/// Where the normal of a place meets the surface that is drawn at a level.
struct DrawnGround {
  double height_m = 0;                           ///< of the meeting point above the ellipsoid's place
  std::array<Node, 3> nodes{};                   ///< of the flat trixel that is met there
  std::array<double, 3> weights{0.0, 0.0, 0.0};  ///< barycentric, of the meeting point; sum 1
};

/// Height of the flat trixel that is drawn above a place (HARD-CASES H23).
///
/// The surface drawn at a level is a closed mesh of flat triangles in space, one a trixel, whose corners are
/// E(u_k) + h_k u_k: the level's nodes displaced along their normals by Surface::drawn_height (the sea is
/// drawn at height 0). The line E(u) + t u meets it at t, which is the answer. A flat triangle lies below the
/// curve of the ellipsoid, so the answer is less than that of linear interpolation of the same heights, by
/// the triangle's depth: L²/8R in the middle of an edge of length L, L²/6R in the middle of a regular
/// trixel. Off the sphere the line may leave the trixel that owns u for one beside it (by e² L²/8R at most):
/// the mesh is followed across its edges, so that the answer is continuous.
/// @param u  geodetic normal, unit
/// @param level  0..htm::kMaxLevel
/// Error: 1e-8 m for slopes up to 1 on the Earth, proportional to radius and slope beyond
/// (tests/hard/drawn_ground_test.cpp).
DrawnGround drawn_ground(const Surface& surface, const dvec3& u, int level);

}  // namespace globe::planet
