// H16: nothing behind the ground shines through it, seen from anywhere.

#include <random>

#include "tests/hard/table.h"
#include "tests/render/ground/shader_variant.h"
#include "tests/render/ground/views.h"

namespace {

using globe::gl::Framebuffer;
using globe::gl::FramebufferFormat;
using views::Camera;
using views::GlobeRenderer;
using views::Place;

constexpr int kWidth = 320;
constexpr int kHeight = 180;
constexpr double kLowestDrawn = -32000;  ///< no triangle of the planet sags lower, metres
/// One of four samples blended over black ground is 64; the night's ground stays below 10.
constexpr int kMagenta = 30;

struct Leaks {
  std::size_t pixels = 0;  ///< looked at
  std::size_t leaks = 0;
  std::size_t cameras = 0;
};

/// Draws by night: whatever red there is, is background.
std::vector<std::uint8_t> drawn_red(GlobeRenderer& renderer, const Camera& camera,
                                    const Framebuffer& picture) {
  renderer.draw(camera, views::midnight(camera), true, picture);
  const std::vector<std::uint8_t> rgba = picture.read_rgba8();
  std::vector<std::uint8_t> red(rgba.size() / 4);
  for (std::size_t k = 0; k < red.size(); ++k) red[k] = rgba[4 * k];
  return red;
}

/// Background among the rays that meet the ellipsoid lowered to the lowest ground.
void count_in_planet(const Camera& camera, const std::vector<std::uint8_t>& red, Leaks& sum) {
  ++sum.cameras;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const views::dvec3 direction =
          views::ray(camera, (2.0 * x + 1.0) / kWidth - 1.0, 1.0 - (2.0 * y + 1.0) / kHeight);
      if (globe::geo::ray_ellipsoid(globe::geo::kWgs84, kLowestDrawn, camera.position, direction) < 0) {
        continue;
      }
      ++sum.pixels;
      sum.leaks += red[static_cast<std::size_t>(y * kWidth + x)] > kMagenta ? 1 : 0;
    }
  }
}

/// Background below ground, column by column.
void count_below_ground(const std::vector<std::uint8_t>& red, Leaks& sum) {
  ++sum.cameras;
  for (int x = 0; x < kWidth; ++x) {
    bool ground = false;
    for (int y = 0; y < kHeight; ++y) {
      const bool background = red[static_cast<std::size_t>(y * kWidth + x)] > kMagenta;
      if (ground) {
        ++sum.pixels;
        sum.leaks += background ? 1 : 0;
      }
      ground = ground || !background;
    }
  }
}

/// Log-uniform between 10 m and 2000 km, jittered within equal steps; and two heights in the middle of a
/// fade. From low to high: what is loaded below serves above too.
std::vector<double> heights(const globe::clipmap::Settings& settings, std::size_t count,
                            std::mt19937_64& random) {
  std::vector<double> result;
  std::uniform_real_distribution<double> within(0.0, 1.0);
  for (std::size_t k = 0; k < count; ++k) {
    result.push_back(10.0 *
                     std::pow(2e5, (static_cast<double>(k) + within(random)) / static_cast<double>(count)));
  }
  result.push_back(views::mid_fade_height(settings, *views::builtin_planet(), settings.base_level + 5));
  result.push_back(views::mid_fade_height(settings, *views::builtin_planet(), settings.base_level + 12));
  std::sort(result.begin(), result.end());
  return result;
}

struct Detail {
  int detail;
  int samples;
};

class H16 : public GlTest, public testing::WithParamInterface<Detail> {};

Leaks leaks_looking_down(const Detail& detail, std::size_t heights_a_place, std::size_t places) {
  const auto surface = views::builtin_planet();
  GlobeRenderer renderer(surface, views::geometry_settings(detail.detail));
  FramebufferFormat format;
  format.samples = detail.samples;
  const Framebuffer picture(kWidth, kHeight, format);
  std::mt19937_64 random(160);
  Leaks sum;
  for (std::size_t p = 0; p < places; ++p) {
    const Place& place = views::hard_places()[p * views::hard_places().size() / places];
    for (const double height : heights(renderer.clipmap_settings(), heights_a_place, random)) {
      const Camera camera = views::camera_above(renderer, *surface, place, height, 20.0, -90.0);
      count_in_planet(camera, drawn_red(renderer, camera, picture), sum);
    }
  }
  return sum;
}

TEST_P(H16, NoBackgroundShowsThroughTheGroundFromAbove) {
  const Leaks sum = leaks_looking_down(GetParam(), hard::full() ? 50 : 10, views::hard_places().size());
  hard::report("H16",
               "background seen through ground, straight down, detail " + std::to_string(GetParam().detail) +
                   ", " + std::to_string(GetParam().samples) + " samples, " + std::to_string(sum.cameras) +
                   " cameras, " + std::to_string(sum.pixels) + " px",
               "0", std::to_string(sum.leaks));
  EXPECT_EQ(sum.leaks, 0u);
}

TEST_P(H16, NoBackgroundShowsBelowGroundTowardTheHorizon) {
  const auto surface = views::builtin_planet();
  GlobeRenderer renderer(surface, views::geometry_settings(GetParam().detail));
  FramebufferFormat format;
  format.samples = GetParam().samples;
  const Framebuffer picture(kWidth, kHeight, format);
  std::mt19937_64 random(161);
  std::uniform_real_distribution<double> heading(0.0, 360.0);
  const std::size_t places = views::hard_places().size();
  Leaks sum;
  for (std::size_t p = 0; p < places; ++p) {
    const Place& place = views::hard_places()[p * views::hard_places().size() / places];
    for (const double height : heights(renderer.clipmap_settings(), hard::full() ? 16 : 4, random)) {
      for (const double pitch : {0.0, -8.0, -20.0}) {
        const Camera camera = views::camera_above(renderer, *surface, place, height, heading(random), pitch);
        count_below_ground(drawn_red(renderer, camera, picture), sum);
      }
    }
  }
  hard::report("H16",
               "background below ground in a column, pitch 0 to -20, detail " +
                   std::to_string(GetParam().detail) + ", " + std::to_string(GetParam().samples) +
                   " samples, " + std::to_string(sum.cameras) + " cameras, " + std::to_string(sum.pixels) +
                   " px",
               "0", std::to_string(sum.leaks));
  EXPECT_EQ(sum.leaks, 0u);
  EXPECT_GT(sum.pixels, sum.cameras * kWidth * kHeight / 10) << "ground was hardly looked at";
}

INSTANTIATE_TEST_SUITE_P(Details, H16, testing::Values(Detail{16, 1}, Detail{64, 1}, Detail{16, 4}),
                         [](const auto& which) {
                           return "Detail" + std::to_string(which.param.detail) + "Samples" +
                                  std::to_string(which.param.samples);
                         });

/// The test bites: vertices moved by 2^-22 of their distance, each patch's by its own, leak.
TEST_F(GlTest, H16NegativeControlVerticesMovedByTwoToTheMinus22Leak) {
  const views::ShaderVariant moved(
      "clipmap.vert", "precise vec4 clip =",
      "vec3 moved = sin(vec3(12.9, 78.2, 37.7) * float(gl_VertexID + 61 * gl_InstanceID));\n"
      "  position += 2.3841858e-7 * length(position) * normalize(moved);\n"
      "  precise vec4 clip =");
  for (const int samples : {1, 4}) {
    const Leaks sum = leaks_looking_down({64, samples}, hard::full() ? 50 : 8, 2);
    hard::report("H16",
                 "negative control: vertices moved by 2^-22, " + std::to_string(samples) + " samples, " +
                     std::to_string(sum.pixels) + " px",
                 "> 0", std::to_string(sum.leaks));
    EXPECT_GT(sum.leaks, 0u);
  }
}

}  // namespace
