#include "app/view/glide.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "globe/base/angles.h"

namespace app::view {
namespace {

namespace geo = globe::geo;
using glm::dvec3;
using globe::kDegree;
using globe::scene::FlightPath;

constexpr double kShortest = 0.5, kLongest = 5.0;  ///< seconds

dvec3 normal_of(const geo::Geodetic& place) { return geo::normal_from_degrees(place.lat_deg, place.lon_deg); }

double positive(double above_m, const geo::Ellipsoid& ellipsoid) {
  return std::max(above_m, least_clearance(ellipsoid));
}

/// Direction of the great circle at a normal, degrees from north.
double track_deg(const dvec3& at, const dvec3& begin, const dvec3& end) {
  const dvec3 ahead = glm::cross(glm::cross(begin, globe::scene::track_direction(begin, end)), at);
  const geo::Geodetic place = geo::degrees_from_normal(at);
  const geo::LocalFrame frame = geo::local_frame(place.lat_deg, place.lon_deg);
  return std::atan2(glm::dot(ahead, frame.east), glm::dot(ahead, frame.north)) / kDegree;
}

}  // namespace

Glide::Glide(const geo::Ellipsoid& ellipsoid, const Standpoint& from, double from_above_m,
             const Standpoint& to, double to_above_m)
    : path_(normal_of(from.place), positive(from_above_m, ellipsoid), normal_of(to.place),
            positive(to_above_m, ellipsoid), ellipsoid.mean_radius(), to.look.heading_deg, to.look.pitch_deg),
      from_(from),
      to_(to),
      from_ground_m_(from.place.h_m - positive(from_above_m, ellipsoid)),
      to_ground_m_(to.place.h_m - positive(to_above_m, ellipsoid)),
      begin_(normal_of(from.place)),
      end_(normal_of(to.place)) {
  const double way = glm::distance(begin_, end_) * ellipsoid.mean_radius();
  const double lower = std::min(positive(from_above_m, ellipsoid), positive(to_above_m, ellipsoid));
  has_track_ = way > 1e-3 * lower;
  from_turn_ = from.look.heading_deg - (has_track_ ? track_deg(begin_, begin_, end_) : 0.0);
  const double to_turn = to.look.heading_deg - (has_track_ ? track_deg(end_, begin_, end_) : 0.0);
  turned_deg_ = std::remainder(to_turn - from_turn_, 360.0);
  const double zoomed =
      std::abs(std::log(positive(to_above_m, ellipsoid) / positive(from_above_m, ellipsoid)));
  duration_s_ = std::clamp(0.6 + 0.3 * zoomed + 0.35 * std::log1p(way / lower), kShortest, kLongest);
}

Standpoint Glide::at(double seconds) const {
  const double t = seconds / duration_s_;
  if (t >= 1.0) return to_;
  const globe::scene::PathPoint point = path_.at(t);
  const double e = FlightPath::eased(t);
  Standpoint stand;
  stand.place = geo::degrees_from_normal(point.u);
  stand.place.h_m = point.height_m + from_ground_m_ + e * (to_ground_m_ - from_ground_m_);
  const double track = has_track_ ? track_deg(point.u, begin_, end_) : 0.0;
  stand.look.heading_deg = std::remainder(track + from_turn_ + e * turned_deg_, 360.0);
  stand.look.pitch_deg = from_.look.pitch_deg + e * (to_.look.pitch_deg - from_.look.pitch_deg);
  return stand;
}

}  // namespace app::view
