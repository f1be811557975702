// H20: a flight is clear of the ground, over any mountains.

#include "app/flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <random>
#include <string>

#include "converters/convert.h"
#include "globe/clipmap/ground_below.h"
#include "globe/planet/sight.h"
#include "globe/scene/flight_path.h"
#include "tests/hard/directions.h"
#include "tests/hard/table.h"
#include "tests/node_planet.h"
#include "tests/temporary_folder.h"

namespace {

using app::Flight;
using app::FlightEnd;
using globe::clipmap::Settings;
using globe::geo::Geodetic;
using globe::planet::Surface;
using hard::dvec3;

constexpr int kFinestFlown = 26;
constexpr int kFrames = 200;

double above_ground(const Surface& surface, const Geodetic& place) {
  return globe::clipmap::height_above_ground(Settings::for_detail(64), surface,
                                             globe::geo::ecef_from_geodetic(surface.ellipsoid(), place),
                                             kFinestFlown, true);
}

struct Seen {
  double least_m = 1e9;          ///< above ground, at frames
  double least_share = 1e9;      ///< the same, of the height that the flight's plan has there
  double least_planned_m = 1e9;  ///< without anything that raises it
  std::size_t flights = 0, under = 0;
};

/// From place to place, 2 m to 1 km above ground.
void fly(std::shared_ptr<const Surface> surface, std::size_t count, unsigned seed, Seen& seen) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (std::size_t k = 0; k < count; ++k) {
    // from land to land
    FlightEnd from, to;
    do {
      const dvec3 u = hard::random_direction(random);
      const dvec3 aside = glm::normalize(glm::cross(u, hard::random_direction(random)));
      from.place = globe::geo::degrees_from_normal(u);
      to.place =
          globe::geo::degrees_from_normal(glm::normalize(u + aside * 1e-4 * std::pow(1e3, unit(random))));
    } while (surface->height(globe::geo::normal_from_degrees(from.place.lat_deg, from.place.lon_deg), 8) <
             800.0);
    from.above_ground_m = 2.0 * std::pow(500.0, unit(random));
    to.above_ground_m = 2.0 * std::pow(500.0, unit(random));
    const Flight flight(Settings::for_detail(64), surface, kFinestFlown, from, to, {});
    const globe::scene::FlightPath path(
        globe::geo::normal_from_degrees(from.place.lat_deg, from.place.lon_deg), from.above_ground_m,
        globe::geo::normal_from_degrees(to.place.lat_deg, to.place.lon_deg), to.above_ground_m,
        surface->ellipsoid().mean_radius(), 0.0, 0.0);
    const double from_m = flight.at(0.0, true).place.h_m - from.above_ground_m;
    const double to_m = flight.at(1.0, true).place.h_m - to.above_ground_m;
    bool under = false;
    for (int frame = 0; frame < kFrames; ++frame) {
      const double t = static_cast<double>(frame) / (kFrames - 1);
      const Geodetic place = flight.at(t, true).place;
      const double above = above_ground(*surface, place);
      Geodetic planned = place;
      const double e = globe::scene::FlightPath::eased(t);
      planned.h_m = path.at(t).height_m + from_m + (to_m - from_m) * e;
      seen.least_m = std::min(seen.least_m, above);
      seen.least_share = std::min(seen.least_share, above / path.at(t).height_m);
      const double above_planned = above_ground(*surface, planned);
      seen.least_planned_m = std::min(seen.least_planned_m, above_planned);
      under = under || above_planned < 0.0;
    }
    ++seen.flights;
    seen.under += under ? 1 : 0;
  }
}

void expect_clear(const std::string& planet, const Seen& seen) {
  hard::report("H20", "least height above ground of " + std::to_string(seen.flights) + " flights, " + planet,
               ">= 2 m", hard::figure(seen.least_m) + " m");
  hard::report("H20", "the same, of the height that the path has there", ">= 0.2",
               hard::figure(seen.least_share));
  hard::report("H20", "negative control: flights that lead through ground by their path alone", "> 0",
               std::to_string(seen.under) + ", " + hard::figure(seen.least_planned_m) + " m");
  EXPECT_GE(seen.least_m, 2.0 - 1e-6);
  EXPECT_GE(seen.least_share, 0.2);
  EXPECT_GT(seen.under, 0u);
}

TEST(H20, FlightsAreClearOfTheBuiltInPlanetsMountains) {
  Seen seen;
  fly(Surface::builtin(1), hard::cases(250), 2013, seen);
  expect_clear("the built-in planet", seen);
}

TEST(H20, FlightsAreClearOfTheEarthsMountains) {
  const std::filesystem::path map = GLOBE_DATA_DIR "/earth/earth_etopo20_f32.tif";
  if (!std::filesystem::exists(map)) GTEST_SKIP() << "SAMPLE MAP MISSING: " << map;
  const tests::TemporaryFolder folder;
  converters::ConvertOptions options;
  options.heights = {converters::MapInput{map.string(), {}, {}}};
  options.planet = folder / "earth";
  options.level = 8;
  converters::convert(options, {});
  Seen seen;
  fly(tests::open_surface(options.planet), hard::cases(150), 2012, seen);
  expect_clear("the Earth", seen);
}

TEST(H20, AFlightThatJumpsIsClearOfMountainsOnBothSides) {
  const std::shared_ptr<const Surface> surface = Surface::builtin(1);
  globe::scene::Path path;
  const auto add = [&](double time, double lat, double lon, bool jump) {
    globe::scene::PathKey key;
    key.time_s = time;
    key.place = {lat, lon, 20.0};
    key.above_ground = true;
    key.jump = jump;
    path.keys.push_back(key);
  };
  // Through the range of the built-in planet's scenic place, and again from its other side.
  add(0, -43.42, -106.43, false);
  add(10, -43.5, -105.9, false);
  add(10, -43.2, -106.2, true);
  add(20, -43.8, -106.2, false);
  const Flight flight(Settings::for_detail(64), surface, kFinestFlown, path);
  double least_m = 1e9;
  for (int frame = 0; frame <= kFrames; ++frame) {
    const Geodetic place = flight.at(static_cast<double>(frame) / kFrames, true).place;
    least_m = std::min(least_m, above_ground(*surface, place));
    if (frame == kFrames / 2) {
      EXPECT_NEAR(place.lat_deg, -43.2, 1e-6);
    }
    if (frame == kFrames / 2 - 1) {
      EXPECT_NEAR(place.lon_deg, -105.9, 0.02);
    }
  }
  EXPECT_GE(least_m, 2.0 - 1e-6);
}

}  // namespace
