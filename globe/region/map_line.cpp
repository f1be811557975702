#include "globe/region/map_line.h"

#include <algorithm>
#include <cmath>

#include "globe/base/angles.h"
#include "globe/geo/ellipsoid.h"

namespace globe::region {
double MapLine::latitude_deg(double t) const {
  // Exact at both ends.
  return t == 1.0 ? to_.lat_deg : from_.lat_deg + t * (to_.lat_deg - from_.lat_deg);
}

htm::dvec3 MapLine::at(double t) const {
  const double lon = t == 1.0 ? to_.lon_deg : from_.lon_deg + t * (to_.lon_deg - from_.lon_deg);
  return geo::normal_from_degrees(std::clamp(latitude_deg(t), -90.0, 90.0), lon);
}

double MapLine::bend(double t0, double t1) const {
  // u = (cos φ e(λ), sin φ) with φ' and λ' constant:
  // u'' = φ'² (-u) + 2 φ'λ' (-sin φ e⊥) + λ'² (-cos φ e).
  const double phi = std::abs(to_.lat_deg - from_.lat_deg) * kDegree;
  const double lambda = std::abs(to_.lon_deg - from_.lon_deg) * kDegree;
  const double lat0 = latitude_deg(t0), lat1 = latitude_deg(t1);
  const double nearest_equator = lat0 * lat1 <= 0.0 ? 0.0 : std::min(std::abs(lat0), std::abs(lat1));
  const double cosine = std::cos(nearest_equator * kDegree);
  return (phi * (phi + 2.0 * lambda) + lambda * lambda * cosine) * (1.0 + 1e-9);
}

}  // namespace globe::region
