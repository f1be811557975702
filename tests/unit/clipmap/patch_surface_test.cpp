// Places between knots: shared edges agree bit for bit, and the errors are those that DESIGN section 5
// states.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "globe/clipmap/patch_surface.h"
#include "tests/hard/table.h"

namespace globe::clipmap {
namespace {

Settings settings_for(int detail, Positions positions) {
  Settings settings = Settings::for_detail(detail, 0);
  settings.positions = positions;
  return settings;
}

dvec3 surface_at(int d, int level, int i, int j, const geo::Ellipsoid& ellipsoid = geo::kWgs84) {
  return geo::surface_point(ellipsoid, planet::node_direction({d, level, i, j}));
}

float height_at(int k) { return static_cast<float>(8000.0 * std::sin(k)); }

class PatchSurface : public testing::TestWithParam<Positions> {};

TEST_P(PatchSurface, PatchesAgreeBitForBitOnTheEdgesTheyShare) {
  const Settings settings = settings_for(64, GetParam());
  const int m = settings.m, level = 9;
  const dvec3 anchor = surface_at(1, level, 72, 96);
  const auto knots = [&](int d, const NodeRect& nodes) {
    return make_knots(settings, geo::kWgs84, level, d, nodes, anchor);
  };
  // a column and a row of two neighbouring blocks
  const KnotBlock west = knots(1, {64, 64 + m, 80, 80 + 2 * m}),
                  east = knots(1, {64 + m, 64 + 2 * m, 80, 80 + 2 * m});
  const KnotBlock south = knots(1, {64, 64 + 2 * m, 80 + m, 80 + 2 * m});
  for (int t = 0; t <= 2 * m; ++t) {
    const auto a = patch_surface(settings, west, 64 + m, 80 + t, height_at(t));
    const auto b = patch_surface(settings, east, 64 + m, 80 + t, height_at(t));
    EXPECT_EQ(a, b) << t;
    if (t > m) continue;
    EXPECT_EQ(patch_surface(settings, west, 64 + t, 80 + m, height_at(t)),
              patch_surface(settings, south, 64 + t, 80 + m, height_at(t)));
  }
  // edges of diamonds: (0, t) of d is (t, 0) of d + 1, (t, n) of d is (n, t) of d + 1
  const int n = planet::nodes_per_side(level);
  const KnotBlock left = knots(1, {0, m, 64, 64 + 2 * m}), right = knots(2, {64, 64 + 2 * m, 0, m});
  const KnotBlock low = knots(1, {64, 64 + 2 * m, n - m, n}), beside = knots(2, {n - m, n, 64, 64 + 2 * m});
  for (int t = 64; t <= 64 + 2 * m; ++t) {
    EXPECT_EQ(patch_surface(settings, left, 0, t, height_at(t)),
              patch_surface(settings, right, t, 0, height_at(t)));
    EXPECT_EQ(patch_surface(settings, low, t, n, height_at(t)),
              patch_surface(settings, beside, n, t, height_at(t)));
  }
}

TEST_P(PatchSurface, KnotsStandWhereTheirNodesDo) {
  const Settings settings = settings_for(64, GetParam());
  const int level = 12, step = settings.knot_step();
  const dvec3 anchor = surface_at(2, level, 1024, 2048);
  const NodeRect nodes{1024, 1056, 2048, 2080};
  const KnotBlock knots = make_knots(settings, geo::kWgs84, level, 2, nodes, anchor);
  for (int j = nodes.j0; j <= nodes.j1; j += step) {
    for (int i = nodes.i0; i <= nodes.i1; i += step) {
      const dvec3 truth = surface_at(2, level, i, j) - anchor;
      EXPECT_LE(glm::length(dvec3(patch_surface(settings, knots, i, j, 0.0f)) - truth),
                4e-7 * glm::length(truth) + 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Modes, PatchSurface, testing::Values(Positions::kChord, Positions::kQuadratic),
                         [](const auto& which) {
                           return which.param == Positions::kChord ? "Chord" : "Quadratic";
                         });

constexpr int kBlock = 64;  ///< cells

struct Errors {
  double tangential = 0, depth = 0, edge = 0;  ///< metres
};

/// Of the flat block of 64 cells in the middle of a face, where trixels are equilateral, nearly, and largest.
Errors flat_block(const geo::Ellipsoid& ellipsoid, int level) {
  const Settings settings = settings_for(512, Positions::kChord);
  EXPECT_EQ(settings.m, kBlock);
  const int at = planet::nodes_per_side(level) / 3 / kBlock * kBlock;
  const dvec3 anchor = surface_at(0, level, at + kBlock / 3, at + kBlock / 3, ellipsoid);
  const KnotBlock knots =
      make_knots(settings, ellipsoid, level, 0, {at, at + kBlock, at, at + kBlock}, anchor);
  Errors errors;
  for (int b = 0; b <= kBlock; ++b) {
    for (int a = 0; a + b <= kBlock; ++a) {
      const dvec3 u = planet::node_direction({0, level, at + a, at + b});
      const dvec3 off = dvec3(patch_surface(settings, knots, at + a, at + b, 0.0f)) -
                        (surface_at(0, level, at + a, at + b, ellipsoid) - anchor);
      const double up = glm::dot(off, u);
      errors.depth = std::max(errors.depth, -up);
      errors.tangential = std::max(errors.tangential, glm::length(off - u * up));
    }
  }
  errors.edge = glm::length(surface_at(0, level, at + kBlock, at, ellipsoid) -
                            surface_at(0, level, at, at + kBlock, ellipsoid));
  return errors;
}

/// DESIGN section 5: such a block errs tangentially with the cube of its size, and lies below the curve.
TEST(ChordPatch, ErrsAsTheInterpolatedBlockDoes) {
  const geo::Ellipsoid sphere{6371000.0, 0.0};
  const Errors coarse = flat_block(sphere, 12), fine = flat_block(sphere, 15);
  hard::report("positions",
               "flat block of 64 cells in a face's middle, level 12, sphere: tangentially, depth",
               "0.02 L^3/R^2, L^2/6R",
               hard::figure(coarse.tangential) + " m, " + hard::figure(coarse.depth) +
                   " m of L = " + hard::figure(coarse.edge * 1e-3) + " km");
  EXPECT_NEAR(coarse.depth / (coarse.edge * coarse.edge / (6.0 * sphere.a)), 1.0, 0.05);
  EXPECT_LE(coarse.tangential, 0.02 * std::pow(coarse.edge, 3) / (sphere.a * sphere.a));
  EXPECT_NEAR(coarse.tangential / fine.tangential, 512.0, 60.0);
  // Off the sphere equal angles are not equal lengths: a share e² of the depth goes sideways.
  const Errors oblate = flat_block(geo::kWgs84, 18);
  hard::report("positions", "the same, level 18, WGS84", "e^2 L^2/6R",
               hard::figure(1e3 * oblate.tangential) + " mm, " + hard::figure(oblate.depth) + " m");
  EXPECT_NEAR(oblate.depth / (oblate.edge * oblate.edge / (6.0 * sphere.a)), 1.0, 0.05);
  EXPECT_LE(oblate.tangential, 2.0 * 0.00669438 * oblate.depth);
}

}  // namespace
}  // namespace globe::clipmap
