#include "app/flight.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "globe/clipmap/ground_below.h"
#include "globe/clipmap/morph.h"
#include "globe/planet/clear_way.h"

namespace app {
namespace {

namespace geo = globe::geo;

constexpr int kSamples = 512;  ///< a step of the path is a hundredth of its height or so
constexpr double kShare = 0.25;
constexpr double kWidth = 1.0 / 12.0;
constexpr double kSharpness = 8.0;  ///< of the mean of rises: higher comes nearer to the highest of them

glm::dvec3 normal(const FlightEnd& end) {
  return geo::normal_from_degrees(end.place.lat_deg, end.place.lon_deg);
}

}  // namespace

double least_clearance(const geo::Ellipsoid& ellipsoid) { return 2.0 * geo::small_body_scale(ellipsoid); }

Flight::Flight(const globe::clipmap::Settings& settings,
               std::shared_ptr<const globe::planet::Surface> surface, int max_level, const FlightEnd& from,
               const FlightEnd& to, double heading_deg, double pitch_deg)
    : settings_(settings),
      surface_(std::move(surface)),
      max_level_(max_level),
      path_(normal(from), from.above_ground_m, normal(to), to.above_ground_m,
            surface_->ellipsoid().mean_radius(), heading_deg, pitch_deg),
      from_ground_(ground_below(from.place)),
      to_ground_(ground_below(to.place)) {
  find_rises();
}

double Flight::ground_below(geo::Geodetic place) const {
  place.h_m = 100.0 * least_clearance(surface_->ellipsoid());
  return place.h_m -
         globe::clipmap::height_above_ground(
             settings_, *surface_, geo::ecef_from_geodetic(surface_->ellipsoid(), place), max_level_, true);
}

geo::Geodetic Flight::planned(double t, globe::scene::PathPoint& point) const {
  point = path_.at(t);
  geo::Geodetic place = geo::degrees_from_normal(point.u);
  const double e = globe::scene::FlightPath::eased(t);
  place.h_m = point.height_m + from_ground_ + (to_ground_ - from_ground_) * e;
  return place;
}

void Flight::find_rises() {
  globe::scene::PathPoint point;
  geo::Geodetic before = planned(0.0, point);
  for (int k = 1; k <= kSamples; ++k) {
    const double t = static_cast<double>(k) / kSamples;
    const geo::Geodetic place = planned(t, point);
    const globe::planet::Clearance keep{
        std::max(kShare * point.height_m, least_clearance(surface_->ellipsoid())),
        globe::clipmap::finest_level(settings_, surface_->root_edge(), point.height_m, max_level_).level};
    const double raised = globe::planet::clear_way(*surface_, before, place, keep).back().h_m - place.h_m;
    if (raised > 0.0) rises_.push_back({t, std::min({kWidth, t, 1.0 - t}), raised});
    before = place;
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
  globe::scene::PathPoint point;
  View view{planned(t, point), point.heading_deg, point.pitch_deg};
  view.place.h_m += raised_by(t);
  const double above = globe::clipmap::height_above_ground(
      settings_, *surface_, geo::ecef_from_geodetic(surface_->ellipsoid(), view.place), max_level_, wait);
  view.place.h_m += std::max(least_clearance(surface_->ellipsoid()) - above, 0.0);
  return view;
}

}  // namespace app
