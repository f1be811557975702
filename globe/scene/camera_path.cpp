#include "globe/scene/camera_path.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "globe/base/angles.h"
#include "globe/scene/flight_path.h"

namespace globe::scene {
namespace {

using glm::dvec3;

constexpr double kNearPole = 0.08715574274765817;  ///< sine of 5 degrees
constexpr int kSamples = 16;                       ///< of a piece, to see how near to an axis it comes
constexpr double kRounding = 1e-12;

std::vector<double> times_of(const std::vector<PathStop>& stops) {
  std::vector<double> times;
  times.reserve(stops.size());
  for (const PathStop& stop : stops) times.push_back(stop.time_s);
  return times;
}

std::vector<bool> rests_of(const std::vector<PathStop>& stops) {
  std::vector<bool> rests;
  rests.reserve(stops.size());
  for (const PathStop& stop : stops) rests.push_back(stop.stop);
  return rests;
}

SphereCurve place_of(const std::vector<PathStop>& stops) {
  std::vector<dvec3> places;
  places.reserve(stops.size());
  for (const PathStop& stop : stops) places.push_back(stop.u);
  return {times_of(stops), std::move(places), rests_of(stops)};
}

template <class Get>
MonotoneCubic curve_of(const std::vector<PathStop>& stops, const Get& get) {
  std::vector<double> values;
  values.reserve(stops.size());
  for (std::size_t k = 0; k < stops.size(); ++k) values.push_back(get(k));
  return {times_of(stops), std::move(values), rests_of(stops)};
}

/// How near a path comes to an axis: the least sine of the angle to it or to its opposite.
double least_sine(const std::vector<double>& times, const SphereCurve& place, const dvec3& axis) {
  double least = 1.0;
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    for (int s = 0; s <= kSamples; ++s) {
      const dvec3 u = place.at(times[k] + (times[k + 1] - times[k]) * s / kSamples);
      least = std::min(least, glm::length(glm::cross(u, axis)));
    }
  }
  return least;
}

/// North, or where that comes too near, of some axes the one that the path keeps away from most.
dvec3 reference_for(const std::vector<double>& times, const SphereCurve& place) {
  const dvec3 north(0, 0, 1);
  if (least_sine(times, place, north) > kNearPole) return north;
  dvec3 best = north;
  double most = -1.0;
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const dvec3 axis = glm::normalize(dvec3(x, y, z));
        const double sine = least_sine(times, place, axis);
        if (sine <= most) continue;
        most = sine;
        best = axis;
      }
    }
  }
  return best;
}

/// Degrees clockwise, seen from above, from the direction toward a reference to a tangent.
double angle_from(const dvec3& reference, const dvec3& u, const dvec3& tangent) {
  const dvec3 ahead = reference - u * glm::dot(reference, u);
  return std::atan2(glm::dot(glm::cross(tangent, ahead), u), glm::dot(tangent, ahead)) * kRadian;
}

dvec3 turned_from(const dvec3& reference, const dvec3& u, double angle_deg) {
  const dvec3 ahead = glm::normalize(reference - u * glm::dot(reference, u));
  return ahead * std::cos(angle_deg / kRadian) + glm::cross(ahead, u) * std::sin(angle_deg / kRadian);
}

dvec3 tangent_of_heading(const dvec3& u, double heading_deg) {
  const geo::Geodetic place = geo::degrees_from_normal(u);
  return geo::look_direction(geo::local_frame(place.lat_deg, place.lon_deg), heading_deg, 0.0);
}

double heading_of_tangent(const dvec3& u, const dvec3& tangent) {
  const geo::Geodetic place = geo::degrees_from_normal(u);
  const geo::LocalFrame frame = geo::local_frame(place.lat_deg, place.lon_deg);
  return std::atan2(glm::dot(tangent, frame.east), glm::dot(tangent, frame.north)) * kRadian;
}

/// Headings of the stops from a reference, each the short way round from the one before.
std::vector<double> headings_of(const std::vector<PathStop>& stops, const SphereCurve& place,
                                const dvec3& reference) {
  std::vector<double> headings;
  headings.reserve(stops.size());
  for (std::size_t k = 0; k < stops.size(); ++k) {
    const dvec3 tangent =
        stops[k].look ? tangent_of_heading(stops[k].u, stops[k].look->heading_deg) : place.direction(k);
    double heading = angle_from(reference, stops[k].u, tangent);
    if (k > 0) heading = headings.back() + std::remainder(heading - headings.back(), 360.0);
    headings.push_back(heading);
  }
  return headings;
}

/// Rolls of the stops, each the short way round from the one before.
std::vector<double> rolls_of(const std::vector<PathStop>& stops) {
  std::vector<double> rolls;
  rolls.reserve(stops.size());
  for (const PathStop& stop : stops) {
    const double before = rolls.empty() ? 0.0 : rolls.back();
    rolls.push_back(before + std::remainder(stop.roll_deg - before, 360.0));
  }
  return rolls;
}

/// The stops from jump to jump, two or more each: at a single one the camera stays.
std::vector<std::vector<PathStop>> legs_of(const std::vector<PathStop>& stops) {
  std::vector<std::vector<PathStop>> legs;
  for (const PathStop& stop : stops) {
    if (legs.empty() || stop.jump) legs.emplace_back();
    legs.back().push_back(stop);
  }
  for (std::vector<PathStop>& leg : legs) {
    if (leg.size() > 1) continue;
    leg.push_back(leg.front());
    leg.back().time_s += 1.0;
  }
  return legs;
}

}  // namespace

CameraPath::Leg::Leg(const std::vector<PathStop>& stops, double lowest_m, double low_pitch_deg)
    : begin_s(stops.front().time_s),
      place(place_of(stops)),
      ground(curve_of(stops, [&](std::size_t k) { return stops[k].ground_m; })),
      log_above(curve_of(stops, [&](std::size_t k) { return std::log(stops[k].above_m); })),
      reference(reference_for(times_of(stops), place)),
      heading(times_of(stops), headings_of(stops, place, reference), rests_of(stops)),
      pitch(curve_of(stops,
                     [&](std::size_t k) {
                       return stops[k].look ? stops[k].look->pitch_deg
                                            : pitch_for_height(stops[k].above_m, lowest_m, low_pitch_deg);
                     })),
      roll(times_of(stops), rolls_of(stops), rests_of(stops)) {}

CameraPath::CameraPath(const std::vector<PathStop>& stops, double low_pitch_deg) : times_(times_of(stops)) {
  double lowest_m = std::numeric_limits<double>::infinity();
  for (const PathStop& stop : stops) lowest_m = std::min(lowest_m, stop.above_m);
  for (const std::vector<PathStop>& leg : legs_of(stops)) legs_.emplace_back(leg, lowest_m, low_pitch_deg);
}

CameraPath::View CameraPath::at(double time_s) const {
  // A moment told as a share of the path's time may fall short of a jump by a rounding.
  const double within = time_s + kRounding * times_.back();
  const auto after =
      std::find_if(legs_.begin() + 1, legs_.end(), [&](const Leg& one) { return one.begin_s > within; });
  const Leg& leg = *(after - 1);
  View view;
  view.u = leg.place.at(time_s);
  view.ground_m = leg.ground.at(time_s);
  view.above_m = std::exp(leg.log_above.at(time_s));
  view.heading_deg = heading_of_tangent(view.u, turned_from(leg.reference, view.u, leg.heading.at(time_s)));
  view.pitch_deg = leg.pitch.at(time_s);
  view.roll_deg = leg.roll.at(time_s);
  return view;
}

}  // namespace globe::scene
