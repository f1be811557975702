#include "converters/thesis_mapping.h"

#include "globe/planet/grid.h"

namespace converters {
namespace {

/// Finer vertices are placed linearly in this level's trixels: off by less than a millimetre on the Earth.
constexpr int kLevel = 12;

}  // namespace

globe::geo::dvec3 thesis_direction(const globe::geo::dvec3& u) {
  const globe::planet::Place place = globe::planet::locate(u, kLevel);
  const double n = globe::planet::nodes_per_side(kLevel);
  const double row = place.ij.x + place.ij.y;  // 0 at the north pole, n at the equator, 2n at the south pole
  const double length = row <= n ? row : 2.0 * n - row;
  const double east = row <= n ? place.ij.y : n - place.ij.x;
  const double share = length > 0.0 ? east / length : 0.0;
  return globe::geo::normal_from_degrees(90.0 * (1.0 - row / n), 90.0 * (place.d + share));
}

}  // namespace converters
