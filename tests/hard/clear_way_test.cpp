// H20: a camera never goes through the ground, however fast it moves.

#include "globe/planet/clear_way.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "converters/convert.h"
#include "globe/planet/sight.h"
#include "tests/hard/directions.h"
#include "tests/hard/table.h"
#include "tests/node_planet.h"
#include "tests/temporary_folder.h"

namespace {

using globe::geo::Geodetic;
using globe::planet::Clearance;
using globe::planet::Surface;
using hard::dvec3;

constexpr double kClearanceError_m = 1e-3;

double ground(const Surface& surface, const Geodetic& place, int level) {
  return globe::planet::sight_ground(surface, place, {level});
}

/// The finest level of which 64 cells cover a length.
int level_for(const Surface& surface, double length, int finest) {
  return std::clamp(static_cast<int>(std::log2(surface.root_edge() * 64 / std::max(length, 1e-3))), 0,
                    finest);
}

/// The least height above the ground along a straight way, looked at in 32 places.
double least_above(const Surface& surface, const Geodetic& from, const Geodetic& to, int finest) {
  const dvec3 a = globe::geo::ecef_from_geodetic(surface.ellipsoid(), from);
  const dvec3 b = globe::geo::ecef_from_geodetic(surface.ellipsoid(), to);
  const int level = level_for(surface, glm::distance(a, b), finest);
  double least = 1e9;
  for (int k = 1; k <= 32; ++k) {
    const Geodetic at = globe::geo::geodetic_from_ecef(surface.ellipsoid(), a + (b - a) * (k / 32.0));
    least = std::min(least, at.h_m - ground(surface, at, level));
  }
  return least;
}

struct Motion {
  Geodetic from, to;
  Clearance keep;
};

Motion random_motion(const Surface& surface, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Motion motion;
  motion.keep.level = 8 + static_cast<int>(random() % 11);
  const dvec3 u = hard::random_direction(random);
  const dvec3 aside = glm::normalize(glm::cross(u, hard::random_direction(random)));
  motion.from = globe::geo::degrees_from_normal(u);
  motion.from.h_m = ground(surface, motion.from, motion.keep.level) + 2.0 * std::pow(1e4, unit(random));
  const double angle = std::pow(10.0, -6.0 + 6.0 * unit(random));
  motion.to = globe::geo::degrees_from_normal(glm::normalize(u + aside * angle));
  motion.to.h_m = motion.from.h_m + (unit(random) - 0.7) * 5e3;
  return motion;
}

struct Least {
  double taken = 1e9, straight = 1e9;
  std::size_t motions = 0, through = 0, most_chords = 0;
};

void fly(const Surface& surface, std::size_t count, unsigned seed, Least& least) {
  std::mt19937_64 random(seed);
  for (std::size_t k = 0; k < count; ++k) {
    const Motion motion = random_motion(surface, random);
    const std::vector<Geodetic> way = globe::planet::clear_way(surface, motion.from, motion.to, motion.keep);
    ASSERT_FALSE(way.empty());
    EXPECT_EQ(way.back().lat_deg, motion.to.lat_deg);
    EXPECT_EQ(way.back().lon_deg, motion.to.lon_deg);
    EXPECT_GE(way.back().h_m, motion.to.h_m);
    least.most_chords = std::max(least.most_chords, way.size());
    Geodetic here = motion.from;
    for (const Geodetic& next : way) {
      least.taken = std::min(least.taken, least_above(surface, here, next, motion.keep.level));
      here = next;
    }
    least.taken = std::min(least.taken, here.h_m - ground(surface, here, motion.keep.level));
    const double straight = least_above(surface, motion.from, motion.to, motion.keep.level);
    least.straight = std::min(least.straight, straight);
    least.through += straight < 0.0 ? 1 : 0;
    ++least.motions;
  }
}

void expect_clear(const std::string& planet, const Least& least) {
  hard::report("H20",
               "least height above ground on the ways of " + std::to_string(least.motions) +
                   " motions to 6000 km, " + planet,
               ">= 2 m", hard::figure(least.taken) + " m");
  hard::report("H20", "negative control: motions that lead through ground when nothing keeps them", "> 0",
               std::to_string(least.through));
  EXPECT_GE(least.taken, 2.0 - kClearanceError_m);
  EXPECT_GT(least.through, least.motions / 10);
  EXPECT_LE(least.most_chords, 64u);
}

TEST(H20, NoMotionLeadsThroughTheGroundOfTheBuiltInPlanet) {
  Least least;
  fly(*Surface::builtin(1), hard::cases(300), 2001, least);
  expect_clear("the built-in planet", least);
}

TEST(H20, NoMotionLeadsThroughTheGroundOfTheEarth) {
  const std::filesystem::path map = GLOBE_DATA_DIR "/earth/earth_etopo20_f32.tif";
  if (!std::filesystem::exists(map)) GTEST_SKIP() << "SAMPLE MAP MISSING: " << map;
  const tests::TemporaryFolder folder;
  converters::ConvertOptions options;
  options.heights = {converters::MapInput{map.string(), {}, {}}};
  options.planet = folder / "earth";
  options.level = 8;
  converters::convert(options, {});
  Least least;
  fly(*tests::open_surface(options.planet), hard::cases(300), 2002, least);
  expect_clear("the Earth", least);
}

TEST(H20, AWayInFreeAirEndsWhereItWasToGo) {
  const auto surface = Surface::builtin(1);
  std::mt19937_64 random(2003);
  for (int k = 0; k < 200; k += hard::full() ? 1 : 10) {
    Geodetic from = globe::geo::degrees_from_normal(hard::random_direction(random));
    Geodetic to = globe::geo::degrees_from_normal(hard::random_direction(random));
    from.h_m = 20e3 + 1e3 * k;
    to.h_m = 30e3;
    if (k % 40 == 0) to = {-from.lat_deg, from.lon_deg + 180.0, 30e3};  // antipodes
    if (k % 40 == 10) to = from;
    const auto way = globe::planet::clear_way(*surface, from, to, {2.0, 20});
    EXPECT_EQ(way.back().lat_deg, to.lat_deg);
    EXPECT_EQ(way.back().lon_deg, to.lon_deg);
    EXPECT_EQ(way.back().h_m, to.h_m);
    for (const Geodetic& place : way) EXPECT_TRUE(std::isfinite(place.lat_deg + place.lon_deg + place.h_m));
  }
}

}  // namespace
