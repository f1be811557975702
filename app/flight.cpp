#include "app/flight.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "globe/clipmap/ground_below.h"
#include "globe/clipmap/morph.h"
#include "globe/planet/clear_way.h"
#include "globe/scene/camera_path.h"
#include "globe/scene/flight_path.h"

namespace app {
namespace {

namespace geo = globe::geo;

constexpr int kFlightSamples = 512;  ///< a step of the path is a hundredth of its height or so
constexpr int kPieceSamples = 8;     ///< at least, between two places of a path
constexpr int kMostSamples = 8192;
constexpr double kClearShare = 0.25;
constexpr double kEasedShare = 1.0 / 12.0;
constexpr double kLeastEasedShare = kEasedShare / 4.0;  ///< by the places of a path
constexpr double kSharpness = 8.0;  ///< of the mean of rises: higher comes nearer to the highest of them

glm::dvec3 normal(const FlightEnd& end) {
  return geo::normal_from_degrees(end.place.lat_deg, end.place.lon_deg);
}

}  // namespace

double least_clearance(const geo::Ellipsoid& ellipsoid) { return 2.0 * geo::small_body_scale(ellipsoid); }

Flight::Flight(const globe::clipmap::Settings& settings,
               std::shared_ptr<const globe::planet::Surface> surface, int max_level, const FlightEnd& from,
               const FlightEnd& to, const Look& look)
    : settings_(settings), surface_(std::move(surface)), max_level_(max_level) {
  const globe::scene::FlightPath path(normal(from), from.above_ground_m, normal(to), to.above_ground_m,
                                      surface_->ellipsoid().mean_radius(), look.heading_deg, look.pitch_deg);
  plan_ = [path, roll_deg = look.roll_deg, from_ground = ground_below(from.place),
           to_ground = ground_below(to.place)](double t) {
    const globe::scene::PathPoint point = path.at(t);
    geo::Geodetic place = geo::degrees_from_normal(point.u);
    const double e = globe::scene::FlightPath::eased(t);
    place.h_m = point.height_m + from_ground + (to_ground - from_ground) * e;
    return Planned{{place, {point.heading_deg, point.pitch_deg, roll_deg}}, point.height_m};
  };
  find_rises({0.0, 1.0});
}

Flight::Flight(const globe::clipmap::Settings& settings,
               std::shared_ptr<const globe::planet::Surface> surface, int max_level,
               const globe::scene::Path& path)
    : settings_(settings), surface_(std::move(surface)), max_level_(max_level) {
  const globe::scene::CameraPath way(
      globe::scene::stops_of(
          path.keys, surface_->ellipsoid(), [&](const geo::Geodetic& place) { return ground_below(place); },
          least_clearance(surface_->ellipsoid())),
      path.low_pitch_deg);
  duration_s_ = path.duration_s.value_or(way.duration_s());
  std::vector<double> marks = way.times();
  for (double& mark : marks) mark /= way.duration_s();
  plan_ = [way](double t) {
    const globe::scene::CameraPath::View view = way.at(t * way.duration_s());
    geo::Geodetic place = geo::degrees_from_normal(view.u);
    place.h_m = view.ground_m + view.above_m;
    return Planned{{place, {view.heading_deg, view.pitch_deg, view.roll_deg}}, view.above_m};
  };
  find_rises(marks);
}

double Flight::ground_below(geo::Geodetic place) const {
  place.h_m = 100.0 * least_clearance(surface_->ellipsoid());
  return place.h_m -
         globe::clipmap::height_above_ground(
             settings_, *surface_, geo::ecef_from_geodetic(surface_->ellipsoid(), place), max_level_, true);
}

void Flight::find_rises(const std::vector<double>& marks) {
  const int least = std::min(kPieceSamples, kMostSamples / static_cast<int>(marks.size()));
  for (auto leg = marks.begin(); leg != marks.end();) {
    auto end = std::adjacent_find(leg, marks.end());  // twice the same: a jump
    if (end != marks.end()) ++end;
    find_rises_of_leg({leg, end}, least);
    leg = end;
  }
}

void Flight::find_rises_of_leg(std::span<const double> marks, int least_samples) {
  geo::Geodetic before = plan_(marks.front()).view.place;
  for (std::size_t piece = 0; piece + 1 < marks.size(); ++piece) {
    const double begin = marks[piece], end = marks[piece + 1];
    const int samples =
        std::max({static_cast<int>(std::ceil(kFlightSamples * (end - begin))), least_samples, 1});
    for (int k = 1; k <= samples; ++k) {
      const double t = k == samples ? end : begin + (end - begin) * k / samples;
      if (t >= marks.back()) return;  // nothing is raised there, and it may be where a jump leads
      const Planned planned = plan_(t);
      const geo::Geodetic& place = planned.view.place;
      const globe::planet::Clearance keep{
          std::max(kClearShare * planned.above_m, least_clearance(surface_->ellipsoid())),
          globe::clipmap::finest_level(settings_, surface_->root_edge(), planned.above_m, max_level_).level};
      const double raised = globe::planet::clear_way(*surface_, before, place, keep).back().h_m - place.h_m;
      before = place;
      const double width = std::min({kEasedShare, t - marks.front(), marks.back() - t,
                                     std::max(std::min(t - begin, end - t), kLeastEasedShare)});
      if (raised > 0.0 && width > 0.0) rises_.push_back({t, width, raised});
    }
  }
}

double Flight::raised_by(double t) const {
  // A mean that leans to the highest: smooth where the highest changes, and never below it.
  double highest = 0.0;
  for (const Rise& rise : rises_) highest = std::max(highest, rise.metres);
  double sum = 0.0;
  for (const Rise& rise : rises_) {
    const double x = (t - rise.t) / rise.width;
    if (std::abs(x) >= 1.0) continue;
    const double near = (1.0 - x * x) * (1.0 - x * x) * (1.0 - x * x);
    sum += std::pow(near * rise.metres / highest, kSharpness);
  }
  return sum > 0.0 ? highest * std::pow(sum, 1.0 / kSharpness) : 0.0;
}

Flight::View Flight::at(double t, bool wait) const {
  View view = plan_(t).view;
  view.place.h_m += raised_by(t);
  const double above = globe::clipmap::height_above_ground(
      settings_, *surface_, geo::ecef_from_geodetic(surface_->ellipsoid(), view.place), max_level_, wait);
  view.place.h_m += std::max(least_clearance(surface_->ellipsoid()) - above, 0.0);
  return view;
}

}  // namespace app
