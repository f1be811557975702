#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "flat/rim.h"
#include "flat/terrain.h"
#include "globe/clipmap/drawn_surface.h"
#include "globe/clipmap/ray.h"

namespace globe::flat {

/// The surface that is drawn of a region in a globe, in double precision: its mesh of level 0, lifted at the
/// rim, and the collar. What the picture shows is off from that by the region's error bound at most.
class DrawnRegion {
 public:
  DrawnRegion(std::shared_ptr<const Terrain> terrain, const Rim& rim);

  /// Distance of the first point of it on a ray, seen from outside; nothing where the ray misses it.
  /// @param ray        ECEF
  /// @param nearest_m  what lies nearer is looked through
  std::optional<double> first_hit(const clipmap::Ray& ray, double nearest_m) const;

 private:
  std::optional<double> hit_in(std::size_t patch, const clipmap::Ray& ray, double nearest_m) const;
  dvec3 post(int column, int row) const;

  std::shared_ptr<const Terrain> terrain_;
  std::vector<float> z_;       ///< of all posts, lifted
  std::vector<dvec3> collar_;  ///< triangles, frame coordinates
  double highest_lift_m_;
};

/// The first point of the ground on a ray, of a globe that leaves room for a region: the distance, and the
/// globe's own point where that is the first. Nothing where there is none.
struct GroundHit {
  double distance_m;
  std::optional<clipmap::DrawnPoint> globe;
};
std::optional<GroundHit> first_hit(const clipmap::DrawnSurface& globe, const DrawnRegion& region,
                                   const render::Room& room, const clipmap::Ray& ray, double nearest_m);

}  // namespace globe::flat
