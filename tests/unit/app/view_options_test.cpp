#include "app/view_options.h"

#include <gtest/gtest.h>

#include "globe/base/error.h"

namespace app {
namespace {

TEST(ParseLook, ReadsHeadingAndPitch) {
  const Look look = parse_look("-45.5,+10");
  EXPECT_EQ(look.heading_deg, -45.5);
  EXPECT_EQ(look.pitch_deg, 10.0);
}

TEST(ParseLook, ReadsARoll) {
  EXPECT_EQ(parse_look("10,-5,2.5").roll_deg, 2.5);
  EXPECT_EQ(parse_look("10,-5").roll_deg, 0.0);
}

TEST(ParseLook, RefusesWhatIsNoView) {
  for (const char* text : {"", "10", "10,", ",10", "10,91", "10,-90.5", "nan,0", "1e999,0", "10;5", "10,5,",
                           "10,5,x", "10,5,3,1"}) {
    EXPECT_THROW(parse_look(text), globe::UsageError) << text;
  }
}

TEST(ParseSize, ReadsWidthAndHeight) {
  const Size size = parse_size("1280x720");
  EXPECT_EQ(size.width, 1280);
  EXPECT_EQ(size.height, 720);
}

TEST(ParseSize, RefusesWhatCannotBeDrawn) {
  for (const char* text :
       {"", "1280", "x720", "1280x", "0x0", "15x720", "1280x99999", "-5x20", "1280x720x3", "axb"}) {
    EXPECT_THROW(parse_size(text), globe::UsageError) << text;
  }
}

TEST(RenderSettings, BackgroundIsSixHexadecimalDigits) {
  ViewOptions options;
  options.background = "ff0080";
  const auto settings = render_settings(options);
  ASSERT_TRUE(settings.background.has_value());
  EXPECT_EQ(settings.background->r, 1.0f);
  EXPECT_EQ(settings.background->g, 0.0f);
  EXPECT_NEAR(settings.background->b, 128.0f / 255.0f, 1e-6f);
  for (const char* text : {"ff00", "ff00zz", "#ff00f", "ff00ff0"}) {
    options.background = text;
    EXPECT_THROW(render_settings(options), globe::UsageError) << text;
  }
}

TEST(RenderSettings, DetailIsRoundedUpToWholePatches) {
  ViewOptions options;
  options.detail = 100;
  const auto clipmap = render_settings(options).clipmap;
  EXPECT_EQ(clipmap.m, 8);
  EXPECT_EQ(clipmap.s, 112);
  EXPECT_EQ(clipmap.base_level, 6);
  options.detail = 15;
  EXPECT_THROW(render_settings(options), globe::UsageError);
  options.detail = 1025;
  EXPECT_THROW(render_settings(options), globe::UsageError);
}

TEST(RenderSettings, PositionsAreOneOfFourWords) {
  ViewOptions options;
  EXPECT_EQ(render_settings(options).clipmap.positions, globe::clipmap::Positions::kExact);
  options.positions = "chord";
  EXPECT_EQ(render_settings(options).clipmap.positions, globe::clipmap::Positions::kChord);
  for (const char* text : {"", "Exact", "double", "quadratic,chord"}) {
    options.positions = text;
    EXPECT_THROW(render_settings(options), globe::UsageError) << text;
  }
}

TEST(RenderSettings, WindowsAreOneOfTwoWordsAndHexagonsHoldPositions) {
  ViewOptions options;
  EXPECT_EQ(render_settings(options).clipmap.windows, globe::clipmap::Windows::kPlain);
  options.window = "hexagon";
  EXPECT_EQ(render_settings(options).clipmap.windows, globe::clipmap::Windows::kHexagon);
  options.positions = "float32";
  EXPECT_NO_THROW(render_settings(options));
  options.positions = "quadratic";
  EXPECT_THROW(render_settings(options), globe::UsageError);
  options.positions = "exact";
  for (const char* text : {"", "Plain", "square"}) {
    options.window = text;
    EXPECT_THROW(render_settings(options), globe::UsageError) << text;
  }
}

}  // namespace
}  // namespace app
