#include "converters/round_trip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "converters/thesis_mapping.h"
#include "globe/base/angles.h"
#include "globe/planet/grid.h"

namespace converters {
namespace {

using globe::kDegree;
using globe::geo::dvec3;

constexpr int kWidth = 512;  ///< 128 pixels in 90 degrees: level 7

const Harmonics kRelief(64, 20261124, 1000.0);

RoundTripLoss loss_of(const RoundTripMethod& method, int level) {
  static const HeightMap map = map_of(kRelief, kWidth);
  static const HeightMap truth = map_of(kRelief, kWidth * 3 / 2);
  return round_trip(map, method, level, truth);
}

double rms(Filter filter, Sampling sampling, int level) {
  return loss_of({filter, sampling, false}, level).rms_m;
}

TEST(Harmonics, HaveTheHeightsAskedForAndTheSameAlongARowAsAtAPlace) {
  const Harmonics harmonics(64, 5, 1000.0);
  const HeightMap map = map_of(harmonics, 256);
  double squares = 0, area = 0;
  for (int y = 0; y < map.height(); ++y) {
    const double lat = 90.0 - (y + 0.5) * map.step_deg();
    for (int x = 0; x < map.width; ++x) {
      const double value = map.metres[static_cast<std::size_t>(y * map.width + x)];
      squares += std::cos(lat * kDegree) * value * value;
      area += std::cos(lat * kDegree);
    }
    const double first = map.metres[static_cast<std::size_t>(y * map.width)];
    EXPECT_NEAR(first, harmonics.at(lat, -180.0 + 0.5 * map.step_deg()), 1e-3);
  }
  EXPECT_NEAR(std::sqrt(squares / area), 1000.0, 1.0);
}

TEST(RoundTrip, LosesByTheOrderOfTheFilter) {
  // Nodes at twice the pixels' density and more: what is left is the filter's own error on the pixels.
  const double nearest = rms(Filter::kNearest, Sampling::kNearest, 8);
  const double bilinear = rms(Filter::kBilinear, Sampling::kLinear, 8);
  const double bicubic = rms(Filter::kBicubic, Sampling::kLinear, 8);
  EXPECT_LT(bilinear, 0.25 * nearest);
  EXPECT_LT(bicubic, 0.8 * bilinear);
  // Where the nodes are what limits: a level more halves the error of nearest, quarters that of linear.
  EXPECT_NEAR(rms(Filter::kBicubic, Sampling::kNearest, 6) / rms(Filter::kBicubic, Sampling::kNearest, 7),
              2.0, 0.4);
  EXPECT_NEAR(rms(Filter::kBicubic, Sampling::kLinear, 6) / rms(Filter::kBicubic, Sampling::kLinear, 7), 4.0,
              0.8);
}

TEST(RoundTrip, AtTheMapsOwnLevelLosesLessThanAHundredth) {
  const RoundTripLoss loss = loss_of({}, 7);
  EXPECT_GT(loss.psnr_db, 40.0);
  EXPECT_LT(loss.rms_m, 60.0);
  EXPECT_EQ(loss.nodes, 4U * 129 * 129);
  EXPECT_EQ(loss.pixels, 768U * 384);
}

TEST(RoundTrip, TheThesisMethodIsFarWorse) {
  for (const int level : {6, 7, 8}) {
    const RoundTripLoss exact = loss_of({}, level);
    const RoundTripLoss thesis = loss_of({Filter::kBilinear, Sampling::kLinear, true}, level);
    EXPECT_GT(thesis.rms_m, 500.0) << "half the height of the relief itself";
    EXPECT_GT(thesis.rms_m, 5.0 * exact.rms_m) << level;
  }
}

TEST(ThesisMapping, IsRightOnTheMeridiansBetweenDiamondsTheEquatorAndThePoles) {
  for (int lon = -180; lon <= 180; lon += 90) {
    for (int lat = -90; lat <= 90; lat += 15) {
      if (lat % 45 != 0) continue;  // of those between, vertices only
      const dvec3 u = globe::geo::normal_from_degrees(lat, lon);
      EXPECT_LT(glm::length(thesis_direction(u) - u), 1e-9) << lat << ' ' << lon;
    }
  }
  for (int lon = -180; lon < 180; lon += 45) {
    const dvec3 u = globe::geo::normal_from_degrees(0, lon);
    EXPECT_LT(glm::length(thesis_direction(u) - u), 1e-9) << lon;
  }
}

TEST(ThesisMapping, IsOffByUpTo1083Kilometres) {
  constexpr int kLevel = 7;
  const int n = globe::planet::nodes_per_side(kLevel);
  double worst = 0;
  globe::planet::Node where;
  for (int d = 0; d < globe::planet::kDiamonds; ++d) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        const dvec3 u = globe::planet::node_direction({d, kLevel, i, j});
        const dvec3 thesis = thesis_direction(u);
        const double angle = std::atan2(glm::length(glm::cross(u, thesis)), glm::dot(u, thesis));
        if (angle > worst + 1e-12) {
          worst = angle;
          where = {d, kLevel, i, j};
        }
        // Rows are linear in latitude, by definition.
        const double lat = globe::geo::degrees_from_normal(thesis).lat_deg;
        ASSERT_NEAR(lat, 90.0 - 90.0 * (i + j) / n, 1e-6);
      }
    }
  }
  EXPECT_NEAR(worst / kDegree, kThesisShift_deg, 1e-6);
  EXPECT_EQ(where, (globe::planet::Node{0, kLevel, n / 4, n / 4}));
  EXPECT_NEAR(worst * globe::geo::kWgs84.mean_radius() / 1000.0, 1082.6, 0.1);
  EXPECT_NEAR(kThesisShift_deg, std::atan(std::sqrt(2.0)) / kDegree - 45.0, 1e-12);
}

TEST(ThesisMapping, ShiftsTheDataByAsMuch) {
  // A map that tells its own latitude, 1 m a degree.
  HeightMap map{720, -180.0, {}};
  for (int y = 0; y < 360; ++y) map.metres.insert(map.metres.end(), 720, static_cast<float>(89.75 - 0.5 * y));
  const RoundTripLoss thesis = round_trip(map, {Filter::kBilinear, Sampling::kLinear, true}, 8, map);
  EXPECT_NEAR(thesis.max_m, kThesisShift_deg, 0.02);
  EXPECT_LT(round_trip(map, {}, 8, map).max_m, 0.26) << "half a pixel, at the poles";
}

}  // namespace
}  // namespace converters
