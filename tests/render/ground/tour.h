#pragma once

#include <cstddef>
#include <random>

#include "app/accuracy/position_error.h"
#include "tests/hard/directions.h"
#include "tests/render/ground/views.h"

namespace views {

/// The k-th of `count` cameras of a tour, random places and hard ones in turn, from 0.1 m to 1e8 m above the
/// ground.
struct TourStop {
  Camera camera;
  double above_m = 0;
};
inline TourStop tour_stop(const Surface& surface, std::size_t k, std::size_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto& place = hard_places()[k / 2 % hard_places().size()];
  const dvec3 u = k % 2 == 0 ? hard::random_direction(random)
                             : globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg);
  const double above =
      0.1 * std::pow(1e9, (static_cast<double>(k) + unit(random)) / static_cast<double>(count));
  const double pitch = above > 1e5 ? -90.0 + 40.0 * unit(random) : -5.0 - 80.0 * unit(random);
  return {app::accuracy::camera_over(surface, u, above, 360.0 * unit(random), pitch), above};
}

}  // namespace views
