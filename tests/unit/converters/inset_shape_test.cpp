#include "converters/inset_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>

namespace converters {
namespace {

using globe::planet::dvec3;
using globe::planet::Node;

constexpr int kShapeLevel = 8;

/// The plane z = 100 x + 50 y over a cap; NaN where `is_void`.
InsetGrid<float> plane_over_cap(const dvec3& centre, double chord,
                                const std::function<bool(const Node&)>& is_void) {
  const int n = globe::planet::nodes_per_side(kShapeLevel);
  std::vector<globe::planet::InsetBlock> everywhere;
  for (int d = 0; d < globe::planet::kDiamonds; ++d) everywhere.push_back({d, 0, n, 0, n});
  InsetGrid<float> grid(kShapeLevel, everywhere, std::numeric_limits<float>::quiet_NaN());
  for (int d = 0; d < globe::planet::kDiamonds; ++d) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        const Node node{d, kShapeLevel, i, j};
        const dvec3 u = node_direction(node);
        const double away = glm::distance(u, centre);
        if (away > chord + 0.4) continue;
        const bool known = away <= chord && !is_void(node);
        grid.set(
            d, i, j,
            known ? static_cast<float>(100.0 * u.x + 50.0 * u.y) : std::numeric_limits<float>::quiet_NaN());
      }
    }
  }
  return grid;
}

InsetSamples shaped(InsetGrid<float> grid, const ShapeRule& rule, ShapeReport& report) {
  std::vector<InsetGrid<float>> values;
  values.push_back(std::move(grid));
  return shape_inset(std::move(values), rule, report);
}

TEST(InsetShape, WeightRisesFromZeroOutsideToOneWithoutASteepStepByEveryName) {
  for (const dvec3& centre :
       {dvec3(0.0, 0.0, 1.0), dvec3(1.0, 0.0, 0.0), glm::normalize(dvec3(1.0, 2.0, 0.5))}) {
    ShapeReport report;
    const InsetSamples samples =
        shaped(plane_over_cap(centre, 0.2, [](const Node&) { return false; }), {12, 0.0}, report);
    EXPECT_EQ(report.rim, 12);
    EXPECT_EQ(samples.weight.get(
                  globe::planet::fold({globe::planet::locate(centre, kShapeLevel).d, kShapeLevel,
                                       static_cast<int>(globe::planet::locate(centre, kShapeLevel).ij.x),
                                       static_cast<int>(globe::planet::locate(centre, kShapeLevel).ij.y)})),
              1.0F);
    for_each_vertex(samples.values[0], [&](const Node& node) {
      const float w = samples.weight.get(node);
      const double away = glm::distance(node_direction(node), centre);
      if (away > 0.2) {
        ASSERT_EQ(w, 0.0F);
      }
      ASSERT_TRUE(w >= 0.0F && w <= 1.0F);
      if (w > 0.0F) {
        ASSERT_FALSE(std::isnan(samples.values[0].get(node)));
      }
      const globe::planet::Names all = names(node);
      for (int k = 1; k < all.count; ++k)
        ASSERT_EQ(samples.weight.get(all.node[static_cast<std::size_t>(k)]), w);
      for (const auto& step : globe::planet::kLatticeSteps) {
        const Node beside = globe::planet::fold({node.d, kShapeLevel, node.i + step.x, node.j + step.y});
        ASSERT_LT(std::abs(samples.weight.get(beside) - w), 0.3F);
        // Values go on as far as stencils reach.
        if (w > 0.0F) {
          ASSERT_FALSE(std::isnan(samples.values[0].get(beside)));
        }
      }
    });
  }
}

TEST(InsetShape, NarrowVoidsAreFilledAndWideOnesStayOpen) {
  const dvec3 centre = glm::normalize(dvec3(1.0, 2.0, 0.5));
  const auto hole = [&](const Node& node) { return glm::distance(node_direction(node), centre) < 0.03; };
  ShapeReport filled, open;
  const InsetSamples whole = shaped(plane_over_cap(centre, 0.2, hole), {8, 64.0}, filled);
  EXPECT_GT(filled.filled, 20U);
  EXPECT_EQ(filled.open, 0U);
  for_each_vertex(whole.values[0], [&](const Node& node) {
    if (!hole(node)) return;
    const dvec3 u = node_direction(node);
    ASSERT_NEAR(static_cast<double>(whole.values[0].get(node)), 100.0 * u.x + 50.0 * u.y,
                0.5);  // a plane is tight
    ASSERT_EQ(whole.weight.get(node), 1.0F);
  });
  const InsetSamples holed = shaped(plane_over_cap(centre, 0.2, hole), {8, 2.0}, open);
  EXPECT_EQ(open.open, filled.filled);
  for_each_vertex(holed.values[0], [&](const Node& node) {
    if (hole(node)) {
      ASSERT_EQ(holed.weight.get(node), 0.0F);
    }
  });
}

}  // namespace
}  // namespace converters
