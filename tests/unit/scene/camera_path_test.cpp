#include "globe/scene/camera_path.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "tests/unit/scene/expect_refusal.h"

namespace globe::scene {
namespace {

using glm::dvec3;

constexpr double kLeast = 2.0;

double sea_level(const geo::Geodetic&) { return 0.0; }

PathKey key(double time, double lat, double lon, double height, std::optional<Look> look = {},
            bool stop = false) {
  return {0, time, {lat, lon, height}, false, look, 0.0, stop};
}

CameraPath path_of(const std::vector<PathKey>& keys) {
  return {stops_of(keys, geo::kWgs84, sea_level, kLeast), -10.0};
}

/// Where the camera looks, in space.
dvec3 forward(const CameraPath::View& view) {
  const geo::Geodetic at = geo::degrees_from_normal(view.u);
  return geo::look_direction(geo::local_frame(at.lat_deg, at.lon_deg), view.heading_deg, view.pitch_deg);
}

/// All that a view is, as numbers that change smoothly.
std::vector<double> numbers(const CameraPath::View& view) {
  const dvec3 look = forward(view);
  return {view.u.x, view.u.y, view.u.z, std::log(view.above_m), view.ground_m, look.x, look.y, look.z};
}

double angle_between(const dvec3& a, const dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// Paths over poles, the antimeridian and half the globe, with holds.
std::vector<std::vector<PathKey>> hard_paths() {
  return {
      {key(0, 10, 170, 2e6, Look{80, -90}), key(4, 12, -175, 3e4, Look{350, -20}),
       key(9, 14, -170, 300, Look{20, -5})},
      {key(0, 80, 10, 5e5), key(5, 89.9, 40, 5e5), key(11, 79, -160, 5e5)},
      {key(0, 85, 0, 1e6, Look{0, -40}), key(10, 85, 180, 1e6, Look{180, -40})},
      {key(0, -89, 0, 1e4, Look{0, 0}), key(3, -90, 0, 1e4, Look{0, 0}), key(6, -89, 90, 1e4, Look{0, 0})},
      {key(0, 0, 0, 1e7), key(20, 10, 150, 1e7), key(21, 10, 150, 10, {}, true), key(25, 10, 150, 10),
       key(40, 11, 151, 50)},
      {key(0, 46, 7, 200, Look{170, 0}), key(1, 46, 7.01, 200, Look{-170, 0}),
       key(2, 46.02, 7.01, 250, Look{179, -90})},
  };
}

TEST(CameraPath, PassesThroughItsPlaces) {
  for (const auto& keys : hard_paths()) {
    const CameraPath path = path_of(keys);
    for (const PathKey& k : keys) {
      const CameraPath::View view = path.at(*k.time_s);
      EXPECT_LT(angle_between(view.u, geo::normal_from_degrees(k.place.lat_deg, k.place.lon_deg)), 1e-12);
      EXPECT_NEAR(view.above_m / k.place.h_m, 1.0, 1e-12);
      if (!k.look) continue;
      EXPECT_NEAR(view.pitch_deg, k.look->pitch_deg, 1e-9);
      if (std::abs(k.place.lat_deg) == 90.0) continue;
      EXPECT_NEAR(std::remainder(view.heading_deg - k.look->heading_deg, 360.0), 0.0, 1e-6);
    }
  }
}

TEST(CameraPath, IsSmoothInVelocityOverPolesAndTheAntimeridian) {
  constexpr double kStep = 1e-4;
  for (std::size_t which = 0; which < hard_paths().size(); ++which) {
    const CameraPath path = path_of(hard_paths()[which]);
    double worst = 0;
    for (double t = 0.01; t < path.duration_s() - 0.01; t += 0.00731) {
      const auto a = numbers(path.at(t - kStep)), b = numbers(path.at(t)), c = numbers(path.at(t + kStep));
      for (std::size_t n = 0; n < a.size(); ++n)
        worst = std::max(worst, std::abs(a[n] - 2.0 * b[n] + c[n]) / kStep);  // a change of velocity
    }
    for (const double t : path.times()) {
      if (t == 0.0 || t == path.duration_s()) continue;
      const auto a = numbers(path.at(t - kStep)), b = numbers(path.at(t)), c = numbers(path.at(t + kStep));
      for (std::size_t n = 0; n < a.size(); ++n)
        worst = std::max(worst, std::abs(a[n] - 2.0 * b[n] + c[n]) / kStep);
    }
    EXPECT_LT(worst, 0.02) << which;  // a kink of the coarsest of these paths is 0.1 to 10
  }
}

TEST(CameraPath, KeepsBetweenTheHeightsOfItsNeighbours) {
  for (const auto& keys : hard_paths()) {
    const CameraPath path = path_of(keys);
    for (std::size_t k = 0; k + 1 < keys.size(); ++k) {
      const double low = std::min(keys[k].place.h_m, keys[k + 1].place.h_m);
      const double high = std::max(keys[k].place.h_m, keys[k + 1].place.h_m);
      for (double s = 0; s <= 1.0; s += 0.01) {
        const double above = path.at(*keys[k].time_s + s * (*keys[k + 1].time_s - *keys[k].time_s)).above_m;
        EXPECT_GE(above, low * (1 - 1e-12));
        EXPECT_LE(above, high * (1 + 1e-12));
      }
    }
  }
}

TEST(CameraPath, HoldsStillWhereItWaits) {
  const CameraPath path =
      path_of({key(0, 0, 0, 1e6), key(5, 10, 10, 1e3), key(8, 10, 10, 1e3), key(12, 20, 10, 1e5)});
  const CameraPath::View at = path.at(5);
  for (double t = 5.0; t <= 8.0; t += 0.125) {
    EXPECT_LT(angle_between(path.at(t).u, at.u), 1e-15);
    EXPECT_DOUBLE_EQ(path.at(t).above_m, at.above_m);
  }
}

TEST(CameraPath, TurnsTheShortWayRound) {
  const CameraPath path = path_of({key(0, 46, 7, 500, Look{350, 0}), key(10, 46, 7.1, 500, Look{10, 0})});
  for (double t = 0; t <= 10.0; t += 0.25)
    EXPECT_LE(std::abs(std::remainder(path.at(t).heading_deg, 360.0)), 10.0 + 1e-9);
}

TEST(CameraPath, LooksAlongTheWayUnlessTold) {
  const CameraPath path = path_of({key(0, 0, 10, 500), key(10, 0, 11, 500), key(20, 1, 11, 500)});
  EXPECT_NEAR(path.at(0).heading_deg, 90.0, 1e-9);
  EXPECT_NEAR(path.at(10).heading_deg, 45.0, 1e-3);
  EXPECT_NEAR(path.at(20).heading_deg, 0.0, 1e-9);
  EXPECT_NEAR(path.at(5).pitch_deg, -10.0, 1e-9);
  const CameraPath down = path_of({key(0, 0, 10, 2e7), key(10, 0, 10, 200)});
  EXPECT_NEAR(down.at(0).pitch_deg, -90.0, 1e-9);
  EXPECT_NEAR(down.at(10).pitch_deg, -10.0, 1e-9);
}

TEST(CameraPath, StraightOverAPoleTheViewGoesOn) {
  const CameraPath path = path_of({key(0, 85, 30, 1e5), key(10, 85, -150, 1e5)});
  dvec3 before = forward(path.at(0));
  for (double t = 0.01; t <= 10.0; t += 0.01) {
    const dvec3 now = forward(path.at(t));
    EXPECT_LT(angle_between(before, now), 0.01) << t;
    before = now;
  }
}

TEST(CameraPath, JumpsFromViewToView) {
  PathKey there = key(5, 40, 100, 300, Look{80, -5});
  there.jump = true;
  PathKey later = key(9, -20, 50, 2e5, Look{0, -60});
  later.jump = true;
  // To a place where it flies on, then, held until its time, to one where it stays.
  const CameraPath path = path_of({key(0, 0, 0, 1e6), key(5, 10, 10, 1e3), there,
                                   key(8, 41, 101, 400, Look{90, -10}), later, key(9.5, -20, 50, 2e5)});
  const auto is_at = [&](double time, double lat, double lon, double above_m) {
    const auto view = path.at(time);
    EXPECT_LT(angle_between(view.u, geo::normal_from_degrees(lat, lon)), 1e-6) << time;
    EXPECT_NEAR(view.above_m / above_m, 1.0, 1e-6) << time;
  };
  EXPECT_EQ(path.duration_s(), 9.5);
  is_at(5.0 - 1e-9, 10, 10, 1e3);
  is_at(5.0, 40, 100, 300);
  is_at(std::nextafter(5.0, 0.0), 40, 100, 300);  // a rounding short of it
  for (const double held : {8.0, 8.5, 9.0 - 1e-9}) is_at(held, 41, 101, 400);
  is_at(9.0, -20, 50, 2e5);
  is_at(9.5, -20, 50, 2e5);
  // The way before a jump knows nothing of what comes after it.
  const CameraPath alone = path_of({key(0, 0, 0, 1e6), key(5, 10, 10, 1e3)});
  for (double t = 0; t < 4.9; t += 0.25) EXPECT_EQ(path.at(t).u, alone.at(t).u);
}

TEST(CameraPath, RollsTheShortWayRoundAndNotAtAllUnlessTold) {
  std::vector<PathKey> keys{key(0, 46, 7, 500), key(5, 46, 7.1, 500), key(10, 46, 7.2, 500)};
  const CameraPath level = path_of(keys);
  keys[0].roll_deg = 170.0;
  keys[1].roll_deg = -170.0;
  keys[2].roll_deg = 0.0;
  const CameraPath path = path_of(keys);
  EXPECT_DOUBLE_EQ(std::remainder(path.at(5).roll_deg + 170.0, 360.0), 0.0);
  for (double t = 0; t <= 5.0; t += 0.25) {
    EXPECT_LE(std::abs(std::remainder(path.at(t).roll_deg - 180.0, 360.0)), 10.0 + 1e-9);
    EXPECT_EQ(level.at(t).roll_deg, 0.0);
    EXPECT_EQ(path.at(t).heading_deg, level.at(t).heading_deg);
  }
}

TEST(PathStops, ALookAtStandsOffAndSeesItsPlace) {
  for (const double tilt : {0.0, 30.0, 60.0, 89.0}) {
    PathKey look_at = key(0, 46, 7, 1000, Look{120, tilt - 90.0});
    look_at.range_m = 40e3;
    const PathStop stop = stops_of({look_at, key(1, 0, 0, 1000)}, geo::kWgs84, sea_level, kLeast).front();
    const dvec3 eye = geo::ecef_from_normal(geo::kWgs84, stop.u, stop.ground_m + stop.above_m);
    const dvec3 place = geo::ecef_from_geodetic(geo::kWgs84, look_at.place);
    EXPECT_NEAR(glm::distance(eye, place), 40e3, 1e-3) << tilt;
    const geo::Geodetic at = geo::degrees_from_normal(stop.u);
    const dvec3 ahead = geo::look_direction(geo::local_frame(at.lat_deg, at.lon_deg), stop.look->heading_deg,
                                            stop.look->pitch_deg);
    EXPECT_LT(angle_between(ahead, place - eye), 1e-7) << tilt;
    EXPECT_NEAR(std::remainder(stop.look->heading_deg - 120.0, 360.0), 0.0, 0.5) << tilt;
  }
}

TEST(PathStops, WithoutTimesTheSpeedIsTheSame) {
  std::vector<PathKey> keys{key(0, 0, 0, 100), key(0, 0, 1, 100), key(0, 0, 1, 100), key(0, 0, 4, 100)};
  for (PathKey& k : keys) k.time_s.reset();
  const auto stops = stops_of(keys, geo::kWgs84, sea_level, kLeast);
  ASSERT_EQ(stops.size(), 3u);
  EXPECT_NEAR(stops[1].time_s, kUntimed / 4.0, 0.01);
  EXPECT_DOUBLE_EQ(stops[2].time_s, kUntimed);
  scene_tests::expect_refusal(
      [&] {
        stops_of({keys[1], keys[2]}, geo::kWgs84, sea_level, kLeast);
      },
      "path", "one");
}

TEST(PathStops, HeightsCountFromTheGroundWhereTheySaySo) {
  const auto ground = [](const geo::Geodetic& at) { return 1000.0 + at.lon_deg; };
  PathKey low = key(0, 0, 5, 50);
  low.above_ground = true;
  const auto stops = stops_of({low, key(1, 0, 6, 3000), key(2, 0, 7, 0)}, geo::kWgs84, ground, kLeast);
  EXPECT_NEAR(stops[0].above_m, 50.0, 1e-9);
  EXPECT_NEAR(stops[1].above_m, 1994.0, 1e-9);
  EXPECT_EQ(stops[2].above_m, kLeast);  // below ground: raised
}

rc::Gen<std::vector<PathKey>> any_keys() {
  return rc::gen::map(rc::gen::container<std::vector<std::tuple<int, int, int, int>>>(
                          6, rc::gen::tuple(rc::gen::inRange(-90, 91), rc::gen::inRange(-180, 180),
                                            rc::gen::inRange(1, 70), rc::gen::inRange(1, 100))),
                      [](const std::vector<std::tuple<int, int, int, int>>& from) {
                        std::vector<PathKey> keys;
                        double time = 0;
                        for (const auto& [lat, lon, height, step] : from) {
                          keys.push_back(key(time, lat, lon, std::pow(10.0, height / 10.0)));
                          time += step / 10.0;
                        }
                        return keys;
                      });
}

RC_GTEST_PROP(CameraPath, OfAnyPlacesIsFiniteAndPassesThroughThem, ()) {
  const auto keys = *any_keys();
  const CameraPath path = path_of(keys);
  for (const PathKey& k : keys) {
    const auto view = path.at(*k.time_s);
    RC_ASSERT(angle_between(view.u, geo::normal_from_degrees(k.place.lat_deg, k.place.lon_deg)) < 1e-12);
  }
  for (int k = -1; k <= 101; ++k) {
    const auto view = path.at(path.duration_s() * k / 100);
    RC_ASSERT(std::abs(glm::length(view.u) - 1.0) < 1e-12);
    RC_ASSERT(std::isfinite(view.heading_deg) && std::abs(view.pitch_deg) <= 90.0 && view.above_m > 0.0);
  }
}

RC_GTEST_PROP(MonotoneCubic, NeverOvershoots, ()) {
  const auto values = *rc::gen::container<std::vector<int>>(8, rc::gen::inRange(-100, 100));
  std::vector<double> times, heights;
  for (std::size_t k = 0; k < values.size(); ++k) {
    times.push_back(static_cast<double>(k * k + k));
    heights.push_back(values[k]);
  }
  const MonotoneCubic curve(times, heights, std::vector<bool>(8, false));
  for (std::size_t k = 0; k + 1 < times.size(); ++k) {
    for (double s = 0; s <= 1.0; s += 1.0 / 64) {
      const double y = curve.at(times[k] + s * (times[k + 1] - times[k]));
      RC_ASSERT(y >= std::min(heights[k], heights[k + 1]) - 1e-9 &&
                y <= std::max(heights[k], heights[k + 1]) + 1e-9);
    }
  }
}

}  // namespace
}  // namespace globe::scene
