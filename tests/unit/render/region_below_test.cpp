#include "globe/render/region_below.h"

#include <gtest/gtest.h>

#include "globe/clipmap/ground_below.h"
#include "globe/planet/surface.h"

namespace globe::render {
namespace {

TEST(RegionBelow, HeightsGoOverFromTheGlobesGroundToTheRegions) {
  const auto surface = planet::Surface::builtin(1);
  const auto settings = clipmap::Settings::for_detail(64);
  const glm::dvec3 position = geo::ecef_from_geodetic(surface->ellipsoid(), {-43.42, -106.43, 6000.0});
  const auto above = [&](const RegionBelow& region) {
    return height_above_ground(settings, *surface, position, 12, true, region);
  };
  const double globe_m = clipmap::height_above_ground(settings, *surface, position, 12, true);
  EXPECT_EQ(above({}), globe_m);
  EXPECT_EQ(above({0.0, 123.0}), globe_m);
  EXPECT_EQ(above({1.0, 123.0}), 123.0);
  EXPECT_DOUBLE_EQ(above({0.25, 123.0}), 0.25 * 123.0 + 0.75 * globe_m);
}

}  // namespace
}  // namespace globe::render
