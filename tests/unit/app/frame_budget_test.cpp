#include "app/frame_budget.h"

#include <gtest/gtest.h>

namespace app {
namespace {

TEST(FrameBudget, UploadsGetWhatDrawingUsuallyLeaves) {
  FrameBudget budget(20.0);
  for (int frame = 0; frame < 20; ++frame) budget.note(12.0 + (frame == 7 ? 100.0 : 0.0), 2.0);
  EXPECT_DOUBLE_EQ(budget.uploads_ms(), 10.0);
  for (int frame = 0; frame < 20; ++frame) budget.note(40.0, 2.0);
  EXPECT_GT(budget.uploads_ms(), 0.0) << "drawing alone takes longer, and nothing would ever load";
  EXPECT_LT(budget.uploads_ms(), 4.0);
  for (int frame = 0; frame < 20; ++frame) budget.note(6.0, 1.0);
  EXPECT_DOUBLE_EQ(budget.uploads_ms(), 15.0);
}

TEST(FrameBudget, WithoutANumberFramesWithUploadsTakeAThirdMore) {
  FrameBudget budget(std::nullopt);
  EXPECT_GT(budget.uploads_ms(), 0.0);
  for (int frame = 0; frame < 20; ++frame) budget.note(15.0 + budget.uploads_ms(), budget.uploads_ms());
  EXPECT_DOUBLE_EQ(budget.uploads_ms(), 5.0);
}

}  // namespace
}  // namespace app
