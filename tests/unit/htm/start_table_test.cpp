#include "globe/htm/start_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "globe/htm/trixel.h"

namespace globe::htm {
namespace {

/// Five levels down, by roots.
Descent five_levels_down(const Descent& top) {
  static_assert(StartTable::kLevel == 5);
  return step_down<4, kShort>(
      step_down<3, kShort>(step_down<2, kShort>(step_down<1, kShort>(step_down<0, kShort>(top)))));
}

TEST(StartTable, StartsWhereADescentFromTheRootWouldBe) {
  std::mt19937_64 random(70);
  std::normal_distribution<double> normal;
  int missed = 0, on_other_sides = 0;
  constexpr int kTrials = 100'000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const dvec3 u = glm::normalize(dvec3{normal(random), normal(random), normal(random)});
    const Descent top = top_of(u.x, u.y, u.z).descent;
    const Descent walked = five_levels_down(top);
    const std::optional<Descent> start = StartTable::get().descent(top);
    if (!start) {
      ++missed;
      continue;
    }
    if (start->c0 != walked.c0 || start->c1 != walked.c1 || start->c2 != walked.c2) {
      ++on_other_sides;
      continue;
    }
    const double sum = start->w0 + start->w1 + start->w2, walked_sum = walked.w0 + walked.w1 + walked.w2;
    ASSERT_NEAR(start->w0 / sum, walked.w0 / walked_sum, 1e-13);
    ASSERT_NEAR(start->w1 / sum, walked.w1 / walked_sum, 1e-13);
    ASSERT_NEAR(start->w2 / sum, walked.w2 / walked_sum, 1e-13);
    ASSERT_NEAR(start->q0 / walked.q0, 1.0, 1e-11);
    ASSERT_NEAR(start->q1 / walked.q1, 1.0, 1e-11);
    ASSERT_NEAR(start->q2 / walked.q2, 1.0, 1e-11);
  }
  EXPECT_EQ(missed, 0);
  EXPECT_EQ(on_other_sides, 0);
}

TEST(StartTable, FindsAStartForPlacesOnSidesOrLeavesThemToTheWalk) {
  for (std::uint64_t id = 8ULL << 8; id < 16ULL << 8; ++id) {
    for (const dvec3& corner : corners({id})) {
      const std::optional<Descent> start =
          StartTable::get().descent(top_of(corner.x, corner.y, corner.z).descent);
      if (!start) continue;
      EXPECT_GE(std::min({start->w0, start->w1, start->w2}), 0.0);
    }
  }
}

}  // namespace
}  // namespace globe::htm
