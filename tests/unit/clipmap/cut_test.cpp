#include "globe/clipmap/cut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "globe/clipmap/drawn_surface.h"

namespace {

using namespace globe::clipmap;
namespace geo = globe::geo;

struct Cut {
  std::shared_ptr<const globe::planet::Surface> surface = globe::planet::Surface::builtin(1);
  Settings settings = Settings::for_detail(64);
  dvec3 place, up, east, north;
  FinestLevel shown{0, 0.0f};
  std::shared_ptr<const ClipmapState> state;

  Cut(double lat_deg, double lon_deg, double above_m) {
    settings.shading_levels = 0;
    const dvec3 u = geo::normal_from_degrees(lat_deg, lon_deg);
    place = geo::ecef_from_normal(surface->ellipsoid(), u, surface->height(u, 12));
    up = u;
    east = glm::normalize(glm::cross(dvec3(0.0, 0.0, 1.0), u));
    north = glm::cross(u, east);
    shown = finest_level(settings, surface->root_edge(), above_m, 26);
    state = advance(settings, *surface, {u, shown.level, {}}, nullptr, Stride::kWhole).state;
  }

  std::vector<std::array<dvec3, 2>> along(const dvec3& direction, double radius) const {
    return cut(settings, *state, shown, {place, glm::cross(up, direction), radius});
  }
};

TEST(ClipmapCut, RunsAlongTheTrianglesThatAreDrawn) {
  for (const double above_m : {40.0, 3000.0, 200'000.0}) {
    const Cut ground(-43.42, -106.43, above_m);
    const DrawnSurface drawn(ground.settings, ground.surface, ground.state, ground.shown.level,
                             ground.shown.fade);
    const auto segments = ground.along(glm::normalize(ground.east + 0.3 * ground.north), 30.0 * above_m);
    ASSERT_GT(segments.size(), 50u);
    double worst = 0.0;
    for (std::size_t k = 0; k < segments.size(); k += segments.size() / 50) {
      const dvec3 middle = 0.5 * (segments[k][0] + segments[k][1]);
      const auto hit = drawn.first_hit({middle + 30'000.0 * ground.up, -ground.up});
      ASSERT_TRUE(hit);
      worst = std::max(worst, glm::distance(hit->position, middle));
    }
    // Resident positions are rounded to fp32 of their distance from the level's anchor.
    EXPECT_LT(worst, 1e-5 * above_m + 1e-3) << above_m;
  }
}

TEST(ClipmapCut, LeavesNoGapAndCrossesEveryTriangleOnce) {
  const Cut ground(-43.42, -106.43, 500.0);
  constexpr double kReach = 12'000.0;
  for (const dvec3& direction : {ground.east, ground.north, glm::normalize(ground.east - ground.north)}) {
    std::vector<std::array<double, 2>> stretches;
    for (const auto& segment : ground.along(direction, kReach)) {
      std::array along{glm::dot(segment[0] - ground.place, direction),
                       glm::dot(segment[1] - ground.place, direction)};
      std::sort(along.begin(), along.end());
      stretches.push_back(along);
    }
    std::sort(stretches.begin(), stretches.end());
    EXPECT_LT(stretches.front()[0], -kReach);
    EXPECT_GT(stretches.back()[1], kReach);
    for (std::size_t k = 1; k < stretches.size(); ++k)
      ASSERT_NEAR(stretches[k][0], stretches[k - 1][1], 0.01) << stretches[k][0];
  }
}

TEST(ClipmapCut, IsEmptyWhereTheBallTouchesNoGround) {
  Cut ground(-43.42, -106.43, 500.0);
  ground.place += 50'000.0 * ground.up;
  EXPECT_TRUE(ground.along(ground.east, 1000.0).empty());
}

}  // namespace
