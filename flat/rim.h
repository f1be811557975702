#pragma once

#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

#include "flat/levels.h"
#include "flat/patch_mesh.h"
#include "flat/terrain.h"
#include "globe/clipmap/cut.h"
#include "globe/render/region_below.h"
#include "globe/render/room.h"

namespace globe::flat {

/// A region that lies in other ground meets it one post's distance outside of its borders. What is between is
/// the collar: a strip of triangles from the border's vertices to where the ground around is drawn.
inline constexpr double kCollarPosts = 1.0;

/// What a region leaves to be drawn around it: all but its posts and the collar.
render::Room room_of(const Terrain& terrain);

/// Heights along a straight line of the plane, piecewise linear.
class RimCurve {
 public:
  RimCurve() = default;
  /// @param points  places along the line and z, metres of the frame, in any order; not empty
  explicit RimCurve(std::vector<glm::dvec2> points);

  /// z at a place along the line; beyond its ends that of the end.
  double z_at(double along_m) const;
  /// Sorted by place, each place once.
  const std::vector<glm::dvec2>& points() const { return points_; }

 private:
  std::vector<glm::dvec2> points_;
};

/// How a region meets the ground around it as that is drawn in a view.
struct Rim {
  /// By Side, of every post of it from the west or south: how far the ground around lies above the post,
  /// metres. The region is lifted by that at the border, farther inside by less of it.
  std::array<std::vector<float>, kSides> lifts;
  /// By Side: the ground around where the collar ends, along the whole side of the room.
  std::array<RimCurve, kSides> outside;
  std::array<double, 4> corner_z{};  ///< of the room: south-west, south-east, north-west, north-east
  int band = 1;                      ///< posts from the border to where nothing is lifted
  double highest_m = 0;              ///< the largest lift, whatever its sign
};

/// The stretches in which a plane meets the ground around (clipmap::cut).
using Cutter = std::function<std::vector<std::array<dvec3, 2>>(const clipmap::CuttingPlane& plane)>;

Rim make_rim(const Terrain& terrain, const Cutter& cut);

/// What a region that lies in other ground is of the ground under a camera at a place (ECEF).
render::RegionBelow region_below(const Terrain& terrain, const dvec3& position);

/// What a vertex is lifted by, metres; the same as in shaders/flat/lift.glsl.
float lift_at(const Rim& rim, const PostRect& posts, int column, int row);

/// A vertex of the collar.
struct CollarVertex {
  glm::vec2 post;    ///< columns and rows from the eye's
  float z = 0;       ///< in the frame, metres
  float lifted = 0;  ///< 1: it is a vertex of the region's border, to be lifted as that is
};

/// A patch at a border as it is drawn.
struct BorderPatch {
  std::size_t patch;
  const PatchState& state;
  const std::vector<PatchVertex>& vertices;  ///< of its shape
};

/// Adds the triangles of the collar beside a patch, three vertices each, counter-clockwise seen from above.
/// @param eye_post  column and row that vertices are counted from
void add_collar(const Terrain& terrain, const Rim& rim, const BorderPatch& border, bool morphs,
                const glm::dvec2& eye_post, std::vector<CollarVertex>& triangles);

/// Whether a patch has a side on the region's border.
bool is_at_border(const Terrain& terrain, std::size_t patch);

}  // namespace globe::flat
