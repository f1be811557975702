#include "app/trixel_geojson.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "globe/geo/ellipsoid.h"
#include "globe/htm/midpoint.h"

namespace app {
namespace {

using globe::htm::dvec3;
using globe::htm::Trixel;

struct MapPoint {
  double lat_deg, lon_deg;
};

/// Longitude of the west of the octant that a trixel lies in.
double octant_west_deg(Trixel t) {
  const auto root = static_cast<int>(t.id >> (2 * globe::htm::level(t)) & 7);
  const int quarter = root < 4 ? root : 7 - root;
  return quarter < 2 ? 90.0 * quarter : 90.0 * quarter - 360.0;
}

MapPoint on_map(const dvec3& u, double west_deg) {
  const globe::geo::Geodetic at = globe::geo::degrees_from_normal(u);
  const double lon = west_deg == 90.0 && at.lon_deg < 0.0 ? at.lon_deg + 360.0 : at.lon_deg;
  return {at.lat_deg, lon + 0.0};
}

/// Points of side ab without b, halved until they are a degree apart.
void add_side(const dvec3& a, const dvec3& b, std::vector<dvec3>& points) {
  constexpr double kStep = 0.0175;
  if (glm::distance(a, b) <= kStep) {
    points.push_back(a);
    return;
  }
  const dvec3 middle = globe::htm::midpoint(a, b);
  add_side(a, middle, points);
  add_side(middle, b, points);
}

bool is_pole(const dvec3& u) { return u.x == 0.0 && u.y == 0.0; }

}  // namespace

nlohmann::ordered_json trixel_coordinates(Trixel t) {
  const auto corners = globe::htm::corners(t);
  std::vector<dvec3> points;
  for (std::size_t k = 0; k < 3; ++k) add_side(corners[k], corners[(k + 1) % 3], points);
  const double west = octant_west_deg(t);
  auto ring = nlohmann::ordered_json::array();
  const auto add = [&](double lat_deg, double lon_deg) { ring.push_back({lon_deg, lat_deg}); };
  for (std::size_t k = 0; k < points.size(); ++k) {
    const MapPoint at = on_map(points[k], west);
    if (is_pole(points[k])) {
      const std::size_t n = points.size();
      add(at.lat_deg, on_map(points[(k + n - 1) % n], west).lon_deg);
      add(at.lat_deg, on_map(points[(k + 1) % n], west).lon_deg);
    } else {
      add(at.lat_deg, at.lon_deg);
    }
  }
  const auto first = ring.front();
  ring.push_back(first);
  return nlohmann::ordered_json::array({std::move(ring)});
}

}  // namespace app
