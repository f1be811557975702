#include "app/view/motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "globe/base/angles.h"
#include "globe/geo/ellipsoid.h"

namespace {

namespace geo = globe::geo;
using app::Standpoint;
using app::view::Eye;
using glm::dvec2;
using glm::dvec3;

const Eye kEye{geo::kWgs84, 60.0, {1280.0, 720.0}};

/// Standpoints of every height and latitude, the poles' neighbourhood among them, that look at ground.
class AnyView {
 public:
  explicit AnyView(unsigned seed) : random_(seed) {}

  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  Standpoint standpoint(double highest_pitch) {
    const double lat = std::asin(between(-1.0, 1.0)) / globe::kDegree;
    const double near_pole = between(0.0, 1.0) < 0.2 ? 90.0 - std::pow(10.0, between(-6.0, 0.5)) : lat;
    return {{near_pole, between(-180.0, 180.0), std::pow(10.0, between(0.7, 7.3))},
            {between(-180.0, 180.0), between(-90.0, highest_pitch)}};
  }

  dvec2 pixel() { return {between(100.0, 1180.0), between(60.0, 660.0)}; }

 private:
  std::mt19937 random_;
};

/// What is seen at a pixel of bare ground.
std::optional<dvec3> ground_at(const Standpoint& stand, dvec2 pixel) {
  const globe::render::Camera camera = kEye.camera(stand);
  const dvec3 direction = kEye.direction(camera, pixel);
  const double way = geo::ray_ellipsoid(geo::kWgs84, 0.0, camera.position, direction);
  if (way <= 0.0) return std::nullopt;
  return camera.position + way * direction;
}

double miss(const Standpoint& stand, const dvec3& place, dvec2 pixel) {
  const auto seen = kEye.pixel_of(kEye.camera(stand), place);
  return seen ? glm::distance(*seen, pixel) : 1e9;
}

TEST(ViewMotion, APlaceThatIsHeldStaysUnderThePointer) {
  AnyView any(1);
  int tried = 0, held = 0;
  for (int k = 0; k < 3000; ++k) {
    const Standpoint stand = any.standpoint(-10.0);
    const dvec2 from = any.pixel();
    const auto place = ground_at(stand, from);
    const dvec2 to = from + dvec2(any.between(-40.0, 40.0), any.between(-40.0, 40.0));
    if (!place || !ground_at(stand, to)) continue;
    ++tried;
    const auto turn = app::view::turn_to_hold(kEye, stand, *place, to);
    if (!turn) continue;  // beside the horizon a pixel may be thousands of kilometres
    ++held;
    const Standpoint after = app::view::carried(geo::kWgs84, stand, *turn);
    EXPECT_LT(miss(after, *place, to), 0.25) << stand.place.lat_deg << ' ' << stand.place.h_m;
    EXPECT_EQ(after.place.h_m, stand.place.h_m);
    EXPECT_EQ(after.look.pitch_deg, stand.look.pitch_deg);
  }
  EXPECT_GT(tried, 1000);
  EXPECT_GT(held, tried * 98 / 100);
}

TEST(ViewMotion, NorthDoesNotDriftAwayFromThePoles) {
  const Standpoint stand{{45.0, 10.0, 1e6}, {0.0, -90.0}};
  const geo::LocalFrame frame = geo::local_frame(45.0, 10.0);
  const Standpoint after = app::view::carried(geo::kWgs84, stand, 0.05 * frame.north + 0.02 * frame.east);
  EXPECT_NE(after.place.lon_deg, stand.place.lon_deg);
  EXPECT_EQ(after.look.heading_deg, 0.0);
}

TEST(ViewMotion, DraggingOverAPoleTurnsNoPicture) {
  Standpoint stand{{84.0, 20.0, 8e5}, {0.0, -90.0}};
  const dvec3 axis = glm::normalize(glm::cross(geo::normal_from_degrees(84.0, 20.0), dvec3(0.02, 0.01, 1.0)));
  const double step = 0.25 * globe::kDegree;
  for (int k = 0; k < 60; ++k) {
    const dvec3 up_before = kEye.camera(stand).up;
    stand = app::view::carried(geo::kWgs84, stand, step * axis);
    const double turned = std::acos(std::min(glm::dot(up_before, kEye.camera(stand).up), 1.0));
    EXPECT_LT(turned, 1.5 * step) << k << ": latitude " << stand.place.lat_deg;
  }
  EXPECT_LT(stand.place.lat_deg, 84.0);
}

/// Whether some level look from there has the place at a pixel: what lies steeply below is never far to the
/// side.
bool can_see_level(const Standpoint& stand, const dvec3& place, dvec2 pixel) {
  const dvec3 seen = glm::normalize(kEye.direction_in_view(pixel));
  const dvec3 up = geo::local_frame(stand.place.lat_deg, stand.place.lon_deg).up;
  const dvec3 toward = glm::normalize(place - kEye.camera(stand).position);
  return std::abs(glm::dot(toward, up)) <= std::hypot(seen.y, seen.z);
}

TEST(ViewMotion, ComingNearerKeepsThePlaceAtItsPixel) {
  AnyView any(2);
  int tried = 0, beside = 0;
  for (int k = 0; k < 2000; ++k) {
    const Standpoint stand = any.standpoint(-3.0);
    const dvec2 pixel = any.pixel();
    const auto place = ground_at(stand, pixel);
    if (!place) continue;
    ++tried;
    const double factor = any.between(0.6, 1.6);
    const Standpoint after = app::view::approached(kEye, stand, *place, pixel, factor);
    if (!can_see_level(after, *place, pixel)) {
      ++beside;
      EXPECT_GT(factor, 1.0);
    } else {
      EXPECT_LT(miss(after, *place, pixel), 0.5)
          << stand.place.lat_deg << ' ' << stand.place.h_m << ' ' << factor;
    }
    const double before = glm::distance(kEye.camera(stand).position, *place);
    const double now = glm::distance(kEye.camera(after).position, *place);
    EXPECT_EQ(now < before, factor < 1.0);
  }
  EXPECT_GT(tried, 800);
  EXPECT_LT(beside, tried / 50);
}

TEST(ViewMotion, AWheelTurnedInAndOutAgainLeadsBack) {
  const Standpoint stand{{30.0, 40.0, 5e6}, {20.0, -90.0}};
  const dvec2 pixel{700.0, 400.0};
  const auto place = ground_at(stand, pixel);
  ASSERT_TRUE(place);
  Standpoint there = stand;
  for (int k = 0; k < 40; ++k) there = app::view::approached(kEye, there, *place, pixel, 0.8);
  EXPECT_LT(there.place.h_m, 2000.0);
  for (int k = 0; k < 40; ++k) there = app::view::approached(kEye, there, *place, pixel, 1.25);
  EXPECT_NEAR(there.place.lat_deg, 30.0, 0.05);
  EXPECT_NEAR(there.place.lon_deg, 40.0, 0.05);
  EXPECT_NEAR(there.place.h_m, 5e6, 2e4);
}

TEST(ViewMotion, SwingingAroundAPlaceKeepsItsDistanceAndItsPixel) {
  AnyView any(3);
  const dvec2 middle = 0.5 * kEye.size;
  int tried = 0;
  for (int k = 0; k < 2000; ++k) {
    const Standpoint stand = any.standpoint(-5.0);
    const auto place = ground_at(stand, middle);
    if (!place) continue;
    ++tried;
    const dvec2 by{any.between(-30.0, 30.0), any.between(-20.0, 20.0)};
    const Standpoint after = app::view::swung(kEye, stand, *place, middle, by);
    const double before = glm::distance(kEye.camera(stand).position, *place);
    EXPECT_NEAR(glm::distance(kEye.camera(after).position, *place), before, 1e-6 * before);
    EXPECT_LT(miss(after, *place, middle), 0.1) << stand.place.lat_deg << ' ' << stand.place.h_m;
  }
  EXPECT_GT(tried, 800);
}

TEST(ViewMotion, LiftedToTheZenithItLooksStraightDown) {
  const Standpoint stand{{10.0, 20.0, 3000.0}, {75.0, -30.0}};
  const auto place = ground_at(stand, 0.5 * kEye.size);
  ASSERT_TRUE(place);
  const Standpoint after = app::view::swung(kEye, stand, *place, 0.5 * kEye.size, {0.0, 90.0});
  EXPECT_EQ(after.look.pitch_deg, -90.0);
  EXPECT_NEAR(after.look.heading_deg, 75.0, 0.1);
}

TEST(ViewMotion, AimingFindsTheLookThatSeesADirectionAtAPixel) {
  AnyView any(4);
  for (int k = 0; k < 2000; ++k) {
    const Standpoint stand = any.standpoint(-20.0);
    const dvec2 pixel = any.pixel();
    const dvec3 direction = kEye.direction(kEye.camera(stand), pixel);
    const app::Look look = app::view::aimed(kEye, stand, direction, pixel);
    const Standpoint again{stand.place, look};
    EXPECT_GT(glm::dot(kEye.direction(kEye.camera(again), pixel), direction), 1.0 - 1e-12);
  }
}

}  // namespace
