#include "globe/render/admission.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace globe::render {
namespace {

using clipmap::FinestLevel;

TEST(Admission, ALevelThatIsThereInTimeFadesInByHeightAlone) {
  Admission admission;
  for (int frame = 0; frame <= 200; ++frame) {
    const double level = 8.0 + 0.02 * frame;
    const double t = std::clamp(1.0 - 2.0 * (level - std::floor(level)), 0.0, 1.0);
    const FinestLevel wanted{static_cast<int>(level), static_cast<float>(t)};
    const FinestLevel shown = admission.next(wanted, wanted.level + 1);
    EXPECT_EQ(shown.level, wanted.level);
    EXPECT_EQ(shown.fade, wanted.fade);
  }
}

TEST(Admission, ALevelThatComesLateMorphsIn) {
  Admission admission;
  admission.next({10, 0.0f}, 9);
  float fade = 1.0f;
  int frames = 0;
  for (FinestLevel shown = admission.next({10, 0.0f}, 10); shown.fade > 0.0f; ++frames) {
    EXPECT_EQ(shown.level, 10);
    EXPECT_LT(shown.fade, fade);
    EXPECT_GT(shown.fade, fade - 0.25f) << "a pop";
    fade = shown.fade;
    shown = admission.next({10, 0.0f}, 10);
  }
  EXPECT_GE(frames, 8);
  EXPECT_LE(frames, 11);
}

/// What a frame shows as one number: level l at fade f is level l - f.
double depth(const FinestLevel& shown) { return shown.level - static_cast<double>(shown.fade); }

TEST(Admission, LevelsThatComeTogetherMorphInOneAfterTheOther) {
  Admission admission;
  const FinestLevel wanted{20, 0.3f};
  admission.next(wanted, 6);
  double before = 6.0;
  int frames = 0;
  for (FinestLevel shown = admission.next(wanted, 20);; shown = admission.next(wanted, 20), ++frames) {
    EXPECT_GE(depth(shown), before);
    EXPECT_LE(depth(shown), before + 1.0) << "more than a level in a frame";
    before = depth(shown);
    if (shown.level == wanted.level && shown.fade == wanted.fade) break;
    ASSERT_LT(frames, 60);
  }
  EXPECT_GE(frames, 20);
}

TEST(Admission, AnyMotionAndAnyArrivalsGiveLevelsThatAreThereAndSettle) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  for (int run = 0; run < 300; ++run) {
    Admission admission;
    FinestLevel before{-1, 0.0f};
    for (int frame = 0; frame < 50; ++frame) {
      const FinestLevel wanted{6 + static_cast<int>(random() % 15),
                               unit(random) < 0.5f ? 0.0f : unit(random)};
      const int available = 6 + static_cast<int>(random() % 15);
      const FinestLevel shown = admission.next(wanted, available);
      EXPECT_LE(shown.level, std::min(wanted.level, available));
      EXPECT_GE(shown.fade, 0.0f);
      EXPECT_LE(shown.fade, 1.0f);
      if (shown.level == wanted.level) {
        EXPECT_GE(shown.fade, wanted.fade);
      }
      // A finer level comes after the one below has morphed in.
      if (before.level >= 0 && shown.level > before.level) {
        EXPECT_EQ(shown.level, before.level + 1);
        EXPECT_EQ(before.fade, 0.0f);
      }
      before = shown;
    }
    const FinestLevel wanted{20, 0.25f};
    FinestLevel shown{};
    for (int frame = 0; frame < 60; ++frame) shown = admission.next(wanted, 21);
    EXPECT_EQ(shown.level, wanted.level);
    EXPECT_EQ(shown.fade, wanted.fade);
  }
}

}  // namespace
}  // namespace globe::render
