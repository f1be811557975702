#include "globe/planet/sight.h"
#include "globe/base/angles.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <vector>

#include "converters/convert.h"
#include "globe/planet/interpolation.h"
#include "tests/temporary_folder.h"

namespace globe::planet {
namespace {

using geo::Geodetic;

constexpr double kRadius = 6371008.8;
constexpr geo::Ellipsoid kSphere{kRadius, 0.0};

/// A planet without a sea, made of a map of width 2 * rows and a function of latitude and longitude.
class MapPlanet {
 public:
  MapPlanet(int rows, int level, const geo::Ellipsoid& ellipsoid,
            const std::function<double(double lat, double lon)>& height) {
    const int width = 2 * rows;
    std::vector<float> samples;
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < width; ++x)
        samples.push_back(
            static_cast<float>(height(90.0 - 180.0 * (y + 0.5) / rows, 360.0 * (x + 0.5) / width - 180.0)));
    }
    const std::string map = (scratch_ / "map.tif").string();
    const auto output = OIIO::ImageOutput::create(map);
    EXPECT_TRUE(output && output->open(map, OIIO::ImageSpec(width, rows, 1, OIIO::TypeDesc::FLOAT)));
    EXPECT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, samples.data()) && output->close());
    converters::ConvertOptions options;
    options.heights = {converters::MapInput{map}};
    options.planet = scratch_ / "planet";
    options.level = level;
    options.filter = converters::Filter::kNearest;
    options.ellipsoid = ellipsoid;
    converters::convert(options, {});
    surface_ = Surface::from_dataset(
        std::make_shared<const Dataset>(Dataset::open(options.planet, std::size_t{64} << 20)));
  }

  const Surface& operator*() const { return *surface_; }
  const Surface* operator->() const { return surface_.get(); }

 private:
  tests::TemporaryFolder scratch_;
  std::shared_ptr<const Surface> surface_;
};

const MapPlanet& smooth_sphere() {
  static const MapPlanet planet(32, 4, kSphere, [](double, double) { return 0.0; });
  return planet;
}

/// Hills of 600 km under noise of one pixel, 110 km wide: -500 to 5500 m.
const MapPlanet& rough(const geo::Ellipsoid& ellipsoid) {
  const auto height = [](double lat, double lon) {
    const double noise = std::sin(1e4 * std::sin(12.9 * lat + 78.2 * lon));
    return 2500.0 + 2000.0 * std::sin(0.6 * lat) * std::cos(0.6 * lon) + 1000.0 * noise;
  };
  static const MapPlanet sphere(180, 7, kSphere, height), spheroid(180, 7, geo::kMars, height);
  return ellipsoid == kSphere ? sphere : spheroid;
}

/// The place at a distance on the sphere and an azimuth.
Geodetic from_here(const Geodetic& here, double azimuth_deg, double distance_m) {
  const auto frame = geo::local_frame(here.lat_deg, here.lon_deg);
  const double angle = distance_m / kRadius;
  return geo::degrees_from_normal(std::cos(angle) * frame.up +
                                  std::sin(angle) * geo::look_direction(frame, azimuth_deg, 0.0));
}

Geodetic raised(Geodetic place, double h_m) {
  place.h_m = h_m;
  return place;
}

/// The least clearance at `count` places of the ray.
double sampled_clearance(const Surface& surface, const Geodetic& a, const Geodetic& b,
                         const SightSettings& settings, int count) {
  const auto p = geo::ecef_from_geodetic(surface.ellipsoid(), a);
  const auto q = geo::ecef_from_geodetic(surface.ellipsoid(), b);
  const double length = glm::distance(p, q);
  double least = 1e300;
  for (int k = 0; k <= count; ++k) {
    const double share = static_cast<double>(k) / count;
    const Geodetic at = geo::geodetic_from_ecef(surface.ellipsoid(), p + share * (q - p));
    const double bend = settings.refraction * share * (1.0 - share) * length * length /
                        (2.0 * surface.ellipsoid().mean_radius());
    const auto u = geo::normal_from_degrees(at.lat_deg, at.lon_deg);
    const double ground = height_at(surface, u, settings.level, Interpolation::kLinear).height_m;
    least = std::min(least, at.h_m + bend - ground);
  }
  return least;
}

double horizon_m(double h_m) { return kRadius * std::acos(kRadius / (kRadius + h_m)); }

TEST(Sight, HorizonOfASmoothSphereIsThatOfGeometryToTheMetre) {
  constexpr double kMetre = 1.0;  // of ground, over which it falls by 80 nm where an eye lies on it
  const Surface& surface = *smooth_sphere();
  for (const Geodetic& here : {Geodetic{0, 0}, Geodetic{90, 0}, Geodetic{48.2, 16.37}, Geodetic{-45, 180}}) {
    for (const double azimuth : {0.0, 90.0, 37.0, 251.0}) {
      for (const double h1 : {2.0, 100.0, 8848.0}) {
        for (const double h2 : {0.0, 2.0, 3000.0}) {
          const double horizon = horizon_m(h1) + horizon_m(h2);
          const auto seen = [&](double distance_m) {
            return sight(surface, raised(here, h1), raised(from_here(here, azimuth, distance_m), h2),
                         {4, 0.0})
                .visible;
          };
          EXPECT_TRUE(seen(horizon - kMetre)) << here.lat_deg << ' ' << azimuth << ' ' << h1 << ' ' << h2;
          EXPECT_FALSE(seen(horizon + kMetre)) << here.lat_deg << ' ' << azimuth << ' ' << h1 << ' ' << h2;
        }
      }
    }
  }
}

TEST(Sight, OnASmoothSphereClearanceIsTheSagittas) {
  // Two eyes at h, an angle 2 x apart: the ray's middle stands at (R + h) cos x.
  for (const double x_deg : {0.01, 0.5, 2.0}) {
    for (const double h : {10.0, 5000.0}) {
      const Sight found = sight(*smooth_sphere(), {10, 20, h}, {10 + 2 * x_deg, 20, h}, {4, 0.0});
      const double middle = (kRadius + h) * std::cos(x_deg * kDegree) - kRadius;
      EXPECT_NEAR(found.lowest.clearance_m, middle, 2e-8) << x_deg << ' ' << h;
      EXPECT_EQ(found.visible, middle > 0.0);
      if (!found.visible) {
        EXPECT_LT(found.blocked_at->ray.lat_deg, found.lowest.ray.lat_deg);
      }
    }
  }
}

TEST(Sight, RefractionLetsTheHorizonRecedeByTheKnownFactor) {
  for (const double k : {0.0, 0.13, 0.5, 0.9}) {
    const auto seen = [&](double distance_m) {
      const Geodetic here{0, 0, 100.0};
      return sight(*smooth_sphere(), here, raised(from_here(here, 60.0, distance_m), 0.0), {4, k}).visible;
    };
    const double horizon = horizon_m(100.0) / std::sqrt(1.0 - k);
    EXPECT_TRUE(seen(0.9995 * horizon)) << k;
    EXPECT_FALSE(seen(1.0005 * horizon)) << k;
  }
}

TEST(Sight, AWallIsFoundWhereItStands) {
  // One column of pixels, half a degree wide, 3000 m high, beyond which nothing is seen from 2000 m.
  const MapPlanet planet(360, 9, kSphere,
                         [](double, double lon) { return std::abs(lon - 10.25) < 0.1 ? 3000.0 : 0.0; });
  constexpr double kNodes = 90.0 / 512.0;  // degrees between nodes, about
  for (const double lat : {0.0, 12.3, -30.0}) {
    const Geodetic west{lat, 9.5, 2000.0}, east{lat, 11.0, 2000.0};
    const Sight there = sight(*planet, west, east, {9, 0.0}), back = sight(*planet, east, west, {9, 0.0});
    ASSERT_TRUE(there.blocked_at && back.blocked_at);
    EXPECT_GT(there.blocked_at->ray.lon_deg, 10.0 - 2.0 * kNodes);
    EXPECT_LT(there.blocked_at->ray.lon_deg, 10.25);
    EXPECT_GT(back.blocked_at->ray.lon_deg, 10.25);
    EXPECT_LT(back.blocked_at->ray.lon_deg, 10.5 + 2.0 * kNodes);
    EXPECT_NEAR(there.blocked_at->ray.h_m, sight_ground(*planet, there.blocked_at->ray, {9}), 0.01);
    EXPECT_NEAR(there.lowest.ray.lon_deg, 10.25, 2.0 * kNodes);
    // Looks that end before the wall, or go over it.
    EXPECT_TRUE(sight(*planet, west, {lat, 9.75, 2000.0}, {9, 0.0}).visible);
    EXPECT_TRUE(sight(*planet, raised(west, 5000.0), raised(east, 5000.0), {9, 0.0}).visible);
  }
}

TEST(Sight, AThinWallThatSamplesMissIsFound) {
  // A needle: one node among 1000 km.
  const MapPlanet planet(512, 9, kSphere, [](double lat, double lon) {
    return std::abs(lat - 20.123) < 0.17 && std::abs(lon - 10.0) < 0.17 ? 60000.0 : 0.0;
  });
  const Surface& surface = *planet;
  const Geodetic needle = [&] {
    Geodetic best;
    for (double lat = 19.8; lat < 20.5; lat += 0.01) {
      for (double lon = 9.7; lon < 10.3; lon += 0.01) {
        const Geodetic at{lat, lon};
        if (sight_ground(surface, at, {9}) > sight_ground(surface, best, {9})) best = at;
      }
    }
    return best;
  }();
  const Geodetic a = raised(from_here(needle, 80.0, 500e3), 60000.0);
  const Geodetic b = raised(from_here(needle, 260.0, 500e3), 60000.0);
  EXPECT_FALSE(sight(surface, a, b, {9, 0.0}).visible);
  EXPECT_GT(sampled_clearance(surface, a, b, {9, 0.0}, 9), 0.0) << "nine steps must miss it";
}

struct Look {
  Geodetic a, b;
};

/// Two eyes up to 300 km apart, 1 m to 4 km above ground.
Look any_look(const Surface& surface, std::mt19937_64& random, int level) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Look look;
  look.a = {std::asin(2.0 * unit(random) - 1.0) / kDegree, 360.0 * unit(random) - 180.0};
  if (random() % 4 == 0) look.a = {random() % 2 == 0 ? 0.0 : 89.5, 90.0 * static_cast<double>(random() % 4)};
  look.b = from_here(look.a, 360.0 * unit(random), 3e5 * unit(random));
  for (Geodetic* eye : {&look.a, &look.b})
    eye->h_m = sight_ground(surface, *eye, {level}) + std::pow(4000.0, unit(random));
  return look;
}

TEST(Sight, AgreesWithDenseSamples) {
  for (const geo::Ellipsoid& ellipsoid : {kSphere, geo::kMars}) {
    for (const int level : {7, 5, 10}) {
      const Surface& surface = *rough(ellipsoid);
      std::mt19937_64 random(static_cast<std::uint64_t>(level));
      int visible = 0;
      constexpr int kSamples = 3000;
      const int looks = std::getenv("GLOBE_TEST_FULL") != nullptr ? 400 : 60;
      for (int k = 0; k < looks; ++k) {
        const Look look = any_look(surface, random, level);
        const SightSettings settings{level, k % 2 == 0 ? 0.0 : 0.13};
        const Sight found = sight(surface, look.a, look.b, settings);
        const double sampled = sampled_clearance(surface, look.a, look.b, settings, kSamples);
        visible += found.visible ? 1 : 0;
        ASSERT_LE(found.lowest.clearance_m, sampled + 1e-6) << level << ' ' << k;
        // And it is no more than it should be: that of a place of the ray.
        const auto u = geo::normal_from_degrees(found.lowest.ray.lat_deg, found.lowest.ray.lon_deg);
        const double ground = height_at(surface, u, level, Interpolation::kLinear).height_m;
        ASSERT_NEAR(found.lowest.clearance_m, found.lowest.ray.h_m - ground, 1e-6) << level << ' ' << k;
        ASSERT_EQ(found.visible, found.lowest.clearance_m >= -1e-7);
      }
      EXPECT_GT(visible, looks / 10);
      EXPECT_LT(visible, looks);
    }
  }
}

TEST(Sight, WhereItIsBlockedTheRayMeetsTheGroundAndWasClearBefore) {
  const Surface& surface = *rough(kSphere);
  std::mt19937_64 random(11);
  int blocked = 0;
  while (blocked < 40) {
    const Look look = any_look(surface, random, 7);
    const Sight found = sight(surface, look.a, look.b, {7, 0.0});
    if (found.visible) continue;
    ++blocked;
    const SightPlace& place = *found.blocked_at;
    EXPECT_NEAR(place.clearance_m, 0.0, 1e-2);  // within 1 mm of ray, on slopes below 10
    Geodetic before = place.ray;
    const auto p = geo::ecef_from_geodetic(kSphere, look.a), q = geo::ecef_from_geodetic(kSphere, before);
    before = geo::geodetic_from_ecef(kSphere, p + 0.9999 * (q - p));
    EXPECT_GE(sampled_clearance(surface, look.a, before, {7, 0.0}, 3000), -1e-2);
  }
}

RC_GTEST_PROP(Sight, IsTheSameFromBothEyes, (std::uint64_t seed)) {
  std::mt19937_64 random(seed);
  const Surface& surface = *rough(seed % 2 == 0 ? kSphere : geo::kMars);
  const Look look = any_look(surface, random, 7);
  const SightSettings settings{7, 0.13 * static_cast<double>(seed % 3)};
  const Sight there = sight(surface, look.a, look.b, settings);
  const Sight back = sight(surface, look.b, look.a, settings);
  RC_ASSERT(there.visible == back.visible);
  RC_ASSERT(there.lowest.clearance_m == back.lowest.clearance_m);
  RC_ASSERT(there.range_m == back.range_m);
  RC_ASSERT(there.blocked_at.has_value() == back.blocked_at.has_value());
}

RC_GTEST_PROP(Sight, RaisingAnEyeNeverHides, (std::uint64_t seed)) {
  std::mt19937_64 random(seed);
  const Surface& surface = *rough(kSphere);
  const Look look = any_look(surface, random, 7);
  const double more = std::exp(std::uniform_real_distribution<double>(-5.0, 8.0)(random));
  const Sight low = sight(surface, look.a, look.b, {7, 0.0});
  const Sight high = sight(surface, raised(look.a, look.a.h_m + more), look.b, {7, 0.0});
  RC_ASSERT(!low.visible || high.visible);
  RC_ASSERT(high.lowest.clearance_m >= low.lowest.clearance_m - 1e-6);
}

TEST(Sight, TouchingGroundIsNotBlocked) {
  const Surface& surface = *rough(geo::kMars);
  for (const Geodetic& place : {Geodetic{12, 34}, Geodetic{90, 0}, Geodetic{0, -90}}) {
    const double ground = sight_ground(surface, place, {7});
    EXPECT_TRUE(sight(surface, raised(place, ground), raised(place, ground), {7, 0.0}).visible);
    EXPECT_TRUE(sight(surface, raised(place, ground), raised(place, ground + 1e6), {7, 0.0}).visible);
    const Sight under = sight(surface, raised(place, ground - 1.0), raised(place, ground + 1e6), {7, 0.0});
    EXPECT_FALSE(under.visible);
    EXPECT_NEAR(under.lowest.clearance_m, -1.0, 1e-6);
  }
}

TEST(Sight, ThroughThePlanetIsBlockedAtOnce) {
  for (const geo::Ellipsoid& ellipsoid : {kSphere, geo::kMars}) {
    const Surface& surface = *rough(ellipsoid);
    for (const Geodetic& place : {Geodetic{0, 0}, Geodetic{90, 0}, Geodetic{45, 45}, Geodetic{-12.3, 77}}) {
      const Geodetic opposite{-place.lat_deg, place.lon_deg - 180.0};
      const Geodetic a = raised(place, sight_ground(surface, place, {7}) + 2.0);
      const Sight found = sight(surface, a, raised(opposite, 9000.0), {7, 0.13});
      EXPECT_FALSE(found.visible);
      EXPECT_LT(found.lowest.clearance_m, -0.9 * ellipsoid.b());
      EXPECT_NEAR(found.blocked_at->ray.h_m, a.h_m, 5.0);
    }
  }
}

TEST(Sight, FromOrbitSeesWhatTheHorizonLeaves) {
  const Surface& surface = *rough(kSphere);
  const Geodetic station{10, 20, 4e5};
  const Geodetic near = from_here(station, 70, 1e6), far = from_here(station, 70, 4e6);
  EXPECT_TRUE(
      sight(surface, station, raised(near, sight_ground(surface, near, {7}) + 100.0), {7, 0.0}).visible);
  EXPECT_FALSE(
      sight(surface, station, raised(far, sight_ground(surface, far, {7}) + 100.0), {7, 0.0}).visible);
}

}  // namespace
}  // namespace globe::planet
