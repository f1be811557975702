// H16: nothing behind the ground shines through it, seen from anywhere.

#include <random>

#include "tests/hard/table.h"
#include "tests/node_planet.h"
#include "tests/render/ground/shader_variant.h"
#include "tests/render/ground/views.h"
#include "tests/temporary_folder.h"

namespace {

using globe::gl::Framebuffer;
using globe::gl::FramebufferFormat;
using views::Camera;
using views::GlobeRenderer;
using views::Place;

constexpr int kLeakWidth = 320;
constexpr int kLeakHeight = 180;
constexpr double kLowestDrawn = -32000;  ///< no triangle of the planet sags lower, metres
/// One of four samples blended over black ground is 64; the night's ground stays below 10.
constexpr int kMagentaLevel = 30;

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
  for (int y = 0; y < kLeakHeight; ++y) {
    for (int x = 0; x < kLeakWidth; ++x) {
      const views::dvec3 direction =
          views::ray(camera, (2.0 * x + 1.0) / kLeakWidth - 1.0, 1.0 - (2.0 * y + 1.0) / kLeakHeight);
      if (globe::geo::ray_ellipsoid(globe::geo::kWgs84, kLowestDrawn, camera.position, direction) < 0) {
        continue;
      }
      ++sum.pixels;
      sum.leaks += red[static_cast<std::size_t>(y * kLeakWidth + x)] > kMagentaLevel ? 1 : 0;
    }
  }
}

/// Background below ground, column by column.
void count_below_ground(const std::vector<std::uint8_t>& red, Leaks& sum) {
  ++sum.cameras;
  for (int x = 0; x < kLeakWidth; ++x) {
    bool ground = false;
    for (int y = 0; y < kLeakHeight; ++y) {
      const bool background = red[static_cast<std::size_t>(y * kLeakWidth + x)] > kMagentaLevel;
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
std::vector<double> heights(const GlobeRenderer& renderer, const views::Surface& surface, std::size_t count,
                            std::mt19937_64& random) {
  const globe::clipmap::Settings& settings = renderer.clipmap_settings();
  std::vector<double> result;
  std::uniform_real_distribution<double> within(0.0, 1.0);
  for (std::size_t k = 0; k < count; ++k) {
    result.push_back(10.0 *
                     std::pow(2e5, (static_cast<double>(k) + within(random)) / static_cast<double>(count)));
  }
  result.push_back(views::mid_fade_height(settings, surface, settings.base_level + 5));
  result.push_back(views::mid_fade_height(settings, surface, settings.base_level + 12));
  std::sort(result.begin(), result.end());
  return result;
}

struct Detail {
  int detail;
  int samples;
};

class H16 : public GlTest, public testing::WithParamInterface<Detail> {
 protected:
  /// In full, or quickly at detail 16, at finer ones.
  static std::size_t cameras(std::size_t full, std::size_t coarse, std::size_t fine) {
    if (hard::full()) return full;
    return GetParam().detail > 16 ? fine : coarse;
  }
};

Leaks leaks_looking_down(const std::shared_ptr<const views::Surface>& surface, const Detail& detail,
                         std::size_t heights_a_place, std::size_t places) {
  GlobeRenderer renderer(surface, views::geometry_settings(detail.detail));
  FramebufferFormat format;
  format.samples = detail.samples;
  const Framebuffer picture(kLeakWidth, kLeakHeight, format);
  std::mt19937_64 random(160);
  Leaks sum;
  for (std::size_t p = 0; p < places; ++p) {
    const Place& place = views::hard_places()[p * views::hard_places().size() / places];
    for (const double height : heights(renderer, *surface, heights_a_place, random)) {
      const Camera camera = views::camera_above(renderer, *surface, place, height, 20.0, -90.0);
      count_in_planet(camera, drawn_red(renderer, camera, picture), sum);
    }
  }
  return sum;
}

TEST_P(H16, NoBackgroundShowsThroughTheGroundFromAbove) {
  const Leaks sum = leaks_looking_down(views::builtin_planet(), GetParam(), cameras(50, 10, 4),
                                       views::hard_places().size());
  hard::report("H16",
               "background seen through ground, straight down, detail " + std::to_string(GetParam().detail) +
                   ", " + std::to_string(GetParam().samples) + " samples, " + std::to_string(sum.cameras) +
                   " cameras, " + std::to_string(sum.pixels) + " px",
               "0", std::to_string(sum.leaks));
  EXPECT_EQ(sum.leaks, 0u);
}

Leaks leaks_toward_the_horizon(const std::shared_ptr<const views::Surface>& surface, const Detail& detail,
                               std::size_t heights_a_place) {
  GlobeRenderer renderer(surface, views::geometry_settings(detail.detail));
  FramebufferFormat format;
  format.samples = detail.samples;
  const Framebuffer picture(kLeakWidth, kLeakHeight, format);
  std::mt19937_64 random(161);
  std::uniform_real_distribution<double> heading(0.0, 360.0);
  const std::size_t places = views::hard_places().size();
  Leaks sum;
  for (std::size_t p = 0; p < places; ++p) {
    const Place& place = views::hard_places()[p * views::hard_places().size() / places];
    for (const double height : heights(renderer, *surface, heights_a_place, random)) {
      for (const double pitch : {0.0, -8.0, -20.0}) {
        const Camera camera = views::camera_above(renderer, *surface, place, height, heading(random), pitch);
        count_below_ground(drawn_red(renderer, camera, picture), sum);
      }
    }
  }
  return sum;
}

TEST_P(H16, NoBackgroundShowsBelowGroundTowardTheHorizon) {
  const Leaks sum = leaks_toward_the_horizon(views::builtin_planet(), GetParam(),
                                             hard::full()             ? 16
                                             : GetParam().detail > 16 ? 1
                                                                      : 3);
  hard::report("H16",
               "background below ground in a column, pitch 0 to -20, detail " +
                   std::to_string(GetParam().detail) + ", " + std::to_string(GetParam().samples) +
                   " samples, " + std::to_string(sum.cameras) + " cameras, " + std::to_string(sum.pixels) +
                   " px",
               "0", std::to_string(sum.leaks));
  EXPECT_EQ(sum.leaks, 0u);
  EXPECT_GT(sum.pixels, sum.cameras * kLeakWidth * kLeakHeight / 10) << "ground was hardly looked at";
}

/// Rough finer ground over the pole, a corner of the octahedron, an edge of diamonds and the equator's fold.
std::shared_ptr<const views::Surface> planet_with_insets(const std::filesystem::path& folder) {
  tests::write_node_planet(folder, 6, globe::geo::kWgs84, tests::hashed_heights(3, -2000.0, 3000.0));
  int level = 9;
  for (const char* name : {"north pole", "corner at 90", "edge at 0 north", "fold at 30"}) {
    const auto place = std::find_if(views::hard_places().begin(), views::hard_places().end(),
                                    [&](const Place& p) { return p.name == name; });
    std::string file_name = name;
    std::replace(file_name.begin(), file_name.end(), ' ', '_');
    tests::add_inset(folder,
                     {file_name, level, globe::geo::normal_from_degrees(place->lat_deg, place->lon_deg), 0.02,
                      0.04, tests::hashed_heights(4, 0.0, 2500.0)});
    level = level == 9 ? 11 : 9;
  }
  return tests::open_surface(folder);
}

TEST_F(GlTest, H16NoBackgroundShowsThroughInsets) {
  const tests::TemporaryFolder folder;
  const auto surface = planet_with_insets(folder / "planet");
  ASSERT_EQ(surface->info().insets.size(), 4u);
  const Leaks above =
      leaks_looking_down(surface, {16, 1}, hard::full() ? 40 : 6, views::hard_places().size());
  const Leaks aside = leaks_toward_the_horizon(surface, {16, 1}, hard::full() ? 12 : 2);
  hard::report("H16",
               "background seen through insets over a pole, a corner, an edge and the fold, " +
                   std::to_string(above.cameras + aside.cameras) + " cameras, " +
                   std::to_string(above.pixels + aside.pixels) + " px",
               "0", std::to_string(above.leaks + aside.leaks));
  EXPECT_EQ(above.leaks, 0u);
  EXPECT_EQ(aside.leaks, 0u);
}

/// Detail 128 takes as long as all others: in the full run only.
std::vector<Detail> details() {
  std::vector<Detail> result{{16, 1}, {64, 1}, {16, 4}};
  if (hard::full()) result.push_back({128, 1});
  return result;
}

INSTANTIATE_TEST_SUITE_P(Details, H16, testing::ValuesIn(details()), [](const auto& which) {
  return "Detail" + std::to_string(which.param.detail) + "Samples" + std::to_string(which.param.samples);
});

/// The test bites: vertices moved by 2^-22 of their distance, each patch's by its own, leak.
TEST_F(GlTest, H16NegativeControlVerticesMovedByTwoToTheMinus22Leak) {
  const views::ShaderVariant moved(
      "clipmap.vert", "precise vec4 clip =",
      "vec3 moved = sin(vec3(12.9, 78.2, 37.7) * float(gl_VertexID + 61 * gl_InstanceID));\n"
      "  position += 2.3841858e-7 * length(position) * normalize(moved);\n"
      "  precise vec4 clip =");
  for (const int samples : {1, 4}) {
    const Leaks sum = leaks_looking_down(views::builtin_planet(), {64, samples}, hard::full() ? 50 : 8, 2);
    hard::report("H16",
                 "negative control: vertices moved by 2^-22, " + std::to_string(samples) + " samples, " +
                     std::to_string(sum.pixels) + " px",
                 "> 0", std::to_string(sum.leaks));
    EXPECT_GT(sum.leaks, 0u);
  }
}

}  // namespace
