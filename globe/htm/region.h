#pragma once

#include <vector>

#include "globe/htm/trixel.h"

namespace globe::htm {

/// How a trixel lies to a region.
enum class Relation {
  kDisjoint,  ///< no point in common, for certain
  kTouches,   ///< partly inside, or closer to the border than rounding can tell
  kInside,    ///< every point of the trixel is in the region, for certain
};

/// A part of the sphere of geodetic normals: a cone, a polygon, a box of parallels and meridians, and
/// whatever else answers these two questions.
class Region {
 public:
  virtual ~Region() = default;

  /// Whether a direction (unit) is in the region; its border is part of it.
  virtual bool contains(const dvec3& u) const = 0;

  /// Relation of the trixel with these corners. In doubt kTouches, so that an outer cover errs outwards and
  /// an inner one inwards.
  virtual Relation relation(const Corners& trixel) const = 0;

  /// Directions (unit), one at least on each connected piece of the border, within rounding. None where there
  /// is no border: for all of the sphere, or nothing of it. So that something without a border in the region
  /// is known to lie around a part of it, or not.
  virtual std::vector<dvec3> border_points() const = 0;
};

}  // namespace globe::htm
