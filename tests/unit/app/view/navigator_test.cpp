#include "app/view/navigator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <random>

#include "app/flight.h"
#include "globe/geo/ellipsoid.h"

namespace {

namespace geo = globe::geo;
using app::Standpoint;
using app::view::Eye;
using app::view::Navigator;
using glm::dvec2;
using glm::dvec3;

const Eye kWindow{geo::kWgs84, 60.0, {1280.0, 720.0}};

/// A navigator over a bare ellipsoid grown by some metres.
struct Flown {
  explicit Flown(const Standpoint& start, double ground_m = 0.0)
      : ground(ground_m),
        navigator(kWindow,
                  {[this](dvec2 pixel) { return seen_at(pixel); },
                   [this](const dvec3& at) { return geo::geodetic_from_ecef(geo::kWgs84, at).h_m - ground; }},
                  start) {}

  std::optional<dvec3> seen_at(dvec2 pixel) const {
    const globe::render::Camera camera = navigator.camera();
    const dvec3 direction = kWindow.direction(camera, pixel);
    const double way = geo::ray_ellipsoid(geo::kWgs84, ground, camera.position, direction);
    if (way <= 0.0) return std::nullopt;
    return camera.position + way * direction;
  }

  double above() const { return navigator.stand().place.h_m - ground; }

  void settle(double fps = 60.0) {
    for (int k = 0; k < 20 * fps && navigator.is_moving(); ++k) navigator.advance(1.0 / fps);
  }

  double ground;
  Navigator navigator;
};

TEST(Navigator, ADragKeepsTheGrabbedPlaceUnderThePointerAllTheWay) {
  Flown flown({{40.0, 10.0, 2e6}, {0.0, -90.0}});
  const dvec2 from{640.0, 360.0};
  const dvec3 place = *flown.seen_at(from);
  flown.navigator.press(Navigator::Grip::kGrab, from, 0.0);
  for (int k = 1; k <= 50; ++k) {
    const dvec2 pixel = from + dvec2(6.0 * k, 3.0 * k);
    flown.navigator.move(pixel, 0.01 * k);
    EXPECT_LT(glm::distance(*kWindow.pixel_of(flown.navigator.camera(), place), pixel), 0.3) << k;
  }
}

TEST(Navigator, ADragThatRestsBeforeItIsLetGoDoesNotRollOn) {
  Flown flown({{40.0, 10.0, 2e6}, {0.0, -90.0}});
  flown.navigator.press(Navigator::Grip::kGrab, {640.0, 360.0}, 0.0);
  flown.navigator.move({700.0, 360.0}, 0.05);
  flown.navigator.release(0.5);
  EXPECT_FALSE(flown.navigator.is_moving());
}

TEST(Navigator, APlanetLetGoInAHurryRollsOnAlikeAtAnyFrameRate) {
  const auto rolled = [](double fps) {
    Flown flown({{10.0, 10.0, 2e6}, {0.0, -90.0}});
    flown.navigator.press(Navigator::Grip::kGrab, {640.0, 360.0}, 0.0);
    for (int k = 1; k <= 5; ++k) flown.navigator.move({640.0 + 12.0 * k, 360.0}, 0.01 * k);
    flown.navigator.release(0.055);
    EXPECT_TRUE(flown.navigator.is_moving());
    const double before = flown.navigator.stand().place.lon_deg;
    flown.settle(fps);
    EXPECT_FALSE(flown.navigator.is_moving());
    return before - flown.navigator.stand().place.lon_deg;
  };
  const double fast = rolled(120.0), slow = rolled(10.0);
  EXPECT_GT(fast, 1.0);
  EXPECT_NEAR(slow, fast, 0.03 * fast);
}

TEST(Navigator, TheWheelComesNearerToWhatIsUnderThePointer) {
  Flown flown({{20.0, 30.0, 1e7}, {0.0, -90.0}});
  const dvec2 pixel{800.0, 300.0};
  const dvec3 place = *flown.seen_at(pixel);
  for (int k = 0; k < 30; ++k) {
    flown.navigator.zoom(1.0, pixel);
    flown.navigator.advance(0.016);
  }
  flown.settle();
  EXPECT_LT(flown.above(), 3e4);
  EXPECT_LT(glm::distance(*kWindow.pixel_of(flown.navigator.camera(), place), pixel), 2.0);
}

TEST(Navigator, NothingLeadsUnderTheGroundOrAwayForGood) {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Flown flown({{89.5, 30.0, 4000.0}, {0.0, -40.0}}, 3500.0);
  double time = 0.0;
  for (int k = 0; k < 3000; ++k) {
    time += 0.02;
    const dvec2 pixel{between(0.0, 1280.0), between(0.0, 720.0)};
    switch (static_cast<int>(between(0.0, 7.0))) {
      case 0:
        flown.navigator.press(Navigator::Grip::kGrab, pixel, time);
        break;
      case 1:
        flown.navigator.press(Navigator::Grip::kSwing, pixel, time);
        break;
      case 2:
        flown.navigator.move(pixel, time);
        break;
      case 3:
        flown.navigator.release(time);
        break;
      case 4:
        flown.navigator.zoom(between(-4.0, 4.0), pixel);
        break;
      case 5:
        flown.navigator.double_click(pixel);
        break;
      default:
        flown.navigator.drive(
            {{between(-5.0, 5.0), between(-5.0, 5.0), between(-5.0, 5.0)}, {between(-1.0, 1.0), 0.0}});
    }
    flown.navigator.advance(0.02);
    const Standpoint& stand = flown.navigator.stand();
    ASSERT_GE(flown.above(), app::least_clearance(geo::kWgs84) * 0.999) << k;
    ASSERT_LE(stand.place.h_m, 11.0 * geo::kWgs84.a) << k;
    ASSERT_TRUE(std::isfinite(stand.place.lat_deg + stand.place.lon_deg + stand.look.heading_deg)) << k;
    ASSERT_LE(std::abs(stand.look.pitch_deg), 90.0) << k;
  }
}

TEST(Navigator, AFlightEndsWhereItWasSentAndNeverJumps) {
  const Standpoint from{{-35.0, 170.0, 3000.0}, {120.0, -15.0}};
  const Standpoint to{{60.0, -170.0, 500.0}, {-80.0, -30.0}};
  Flown flown(from);
  flown.navigator.fly_to(to);
  dvec3 before = flown.navigator.camera().position;
  dvec3 ahead = flown.navigator.camera().forward;
  for (int k = 0; k < 6000 && flown.navigator.is_moving(); ++k) {
    flown.navigator.advance(1e-3);
    const globe::render::Camera camera = flown.navigator.camera();
    // In a thousandth of a second it covers a small part of its height above ground.
    EXPECT_LT(glm::distance(camera.position, before), 0.05 * std::max(flown.above(), 500.0)) << k;
    EXPECT_GT(glm::dot(camera.forward, ahead), std::cos(0.01)) << k;
    before = camera.position;
    ahead = camera.forward;
  }
  EXPECT_FALSE(flown.navigator.is_moving());
  EXPECT_EQ(flown.navigator.stand().place.lat_deg, to.place.lat_deg);
  EXPECT_EQ(flown.navigator.stand().place.h_m, to.place.h_m);
  EXPECT_EQ(flown.navigator.stand().look.heading_deg, to.look.heading_deg);
}

TEST(Navigator, ADoubleClickBringsThePlaceToTheMiddle) {
  Flown flown({{20.0, 30.0, 5000.0}, {45.0, -40.0}});
  const dvec2 pixel{900.0, 500.0};
  const dvec3 place = *flown.seen_at(pixel);
  const double way = glm::distance(place, flown.navigator.camera().position);
  flown.navigator.double_click(pixel);
  flown.settle();
  EXPECT_LT(glm::distance(*kWindow.pixel_of(flown.navigator.camera(), place), 0.5 * kWindow.size), 1.0);
  EXPECT_NEAR(glm::distance(place, flown.navigator.camera().position), 0.25 * way, 0.01 * way);
}

TEST(Navigator, KeysFlyAtASpeedThatGoesWithTheHeight) {
  const auto flown_by = [](double height) {
    Flown flown({{10.0, 10.0, height}, {0.0, -20.0}});
    flown.navigator.drive({{1.0, 0.0, 0.0}, {}});
    for (int k = 0; k < 60; ++k) flown.navigator.advance(1.0 / 60.0);
    return (flown.navigator.stand().place.lat_deg - 10.0) * 110574.0;
  };
  EXPECT_NEAR(flown_by(1000.0), 1000.0, 20.0);
  EXPECT_NEAR(flown_by(100e3), 100e3, 2e3);
}

TEST(Navigator, OverTheSkyADragLooksAround) {
  Flown flown({{10.0, 10.0, 1000.0}, {90.0, 30.0}});
  const geo::Geodetic place = flown.navigator.stand().place;
  flown.navigator.press(Navigator::Grip::kGrab, {640.0, 100.0}, 0.0);
  flown.navigator.move({540.0, 100.0}, 0.1);
  EXPECT_EQ(flown.navigator.stand().place.lat_deg, place.lat_deg);
  EXPECT_GT(flown.navigator.stand().look.heading_deg, 95.0);
}

}  // namespace
