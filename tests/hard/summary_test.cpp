// Summaries of regions against every node and against closed forms.

#include "globe/planet/summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "globe/base/error.h"
#include "globe/htm/complement.h"
#include "globe/htm/cone.h"
#include "globe/htm/polygon.h"
#include "globe/region/ellipsoid_cone.h"
#include "globe/region/lat_lon_box.h"
#include "globe/region/map_polygon.h"
#include "tests/hard/directions.h"
#include "tests/hard/table.h"
#include "tests/node_planet.h"
#include "tests/temporary_folder.h"

namespace {

using globe::geo::Ellipsoid;
using globe::geo::Geodetic;
using globe::htm::Region;
using globe::planet::Node;
using globe::planet::RegionSummary;
using globe::planet::summarize;
using globe::planet::Surface;
using hard::dvec3;

using RegionPointer = std::shared_ptr<const Region>;
using SurfacePointer = std::shared_ptr<const Surface>;

constexpr double kMeanShare = 2e-5;  ///< of the range of heights, stated in summary.h
constexpr double kConeAreaShare = 2e-5;
constexpr double kBoxAreaShare = 5e-4;  ///< corners count as cut off
constexpr double kThinAreaShare = 1e-3;

struct SummaryCase {
  std::string name;
  RegionPointer region;
};

/// Poles, antimeridian, octahedron corners and edges, and elsewhere.
Geodetic random_place(std::mt19937_64& random) {
  static const std::vector<Geodetic> kNasty{{90, 0},  {-90, 0}, {0, 0},    {0, 180},
                                            {0, -90}, {45, 45}, {12, 180}, {0, 33}};
  if (random() % 2 == 0) return kNasty[random() % kNasty.size()];
  std::uniform_real_distribution<double> unit(-1, 1);
  return {std::asin(unit(random)) * 180 / M_PI, 180 * unit(random)};
}

globe::htm::Polygon::Ring random_ring(std::mt19937_64& random, const dvec3& center, double radius) {
  const dvec3 east = glm::normalize(glm::cross(center, dvec3(0.3, 0.5, -0.7)));
  const dvec3 north = glm::cross(center, east);
  std::uniform_real_distribution<double> reach(0.3, 1.0);
  globe::htm::Polygon::Ring ring;
  const int corners = 3 + static_cast<int>(random() % 9);
  for (int k = 0; k < corners; ++k) {
    const double r = radius * reach(random), azimuth = 2 * M_PI * k / corners;
    ring.push_back(glm::normalize(std::cos(r) * center +
                                  std::sin(r) * (std::cos(azimuth) * east + std::sin(azimuth) * north)));
  }
  return ring;
}

SummaryCase random_case(std::mt19937_64& random, const Ellipsoid& ellipsoid) {
  const Geodetic at = random_place(random);
  const dvec3 center = globe::geo::normal_from_degrees(at.lat_deg, at.lon_deg);
  const double size = std::exp2(-std::uniform_real_distribution<double>(0, 9)(random));  // radians
  SummaryCase one;
  switch (random() % 5) {
    case 0:
      one = {"cone", std::make_shared<globe::htm::Cone>(center, size * 180 / M_PI)};
      break;
    case 1:
      one = {"cone on the ellipsoid",
             std::make_shared<globe::region::EllipsoidCone>(ellipsoid, at, size * ellipsoid.a)};
      break;
    case 2: {
      const double half_deg = size * 90 / M_PI;
      one = {"box", std::make_shared<globe::region::LatLonBox>(
                        at.lon_deg - half_deg, std::max(-90.0, at.lat_deg - half_deg), at.lon_deg + half_deg,
                        std::min(90.0, at.lat_deg + half_deg))};
      break;
    }
    case 3: {
      const double lat = std::clamp(at.lat_deg, -60.0, 60.0), d = size * 50;
      const std::vector<globe::region::MapPolygon::Rings> rings{
          {{{lat - d / 2, at.lon_deg - d}, {lat, at.lon_deg + d}, {lat + d / 2, at.lon_deg - d / 3}}}};
      one = {"map polygon", std::make_shared<globe::region::MapPolygon>(rings)};
      break;
    }
    default:
      one = {"polygon", std::make_shared<globe::htm::Polygon>(
                            globe::htm::Polygon::Rings{random_ring(random, center, 1.2 * size)})};
  }
  if (random() % 6 == 0)
    one = {"complement of " + one.name, std::make_shared<globe::htm::Complement>(one.region)};
  one.name +=
      " at " + std::to_string(at.lat_deg) + "," + std::to_string(at.lon_deg) + ", " + std::to_string(size);
  return one;
}

/// Every node once, in the order that summary.h states: north pole, the nodes of each diamond's cells along a
/// Z curve, south pole.
std::vector<Node> all_nodes(int level) {
  const int n = globe::planet::nodes_per_side(level);
  std::vector<Node> nodes{{0, level, 0, 0}};
  for (int d = 0; d < 4; ++d) {
    for (std::uint64_t z = 0; z < std::uint64_t{1} << (2 * level); ++z) {
      int i = 0, j = 0;
      for (int bit = 0; bit < level; ++bit) {
        i |= static_cast<int>(z >> (2 * bit) & 1) << bit;
        j |= static_cast<int>(z >> (2 * bit + 1) & 1) << bit;
      }
      nodes.push_back({d, level, i + 1, j});
    }
  }
  nodes.push_back({0, level, n, n});
  return nodes;
}

struct Tried {
  SurfacePointer surface;
  std::vector<Node> nodes;
  std::vector<dvec3> directions;
  std::vector<double> heights;

  Tried(SurfacePointer planet, int level) : surface(std::move(planet)), nodes(all_nodes(level)) {
    for (const Node& node : nodes) {
      directions.push_back(globe::planet::node_direction(node));
      heights.push_back(surface->height(node));
    }
  }
};

/// What every node says.
struct Truth {
  std::uint64_t samples = 0;
  double low = HUGE_VAL, high = -HUGE_VAL;
  dvec3 low_at{0.0}, high_at{0.0};
};

Truth truth_of(const Tried& planet, const Region& region) {
  Truth truth;
  for (std::size_t k = 0; k < planet.nodes.size(); ++k) {
    if (!region.contains(planet.directions[k])) continue;
    ++truth.samples;
    if (planet.heights[k] < truth.low) truth.low = planet.heights[k], truth.low_at = planet.directions[k];
    if (planet.heights[k] > truth.high) truth.high = planet.heights[k], truth.high_at = planet.directions[k];
  }
  return truth;
}

bool agrees(const RegionSummary& seen, const Truth& truth) {
  return seen.samples == truth.samples &&
         (truth.samples == 0 || (seen.lowest.height_m == truth.low && seen.lowest.at == truth.low_at &&
                                 seen.highest.height_m == truth.high && seen.highest.at == truth.high_at));
}

/// Takes layers out of planet.json, as it was before they existed.
void forget_layers(const std::filesystem::path& folder, const std::vector<std::string>& names) {
  globe::planet::PlanetFile file = globe::planet::read_planet_file(folder);
  std::erase_if(file.layers, [&](const auto& layer) {
    return std::find(names.begin(), names.end(), layer.info.name) != names.end();
  });
  globe::planet::write_planet_file(folder, file);
}

class HardSummary : public testing::Test {
 protected:
  SurfacePointer planet(const std::string& name, int level, const Ellipsoid& ellipsoid,
                        const tests::HeightOfNode& height) {
    tests::write_node_planet(folder_ / name, level, ellipsoid, height);
    return tests::open_surface(folder_ / name);
  }

  tests::TemporaryFolder folder_;
};

TEST_F(HardSummary, OfRandomRegionsIsThatOfTheirNodes) {
  std::mt19937_64 random(31);
  const std::size_t count = hard::cases(2000);
  std::size_t tried = 0, wrong = 0;
  for (const int level : {6, 5, 3, 1, 0}) {
    for (const bool ties : {false, true}) {
      const auto rough = tests::hashed_heights(static_cast<std::uint64_t>(level), -9000, 9000);
      const auto steps = [&](const Node& node) { return std::round(rough(node) / 4500); };
      const Ellipsoid ellipsoid = ties ? Ellipsoid{6.4e6, 0.1} : globe::geo::kWgs84;
      const std::string name = std::to_string(level) + (ties ? "ties" : "");
      const Tried all(planet(name, level, ellipsoid, ties ? tests::HeightOfNode(steps) : rough), level);
      for (std::size_t k = 0; k < count / 10; ++k) {
        const SummaryCase one = random_case(random, ellipsoid);
        const auto seen = summarize(*all.surface, *one.region, level);
        const Truth truth = truth_of(all, *one.region);
        const bool right = seen ? agrees(*seen, truth) : truth.samples == 0;
        ++tried;
        wrong += !right;
        EXPECT_TRUE(right) << one.name << " level " << level << (ties ? " ties" : "") << ": "
                           << (seen ? seen->samples : 0) << " samples, truth " << truth.samples;
      }
    }
  }
  hard::report("summary", "wrong counts, extremes or places of " + std::to_string(tried) + " regions", "0",
               std::to_string(wrong));
}

TEST_F(HardSummary, NegativeControlARegionMovedByAThirdOfACellIsFoundOut) {
  std::mt19937_64 random(32);
  const Tried all(planet("moved", 6, globe::geo::kMoon, tests::hashed_heights(6, -9000, 9000)), 6);
  int found = 0;
  for (int k = 0; k < 50; ++k) {
    const Geodetic at = random_place(random);
    const auto cone = [&](double moved_deg) {
      return globe::htm::Cone(globe::geo::normal_from_degrees(at.lat_deg * 0.9 + moved_deg, at.lon_deg), 10);
    };
    found += !agrees(*summarize(*all.surface, cone(0), 6), truth_of(all, cone(0.5)));
  }
  EXPECT_GT(found, 40);
}

TEST_F(HardSummary, WithAndWithoutPyramidsIsTheSame) {
  std::mt19937_64 random(33);
  const auto height = tests::hashed_heights(8, -9000, 9000);
  const SurfacePointer with = planet("with", 6, globe::geo::kMars, height);
  planet("without", 6, globe::geo::kMars, height);
  forget_layers(folder_ / "without", {"height_mean"});
  const SurfacePointer without = tests::open_surface(folder_ / "without");
  double worst = 0;
  for (std::size_t k = 0; k < hard::cases(1000); ++k) {
    const SummaryCase one = random_case(random, globe::geo::kMars);
    const auto a = summarize(*with, *one.region, 6);
    const auto b = summarize(*without, *one.region, 6);
    ASSERT_EQ(a.has_value(), b.has_value()) << one.name;
    if (!a) continue;
    EXPECT_EQ(a->samples, b->samples) << one.name;
    EXPECT_EQ(a->lowest.height_m, b->lowest.height_m) << one.name;
    EXPECT_EQ(a->highest.at, b->highest.at) << one.name;
    EXPECT_EQ(a->area_m2, b->area_m2) << one.name;
    worst = std::max(worst, std::abs(a->mean_m - b->mean_m));
  }
  EXPECT_LE(worst, 1e-3);  // means are stored as floats: half a millimetre at 9 km
  hard::report("summary", "means with against without the pyramid, mm", "1", hard::figure(1e3 * worst));
}

/// Area of an ellipsoid between the equator and a latitude, a radian of longitude wide: half of
/// Geodesic::EllipsoidArea at the pole (Snyder 1987, 3-12 times a² / 2).
double zone(const Ellipsoid& ellipsoid, double lat_deg) {
  const double s = std::sin(lat_deg * M_PI / 180), e2 = ellipsoid.f * (2 - ellipsoid.f), e = std::sqrt(e2);
  const double tail = e == 0 ? s : std::atanh(e * s) / e;
  return ellipsoid.a * ellipsoid.a * (1 - e2) * 0.5 * (s / (1 - e2 * s * s) + tail);
}

TEST_F(HardSummary, AreasAreThoseOfClosedForms) {
  std::mt19937_64 random(34);
  double worst_cone = 0, worst_box = 0, worst_thin = 0;
  const SurfacePointer moon = planet("moon", 6, globe::geo::kMoon, tests::hashed_heights(1, 0, 1));
  const SurfacePointer earth = planet("earth", 6, globe::geo::kWgs84, tests::hashed_heights(1, 0, 1));
  const std::size_t count = hard::cases(300);
  for (std::size_t k = 0; k < count; ++k) {
    const Geodetic at = random_place(random);
    const double radius = std::exp2(-std::uniform_real_distribution<double>(-1, 16)(random));
    const globe::htm::Cone cone(globe::geo::normal_from_degrees(at.lat_deg, at.lon_deg), radius * 180 / M_PI);
    const double half = std::sin(radius / 2);
    const double truth = 4 * M_PI * moon->ellipsoid().a * moon->ellipsoid().a * half * half;
    worst_cone = std::max(worst_cone, std::abs(summarize(*moon, cone, 6)->area_m2 / truth - 1));
    std::uniform_real_distribution<double> unit(0, 1);
    const bool thin = k % 3 == 0;
    const double south = 170 * unit(random) - 90, width = std::exp2(-9 * unit(random)) * (thin ? 300 : 40);
    const double north = std::min(90.0, south + (thin ? 0.01 : 1.0) * width);
    const globe::region::LatLonBox box(at.lon_deg, south, at.lon_deg + width, north);
    const double box_truth =
        (zone(earth->ellipsoid(), north) - zone(earth->ellipsoid(), south)) * width * M_PI / 180;
    double& worst = thin || south > 80 ? worst_thin : worst_box;
    worst = std::max(worst, std::abs(summarize(*earth, box, 6)->area_m2 / box_truth - 1));
  }
  EXPECT_LE(worst_cone, kConeAreaShare);
  EXPECT_LE(worst_box, kBoxAreaShare);
  EXPECT_LE(worst_thin, kThinAreaShare);
  hard::report("summary", "area of a cone, relative", "2e-5", hard::figure(worst_cone));
  hard::report("summary", "area of a box, relative", "5e-4", hard::figure(worst_box));
  hard::report("summary", "area of a box 100 times as long as wide, relative", "1e-3",
               hard::figure(worst_thin));
}

TEST_F(HardSummary, MeansAreThoseOfClosedForms) {
  // Height H z over a sphere: over a cone of radius r around c its mean is H c_z (1 + cos r) / 2. The linear
  // surface falls short of it by an eighth of the square of the sides.
  constexpr double kHeight_m = 9000;
  std::mt19937_64 random(35);
  const int level = 8;
  const auto slope = [&](const Node& node) { return kHeight_m * globe::planet::node_direction(node).z; };
  const SurfacePointer moon = planet("slope", level, globe::geo::kMoon, slope);
  double worst = 0;
  for (std::size_t k = 0; k < hard::cases(1000); ++k) {
    const Geodetic at = random_place(random);
    const dvec3 center = globe::geo::normal_from_degrees(at.lat_deg, at.lon_deg);
    const double radius = std::exp2(-std::uniform_real_distribution<double>(-1, 12)(random));
    const globe::htm::Cone cone(center, radius * 180 / M_PI);
    const double truth = kHeight_m * center.z * (1 + std::cos(radius)) / 2;
    worst = std::max(worst, std::abs(summarize(*moon, cone, level)->mean_m - truth));
  }
  EXPECT_LE(worst, 2 * kHeight_m * kMeanShare);
  hard::report("summary", "mean of a slope over a cone, of the range of heights", "2e-5",
               hard::figure(worst / (2 * kHeight_m)));
}

TEST_F(HardSummary, OfTheWholePlanetIsExact) {
  const auto whole = std::make_shared<globe::region::LatLonBox>(-180, -90, 180, 90);
  double worst = 0;
  for (const Ellipsoid& ellipsoid : {globe::geo::kWgs84, globe::geo::kMars, globe::geo::kMoon}) {
    const std::string name = "flat" + std::to_string(ellipsoid.f);
    const SurfacePointer flat = planet(name, 7, ellipsoid, [](const Node&) { return 1234.567; });
    const auto with = summarize(*flat, *whole, 7);
    const auto coarse = summarize(*flat, *whole, 5);  // node by node
    const double truth = 4 * M_PI * zone(ellipsoid, 90);
    for (const auto& seen : {with, coarse}) {
      EXPECT_NEAR(seen->mean_m, static_cast<double>(1234.567F), 1e-9);
      worst = std::max(worst, std::abs(seen->area_m2 / truth - 1));
    }
    EXPECT_EQ(with->samples, 4U * 128 * 128 + 2);
    EXPECT_EQ(with->lowest.at, dvec3(0, 0, 1));  // the first of equal ones
    EXPECT_EQ(with->highest.at, dvec3(0, 0, 1));
  }
  EXPECT_LE(worst, 1e-12);
  hard::report("summary", "area of whole planets, relative", "1e-12", hard::figure(worst));
}

TEST_F(HardSummary, OfTheBuiltInPlanetIsThatOfItsNodes) {
  std::mt19937_64 random(36);
  const SurfacePointer builtin = Surface::builtin(2);
  const Tried all(builtin, 6);
  for (std::size_t k = 0; k < hard::cases(100); ++k) {
    const SummaryCase one = random_case(random, builtin->ellipsoid());
    const auto seen = summarize(*builtin, *one.region, 6);
    const Truth truth = truth_of(all, *one.region);
    EXPECT_TRUE(seen ? agrees(*seen, truth) : truth.samples == 0) << one.name;
  }
  EXPECT_THROW(summarize(*builtin, globe::htm::Cone(dvec3(1, 0, 0), 90), 14), globe::Error);
}

}  // namespace
