#include "app/view/motion.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/matrix.hpp>

#include "globe/base/angles.h"

namespace app::view {
namespace {

namespace geo = globe::geo;
using glm::dvec2;
using glm::dvec3;
using globe::kDegree;

constexpr double kFreeFrom = 60.0, kFreeTo = 80.0;   ///< degrees of latitude
constexpr double kFarthestTurn = 3.0;                ///< ways to the place held
constexpr double kExact = 1e-3, kGoodEnough = 0.25;  ///< pixels
constexpr double kLeastElevation = 0.5;              ///< degrees, seen from a place that it swings around

/// Rodrigues' formula.
dvec3 rotated(const dvec3& v, const dvec3& turn) {
  const double angle = glm::length(turn);
  if (angle == 0.0) return v;
  const dvec3 axis = turn / angle;
  const double half = std::sin(0.5 * angle);
  const dvec3 across = glm::cross(axis, v);
  // v + sin a (k x v) + (1 - cos a) k x (k x v): small angles lose nothing.
  return v + std::sin(angle) * across + 2.0 * half * half * glm::cross(axis, across);
}

double folded_deg(double angle) { return std::remainder(angle, 360.0); }

/// 0: the heading is kept; 1: the picture is.
double freedom(double lat_deg) {
  const double x = std::clamp((std::abs(lat_deg) - kFreeFrom) / (kFreeTo - kFreeFrom), 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

double azimuth_deg(const geo::LocalFrame& frame, const dvec3& direction) {
  return std::atan2(glm::dot(direction, frame.east), glm::dot(direction, frame.north)) / kDegree;
}

}  // namespace

Standpoint carried(const geo::Ellipsoid& ellipsoid, const Standpoint& stand, const dvec3& turn) {
  const geo::LocalFrame before = geo::local_frame(stand.place.lat_deg, stand.place.lon_deg);
  Standpoint moved = stand;
  moved.place =
      geo::geodetic_from_ecef(ellipsoid, rotated(geo::ecef_from_geodetic(ellipsoid, stand.place), turn));
  moved.place.h_m = stand.place.h_m;
  const geo::LocalFrame after = geo::local_frame(moved.place.lat_deg, moved.place.lon_deg);
  const dvec3 ahead = rotated(geo::look_direction(before, stand.look.heading_deg, 0.0), turn);
  const double free = freedom(std::max(std::abs(stand.place.lat_deg), std::abs(moved.place.lat_deg)));
  const double drift = folded_deg(azimuth_deg(after, ahead) - stand.look.heading_deg);
  moved.look.heading_deg = folded_deg(stand.look.heading_deg + free * drift);
  return moved;
}

std::optional<dvec3> turn_to_hold(const Eye& eye, const Standpoint& stand, const dvec3& place, dvec2 pixel) {
  const dvec3 position = geo::ecef_from_geodetic(eye.ellipsoid, stand.place);
  const geo::LocalFrame frame = geo::local_frame(stand.place.lat_deg, stand.place.lon_deg);
  const double way = glm::distance(position, place);
  const double scale = way / glm::length(position);  // of the turns, radians
  const auto turn_of = [&](dvec2 step) { return scale * (step.x * frame.east + step.y * frame.north); };
  const auto off = [&](dvec2 step) -> std::optional<dvec2> {
    const auto seen = eye.pixel_of(eye.camera(carried(eye.ellipsoid, stand, turn_of(step))), place);
    if (!seen) return std::nullopt;
    return *seen - pixel;
  };
  dvec2 step{0.0};
  std::optional<dvec2> miss = off(step);
  for (int round = 0; miss && round < 30 && glm::length(*miss) > kExact; ++round) {
    constexpr double kNudge = 1e-5;
    glm::dmat2 slope;
    for (int k = 0; k < 2; ++k) {
      dvec2 nudge{0.0};
      nudge[k] = kNudge;
      const auto more = off(step + nudge), less = off(step - nudge);
      if (!more || !less) return std::nullopt;
      slope[k] = (*more - *less) / (2.0 * kNudge);
    }
    if (std::abs(glm::determinant(slope)) < 1e-9) break;
    dvec2 move = -(glm::inverse(slope) * *miss);
    // A step that makes it worse is halved.
    std::optional<dvec2> next;
    for (int halving = 0; halving < 12; ++halving, move *= 0.5) {
      next = off(step + move);
      if (next && glm::length(*next) < glm::length(*miss)) break;
      next.reset();
    }
    if (!next) break;
    step += move;
    miss = next;
  }
  if (!miss || glm::length(*miss) > kGoodEnough || glm::length(step) > kFarthestTurn) return std::nullopt;
  return turn_of(step);
}

Standpoint approached(const Eye& eye, const Standpoint& stand, const dvec3& place, dvec2 pixel,
                      double factor) {
  const dvec3 position = geo::ecef_from_geodetic(eye.ellipsoid, stand.place);
  Standpoint nearer{geo::geodetic_from_ecef(eye.ellipsoid, place + factor * (position - place)), stand.look};
  if (const auto turn = turn_to_hold(eye, nearer, place, pixel)) return carried(eye.ellipsoid, nearer, *turn);
  nearer.look = aimed(eye, nearer, place - geo::ecef_from_geodetic(eye.ellipsoid, nearer.place), pixel);
  return nearer;
}

Standpoint swung(const Eye& eye, const Standpoint& stand, const dvec3& place, dvec2 pixel, dvec2 by_deg) {
  const dvec3 from = geo::ecef_from_geodetic(eye.ellipsoid, stand.place) - place;
  const double way = glm::length(from);
  const geo::Geodetic foot = geo::geodetic_from_ecef(eye.ellipsoid, place);
  const geo::LocalFrame frame = geo::local_frame(foot.lat_deg, foot.lon_deg);
  const double elevation = std::asin(std::clamp(glm::dot(from, frame.up) / way, -1.0, 1.0)) / kDegree;
  // From the zenith of the place it is the heading that says which way it leans over.
  const bool overhead = elevation > 89.99;
  const double azimuth = overhead ? stand.look.heading_deg + 180.0 : azimuth_deg(frame, from);
  const double lifted =
      std::clamp(elevation + by_deg.y, std::min(kLeastElevation, elevation), std::max(90.0, elevation));
  Standpoint around = stand;
  const dvec3 back = geo::look_direction(frame, azimuth + by_deg.x, lifted);
  around.place = geo::geodetic_from_ecef(eye.ellipsoid, place + way * back);
  if (lifted > 89.99) {
    around.look = {folded_deg(azimuth + by_deg.x + 180.0), -90.0, 0.0};
    if (glm::length(pixel - 0.5 * eye.size) < 0.5) return around;
  }
  around.look = aimed(eye, around, -back, pixel);
  return around;
}

Standpoint turned(const Standpoint& stand, dvec2 by_deg) {
  Standpoint after = stand;
  after.look.heading_deg = folded_deg(stand.look.heading_deg + by_deg.x);
  after.look.pitch_deg = std::clamp(stand.look.pitch_deg + by_deg.y, -90.0, 90.0);
  return after;
}

}  // namespace app::view
