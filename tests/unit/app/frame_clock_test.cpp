#include "app/frame_clock.h"

#include <gtest/gtest.h>

namespace {

using app::FrameClock;
using std::chrono::milliseconds;

TEST(FrameClock, BeginsNoFrameBeforeItsTurn) {
  const auto begin = FrameClock::Clock::now();
  FrameClock clock(milliseconds(5));
  for (int frame = 0; frame < 8; ++frame) {
    clock.await_turn();
    EXPECT_GE(FrameClock::Clock::now() - begin, frame * milliseconds(5)) << frame;
  }
}

TEST(FrameClock, DoesNotHurryAfterALateFrame) {
  FrameClock clock(milliseconds(5));
  clock.await_turn();
  std::this_thread::sleep_for(milliseconds(40));
  clock.await_turn();  // late
  const auto late = FrameClock::Clock::now();
  clock.await_turn();
  EXPECT_GE(FrameClock::Clock::now() - late, milliseconds(4));
}

}  // namespace
