#include <gtest/gtest.h>

#include <cmath>

#include "converters/footprint.h"
#include "converters/map_geometry.h"
#include "converters/node_block.h"
#include "globe/base/angles.h"
#include "globe/base/error.h"
#include "tests/unit/converters/test_maps.h"

namespace converters {
namespace {

using globe::kDegree;
using globe::planet::Node;
using globe::planet::nodes_per_side;

TEST(NodeBlock, EqualsNodeDirectionBitForBit) {
  for (const int level : {0, 1, 3, 6, 9, 20}) {
    const int n = nodes_per_side(level);
    const int side = std::min(64, n);
    for (int d = 0; d < 4; ++d) {
      for (const int i0 : {0, (n / 2) / side * side, n - side}) {
        for (const int j0 : {0, (n / 3) / side * side, n - side}) {
          const NodeBlock block(d, level, i0, j0, side);
          for (int j = j0; j <= j0 + side; j += level > 9 ? 7 : 1) {
            for (int i = i0; i <= i0 + side; i += level > 9 ? 5 : 1)
              ASSERT_EQ(block.at(i, j), globe::planet::node_direction({d, level, i, j}));
          }
        }
      }
    }
  }
}

TEST(MapGeometry, PlacesSampleCentresOfAreasAndPoints) {
  const MapGeometry area = test::geometry_of(720, 360);
  EXPECT_EQ(area.period, 720);
  EXPECT_DOUBLE_EQ(area.west_deg, -179.75);
  EXPECT_DOUBLE_EQ(area.north_deg, 89.75);
  const MapGeometry repeated = test::geometry_of(721, 361, Registration::kPoint);
  EXPECT_EQ(repeated.period, 720);
  EXPECT_DOUBLE_EQ(repeated.west_deg, -180.0);
  EXPECT_DOUBLE_EQ(repeated.north_deg, 90.0);
  const MapGeometry geoid = test::geometry_of(1440, 721, Registration::kPoint, {0, -90, 359.75, 90});
  EXPECT_EQ(geoid.period, 1440);
  EXPECT_DOUBLE_EQ(geoid.step_deg, 0.25);

  const SamplePlace place = place_of(area, globe::geo::normal_from_degrees(89.75, -179.75));
  EXPECT_NEAR(place.x.whole + place.x.fraction, 0.0, 1e-9);
  EXPECT_NEAR(place.y.whole + place.y.fraction, 0.0, 1e-9);
}

TEST(MapGeometry, RefusesMapsThatAreNotAWholePlanet) {
  EXPECT_THROW(test::geometry_of(720, 359), globe::Error);
  EXPECT_THROW(test::geometry_of(721, 361), globe::Error);
  EXPECT_THROW(test::geometry_of(720, 360, Registration::kPoint), globe::Error);
  EXPECT_THROW(test::geometry_of(720, 360, Registration::kArea, {0, -60, 360, 60}), globe::Error);
  EXPECT_THROW(test::geometry_of(720, 360, Registration::kArea, {0, -90, 180, 90}), globe::Error);
}

MapGeometry part_of(int width, int height, const Extent& extent,
                    Registration registration = Registration::kArea) {
  return equirectangular_geometry("map", width, height, extent, registration, Latitude::kGeodetic,
                                  globe::geo::kMoon);
}

TEST(MapGeometry, TakesExtentsThatFilesRoundForWhatTheyMean) {
  const MapGeometry map = part_of(1081, 540, {20.00000005, -90, 380.3333, 89.99998205});
  EXPECT_EQ(map.period, 1080);
  EXPECT_TRUE(map.is_whole_planet());
  EXPECT_DOUBLE_EQ(map.step_deg, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(map.row_step_deg, 1.0 / 3.0);
  EXPECT_NEAR(map.west_deg, 20.0 + 1.0 / 6.0, 1e-12);
  EXPECT_DOUBLE_EQ(map.north_deg, 90.0 - 1.0 / 6.0);
  const MapGeometry geoid = part_of(1440, 721, {-0.125, -90.125, 359.875, 90.125});
  EXPECT_EQ(geoid.north_shift, 0);
  EXPECT_EQ(geoid.south_shift, 0);
  EXPECT_DOUBLE_EQ(geoid.north_deg, 90.0);
  EXPECT_DOUBLE_EQ(geoid.west_deg, 0.0);
}

TEST(MapGeometry, EndsWherePartsOfThePlanetEnd) {
  const MapGeometry band = part_of(720, 240, {-180, -60, 180, 60});
  EXPECT_EQ(band.period, 720);
  EXPECT_FALSE(band.is_whole_planet());
  EXPECT_FALSE(has_row(band, -1));
  const MapGeometry cap = part_of(720, 60, {0, 60, 360, 90});
  EXPECT_TRUE(has_row(cap, -1));
  EXPECT_FALSE(has_row(cap, 60));
  const MapGeometry pacific = part_of(200, 100, {170, -10, 190, 10});
  EXPECT_EQ(pacific.period, 0);
  for (const double lon : {-175.0, 185.0, 545.0}) {
    const SamplePlace place = place_of(pacific, globe::geo::normal_from_degrees(5.0, lon));
    EXPECT_NEAR(place.x.whole + place.x.fraction, 149.5, 1e-9) << lon;
    EXPECT_TRUE(is_on(pacific, place));
  }
  EXPECT_FALSE(is_on(pacific, place_of(pacific, globe::geo::normal_from_degrees(5.0, 169.9))));
  EXPECT_FALSE(is_on(pacific, place_of(pacific, globe::geo::normal_from_degrees(10.1, 175.0))));
  const MapGeometry tiny = part_of(8, 8, {10, 20, 10 + 1e-9, 20 + 1e-9});  // far places have no sample number
  EXPECT_FALSE(place_of(tiny, globe::geo::normal_from_degrees(-40.0, 100.0)).is_somewhere());
  EXPECT_THROW(part_of(10, 10, {0, 80, 10, 95}), globe::Error);
  EXPECT_THROW(part_of(10, 10, {0, 200, 300, 500}), globe::Error);
}

TEST(MapGeometry, FoldsRowsBeyondAPoleToTheOppositeMeridian) {
  const auto folded = [](const MapGeometry& map, int x, int y) {
    const SampleIndex index = fold(map, x, y);
    return std::pair(index.x, index.y);
  };
  const MapGeometry area = test::geometry_of(8, 4);
  EXPECT_EQ(folded(area, 1, -1), std::pair(5, 0));
  EXPECT_EQ(folded(area, 6, -2), std::pair(2, 1));
  EXPECT_EQ(folded(area, 1, 4), std::pair(5, 3));
  EXPECT_EQ(folded(area, -1, 2), std::pair(7, 2));
  EXPECT_EQ(folded(area, 17, 2), std::pair(1, 2));
  const MapGeometry point = test::geometry_of(9, 5, Registration::kPoint);
  EXPECT_EQ(folded(point, 1, -1), std::pair(5, 1));
  EXPECT_EQ(folded(point, 1, 5), std::pair(5, 3));
}

TEST(MapGeometry, TurnsGeocentricRowsIntoGeodeticLatitudes) {
  const MapGeometry map = whole_planet_geometry("map", 3600, 1800, {}, Registration::kArea,
                                                Latitude::kGeocentric, globe::geo::kWgs84);
  // Geodetic 45 degrees is geocentric 44.8076 on WGS84.
  const SamplePlace place = place_of(map, globe::geo::normal_from_degrees(45.0, 10.0));
  EXPECT_NEAR(map.north_deg - (place.y.whole + place.y.fraction) * map.step_deg, 44.80757678, 1e-7);
  EXPECT_NEAR(latitude_of(map, place.y.whole + place.y.fraction), 45.0, 1e-9);
}

double length_on_row(const Footprint& footprint, double y) {
  std::vector<double> x;
  for (int k = 0; k < footprint.count; ++k) {
    const auto a = footprint.corner[static_cast<std::size_t>(k)];
    const auto b = footprint.corner[static_cast<std::size_t>((k + 1) % footprint.count)];
    if ((y < a.y) != (y < b.y)) x.push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
  }
  return x.empty() ? 0.0 : *std::max_element(x.begin(), x.end()) - *std::min_element(x.begin(), x.end());
}

TEST(Footprint, CoversThePlanetOnceOnTheWhole) {
  const MapGeometry map = test::geometry_of(360, 180);
  const int level = 5;
  const int n = nodes_per_side(level);
  double covered = 0;
  const double north = cap_rim(map, level, true);
  const double south = cap_rim(map, level, false);
  const auto each_row = [&](const auto& body) {
    for (double y = -0.5 + 0.025; y < map.height - 0.5; y += 0.05)
      body(y, std::cos(latitude_of(map, y) * kDegree));
  };
  each_row([&](double y, double weight) { covered += y < north || y > south ? weight * map.period : 0.0; });
  for (int d = 0; d < 4; ++d) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        const Node node{d, level, i, j};
        if ((i == 0 && j == 0) || (i == n && j == n)) continue;
        const Footprint footprint = footprint_of(map, node);
        each_row([&](double y, double weight) {
          covered += weight * length_on_row(footprint, y) / globe::planet::names(node).count;
        });
      }
    }
  }
  double whole = 0;
  each_row([&](double, double weight) { whole += weight * map.period; });
  EXPECT_NEAR(covered / whole, 1.0, 0.02);
}

TEST(Footprint, IsSymmetricAboutItsNodeAndTheSameByEveryName) {
  const MapGeometry map = test::geometry_of(3600, 1800);
  const int level = 6;
  const int n = nodes_per_side(level);
  for (int k = 1; k < n; ++k) {
    for (const Node& node :
         {Node{0, level, k, 0}, Node{1, level, n, k}, Node{2, level, k, k / 2}, Node{3, level, 0, k}}) {
      const Footprint footprint = footprint_of(map, node);
      const SamplePlace place = place_of(map, globe::planet::node_direction(node));
      EXPECT_NEAR(footprint.min_x() + footprint.max_x(), 2.0 * place.x.fraction, 1e-9);
      EXPECT_NEAR(footprint.min_y() + footprint.max_y(), 2.0 * (place.y.whole + place.y.fraction), 1e-9);
      const globe::planet::Names names = globe::planet::names(node);
      for (std::size_t name = 1; name < static_cast<std::size_t>(names.count); ++name) {
        const Footprint other = footprint_of(map, names.node[name]);
        for (std::size_t c = 0; c < 6; ++c) {
          ASSERT_EQ(footprint.corner[c].x, other.corner[c].x);
          ASSERT_EQ(footprint.corner[c].y, other.corner[c].y);
        }
      }
    }
  }
}

}  // namespace
}  // namespace converters
