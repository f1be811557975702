#include "app/tuning.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace app {
namespace {

accuracy::DrawingQuality quality(int detail, double error_px, double ms, double high_ms) {
  accuracy::DrawingQuality result;
  result.detail = detail;
  result.error_px.max = error_px;
  result.frame.ms = {ms, ms, ms, ms, high_ms, 31, {ms}};
  return result;
}

const std::vector<accuracy::DrawingQuality> kMeasured{
    quality(16, 9.0, 8.0, 9.0), quality(32, 4.0, 10.0, 11.0), quality(64, 2.0, 16.0, 17.5),
    quality(128, 1.0, 30.0, 34.0)};

TEST(Tuning, TakesTheSmallestErrorThatKeepsTheFrameRateWithItsWholeInterval) {
  EXPECT_EQ(tune(kMeasured, {60.0, {}}).chosen, 1u)
      << "64 has a median of 16 ms, but its interval ends at 17.5";
  EXPECT_EQ(tune(kMeasured, {57.0, {}}).chosen, 2u);
  EXPECT_EQ(tune(kMeasured, {10.0, {}}).chosen, 3u);
}

TEST(Tuning, TakesTheFastestThatKeepsTheError) {
  EXPECT_EQ(tune(kMeasured, {{}, 4.0}).chosen, 1u);
  EXPECT_EQ(tune(kMeasured, {{}, 1.5}).chosen, 3u);
  EXPECT_EQ(tune(kMeasured, {{}, 50.0}).chosen, 0u);
}

TEST(Tuning, NamesTheNearestWhereNothingReachesTheGoal) {
  const Tuning too_fast = tune(kMeasured, {1000.0, {}}), too_exact = tune(kMeasured, {{}, 0.5});
  EXPECT_FALSE(too_fast.chosen);
  EXPECT_EQ(too_fast.nearest, 0u);
  EXPECT_FALSE(too_exact.chosen);
  EXPECT_EQ(too_exact.nearest, 3u);
}

RC_GTEST_PROP(Tuning, NothingThatReachesTheGoalIsBetterThanWhatIsChosen, ()) {
  const auto figures = *rc::gen::nonEmpty(rc::gen::container<std::vector<std::pair<int, int>>>(
      rc::gen::pair(rc::gen::inRange(1, 50), rc::gen::inRange(1, 50))));
  std::vector<accuracy::DrawingQuality> measured;
  for (const auto& [error, ms] : figures) measured.push_back(quality(64, error, ms, ms));
  const double fps = 1000.0 / *rc::gen::inRange(1, 50);
  const Tuning tuning = tune(measured, {fps, {}});
  for (const auto& each : measured) {
    if (each.frame.ms.high > 1000.0 / fps) continue;
    RC_ASSERT(tuning.chosen.has_value());
    RC_ASSERT(measured[*tuning.chosen].error_px.max <= each.error_px.max);
  }
  if (tuning.chosen) RC_ASSERT(tuning.on_front[*tuning.chosen]);
}

}  // namespace
}  // namespace app
