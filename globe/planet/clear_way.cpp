#include "globe/planet/clear_way.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "globe/planet/sight.h"

namespace globe::planet {
namespace {

constexpr int kMostChords = 64;
constexpr double kCells = 64;  ///< of the ground to a chord, or to a height above it
constexpr int kMostRaises = 32;
constexpr int kFirstLevel = 6;
constexpr double kTouch_m = 1e-6;
constexpr double kLeastShare = 1e-3;  ///< of a chord: what lies nearer to its begin counts as so far away

/// A motion along the great circle of normals, heights linear.
class Motion {
 public:
  Motion(const geo::Geodetic& from, const geo::Geodetic& to)
      : from_(geo::normal_from_degrees(from.lat_deg, from.lon_deg)),
        h_(from.h_m),
        rise_(to.h_m - from.h_m),
        to_(to) {
    const dvec3 end = geo::normal_from_degrees(to.lat_deg, to.lon_deg);
    const dvec3 across = end - from_ * glm::dot(from_, end);
    angle_ = std::atan2(glm::length(glm::cross(from_, end)), glm::dot(from_, end));
    // Between antipodes any way is as good: over a pole, or from a pole along the meridian of 0.
    const dvec3 north = dvec3(0, 0, 1) - from_ * from_.z;
    const dvec3 aside = glm::length(across) > 1e-12  ? across
                        : glm::length(north) > 1e-12 ? north
                                                     : dvec3(1, 0, 0);
    toward_ = glm::normalize(aside);
  }

  double angle() const { return angle_; }

  geo::Geodetic at(double share) const {
    if (share >= 1.0) return to_;
    geo::Geodetic place =
        geo::degrees_from_normal(from_ * std::cos(angle_ * share) + toward_ * std::sin(angle_ * share));
    place.h_m = h_ + rise_ * share;
    return place;
  }

 private:
  dvec3 from_, toward_;
  double angle_ = 0, h_, rise_;
  geo::Geodetic to_;
};

double distance_m(const geo::Ellipsoid& ellipsoid, const geo::Geodetic& a, const geo::Geodetic& b) {
  return glm::distance(geo::ecef_from_geodetic(ellipsoid, a), geo::ecef_from_geodetic(ellipsoid, b));
}

/// The finest level of which kCells cells are so long, up to one.
int level_for(const Surface& surface, double metres, int finest) {
  return std::clamp(static_cast<int>(std::log2(surface.root_edge() * kCells / std::max(metres, kTouch_m))), 0,
                    finest);
}

/// Height above the ground of the level that fits this height.
double above_ground(const Surface& surface, const geo::Geodetic& place, int finest) {
  double above = place.h_m;
  int level = -1;
  for (int wanted = std::min(kFirstLevel, finest); wanted > level;
       wanted = level_for(surface, above, finest)) {
    level = wanted;
    above = place.h_m - sight_ground(surface, place, {level});
  }
  return above;
}

geo::Geodetic raised(const Surface& surface, geo::Geodetic place, const Clearance& keep) {
  for (int k = 0; k < kMostRaises; ++k) {
    const double above = above_ground(surface, place, keep.level);
    if (above >= keep.clearance_m) break;
    place.h_m += keep.clearance_m - above;
  }
  return place;
}

/// `to`, raised until the chord from `from` keeps clear.
geo::Geodetic clear_chord(const Surface& surface, const geo::Geodetic& from, geo::Geodetic to,
                          const Clearance& keep) {
  for (int k = 0; k < kMostRaises; ++k) {
    const double length = distance_m(surface.ellipsoid(), from, to);
    if (length < kTouch_m) break;
    const Sight seen = sight(surface, from, to, {level_for(surface, length, keep.level)});
    const double deficit = keep.clearance_m - seen.lowest.clearance_m;
    if (deficit <= kTouch_m) break;
    // Raising the end raises the chord at a place by the place's share of it.
    const double share = distance_m(surface.ellipsoid(), from, seen.lowest.ray) / length;
    to.h_m += (deficit + kTouch_m) / std::clamp(share, kLeastShare, 1.0);
  }
  return to;
}

}  // namespace

std::vector<geo::Geodetic> clear_way(const Surface& surface, const geo::Geodetic& from,
                                     const geo::Geodetic& to, const Clearance& keep) {
  geo::Geodetic here = raised(surface, from, keep);
  const Motion motion(here, to);
  const double length = std::hypot(motion.angle() * surface.ellipsoid().mean_radius(), to.h_m - here.h_m);
  std::vector<geo::Geodetic> way;
  for (double gone = 0.0; gone < 1.0;) {
    const double above = above_ground(surface, here, keep.level);
    const double step = std::max(above / std::max(length, kTouch_m), 1.0 / kMostChords);
    gone = std::min(gone + step, 1.0);
    here = raised(surface, clear_chord(surface, here, motion.at(gone), keep), keep);
    way.push_back(here);
  }
  geo::Geodetic& end = way.back();
  end.h_m = std::max(end.h_m, sight_ground(surface, end, {keep.level}) + keep.clearance_m);
  return way;
}

}  // namespace globe::planet
