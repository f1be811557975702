#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "converters/footprint.h"
#include "converters/map_geometry.h"
#include "converters/node_block.h"
#include "globe/base/error.h"
#include "tests/unit/converters/test_maps.h"

namespace converters {
namespace {

using globe::planet::Node;
using globe::planet::nodes_per_side;

constexpr double kDegree = std::numbers::pi / 180.0;

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

TEST(Footprint, TilesThePlanetWithoutGapOrOverlap) {
  const MapGeometry map = test::geometry_of(360, 180);
  for (const int level : {0, 1, 2, 5}) {
    const Scanlines lines(map, level);
    const int n = nodes_per_side(level);
    // Length of every scan line inside footprints, each vertex once: must be a whole turn.
    std::vector<double> covered(static_cast<std::size_t>(lines.count()), 0.0);
    for (int d = 0; d < 4; ++d) {
      for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
          const Node node{d, level, i, j};
          if ((i == 0 && j == 0) || (i == n && j == n)) continue;
          const globe::planet::Names names = globe::planet::names(node);
          bool first_name = true;
          for (int k = 1; k < names.count; ++k)
            first_name = first_name && names.node[static_cast<std::size_t>(k)].d > d;
          if (!first_name) continue;
          const Footprint footprint = footprint_of(map, node);
          for (int line = lines.first_from(footprint.min_y()); line < lines.first_from(footprint.max_y());
               ++line) {
            std::vector<double> x;
            for (int k = 0; k < footprint.count; ++k) {
              const auto a = footprint.corner[static_cast<std::size_t>(k)];
              const auto b = footprint.corner[static_cast<std::size_t>((k + 1) % footprint.count)];
              const double y = lines.y(line);
              if ((y < a.y) != (y < b.y)) x.push_back(a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y));
            }
            std::sort(x.begin(), x.end());
            for (std::size_t k = 0; k + 1 < x.size(); k += 2)
              covered[static_cast<std::size_t>(line)] += x[k + 1] - x[k];
          }
        }
      }
    }
    const int north = lines.first_from(cap_rim(map, level, true));
    const int south = lines.first_from(cap_rim(map, level, false));
    for (int line = north; line < south; ++line)
      ASSERT_NEAR(covered[static_cast<std::size_t>(line)], map.period, 1e-9)
          << "level " << level << " line " << line;
  }
}

TEST(Scanlines, WeighsBandsByTheirAreaOnTheSphere) {
  const MapGeometry map = test::geometry_of(36, 18);
  const Scanlines lines(map, 4);
  double sum = 0;
  for (int line = 0; line < lines.count(); ++line) sum += lines.weight(line);
  EXPECT_NEAR(sum, 2.0, 1e-12);
  EXPECT_NEAR(lines.weight(0) / lines.weight(lines.count() / 2),
              (1.0 - std::cos(180.0 / lines.count() * kDegree)) / std::sin(180.0 / lines.count() * kDegree),
              1e-9);
}

}  // namespace
}  // namespace converters
