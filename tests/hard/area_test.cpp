// The areas of all trixels of a level sum to the ellipsoid's.

#include "globe/geo/area.h"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>
#include <string>

#include "globe/htm/trixel.h"
#include "tests/hard/table.h"

namespace {

using globe::geo::Ellipsoid;

constexpr double kAreaError = 1e-12;

double level_area(const Ellipsoid& ellipsoid, int level) {
  double sum = 0, lost = 0;  // Kahan: the sum of many must not hide the error of each
  for (std::uint64_t id = globe::htm::kFirstRoot << (2 * level); id < 16ULL << (2 * level); ++id) {
    const double term = globe::geo::surface_area(ellipsoid, globe::htm::corners({id})) - lost;
    const double next = sum + term;
    lost = (next - sum) - term;
    sum = next;
  }
  return sum;
}

TEST(HardArea, OfEveryLevelSumsToTheEllipsoids) {
  const int deepest = hard::full() ? 10 : 8;
  double worst = 0;
  for (const Ellipsoid& ellipsoid : {globe::geo::kWgs84, globe::geo::kMars, globe::geo::kMoon}) {
    const double truth = GeographicLib::Geodesic(ellipsoid.a, ellipsoid.f).EllipsoidArea();
    for (int level = 0; level <= deepest; ++level) {
      const double error = std::abs(level_area(ellipsoid, level) / truth - 1);
      EXPECT_LE(error, kAreaError) << ellipsoid.f << " level " << level;
      worst = std::max(worst, error);
    }
  }
  hard::report("area", "trixels of a level against the ellipsoid, levels 0 to " + std::to_string(deepest),
               "1e-12", hard::figure(worst));
}

TEST(HardArea, NegativeControlTrixelsOfASphereDoNot) {
  const Ellipsoid sphere{globe::geo::kWgs84.mean_radius(), 0.0};
  const double truth = GeographicLib::Geodesic::WGS84().EllipsoidArea();
  EXPECT_GT(std::abs(level_area(sphere, 4) / truth - 1), 1000 * kAreaError);
}

}  // namespace
