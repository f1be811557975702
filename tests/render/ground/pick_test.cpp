// H23: the ground picked at a pixel is the ground that the picture shows there.

#include <random>

#include "tests/hard/table.h"
#include "tests/render/ground/depth_picture.h"

namespace {

using globe::clipmap::DrawnSurface;
using globe::clipmap::Settings;
using views::Camera;
using views::DepthPicture;
using views::GlobeRenderer;
using views::kPictureHeight;
using views::kPictureWidth;
using views::Place;
using views::RenderSettings;

struct Counts {
  std::size_t pixels = 0, sky = 0, wrong = 0, morphed = 0;
  std::size_t wrong_exact = 0, wrong_coarser = 0;  ///< of the negative controls
};

void compare(const DepthPicture& picture, const DrawnSurface& drawn, const DrawnSurface& coarser,
             const views::Surface& surface, std::mt19937_64& random, Counts& counts) {
  constexpr int kPixels = 42;
  for (int k = 0; k < kPixels; ++k) {
    const auto x = static_cast<int>(random() % kPictureWidth),
               y = static_cast<int>(random() % kPictureHeight);
    ++counts.pixels;
    counts.wrong += picture.agrees(drawn, x, y) ? 0 : 1;
    counts.wrong_coarser += picture.agrees(coarser, x, y) ? 0 : 1;
    const auto picked = picture.pick(drawn, x, y);
    const auto shown = picture.height(x, y);
    counts.sky += picked ? 0 : 1;
    if (!picked || !shown) continue;
    counts.morphed += picked->point.alpha > 0.0 && picked->point.alpha < 1.0 ? 1 : 0;
    const auto place = globe::geo::geodetic_from_ecef(surface.ellipsoid(), picked->point.position);
    const double exact = surface.drawn_height(
        surface.height(globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg), 16));
    counts.wrong_exact += std::abs(exact - *shown) > picked->footprint_m + views::kHeightError_m ? 1 : 0;
  }
}

TEST_F(GlTest, H23TheGroundPickedAtAPixelIsTheGroundShownThere) {
  const auto surface = views::builtin_planet();
  std::mt19937_64 random(23);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Counts counts;
  const std::size_t cameras = hard::cases(240);
  const std::vector<int> details = hard::full() ? std::vector{16, 64, 128} : std::vector{16};
  for (const int detail : details) {
    GlobeRenderer renderer(surface, views::geometry_settings(detail));
    const Settings& settings = renderer.clipmap_settings();
    const globe::gl::Framebuffer frame(kPictureWidth, kPictureHeight);
    for (std::size_t k = 0; k < cameras / details.size(); ++k) {
      const Place& place = views::hard_places()[k % views::hard_places().size()];
      const double above = k % 4 == 3 ? views::mid_fade_height(settings, *surface,
                                                               settings.base_level + 1 + int(random() % 16))
                                      : 2.0 * std::pow(5e6, unit(random));
      const double dip = std::acos(6.37e6 / (6.37e6 + above)) * 57.3;
      const Camera camera =
          views::camera_above(renderer, *surface, place, above, 360.0 * unit(random),
                              -dip - (90.0 - dip) * std::pow(unit(random), 2.0), k % 2 == 0 ? 60.0 : 6.0);
      const DepthPicture picture(renderer, frame, *surface, camera);
      const int max_level = RenderSettings{}.max_level;
      const DrawnSurface drawn =
          globe::clipmap::complete_surface(settings, surface, camera.position, max_level);
      const DrawnSurface coarser = globe::clipmap::complete_surface(
          settings, surface, camera.position + camera.position * (above / glm::length(camera.position)),
          max_level);
      compare(picture, drawn, coarser, *surface, random, counts);
    }
  }
  const std::string of = std::to_string(counts.pixels) + " px";
  hard::report("H23", "picked heights off the picture's by more than a footprint and 1 cm, " + of, "0",
               std::to_string(counts.wrong));
  hard::report("H23", "negative control: exact ground for what is drawn", "> 0",
               std::to_string(counts.wrong_exact));
  hard::report("H23", "negative control: the surface drawn for a camera twice as high", "> 0",
               std::to_string(counts.wrong_coarser));
  EXPECT_EQ(counts.wrong, 0u);
  EXPECT_GT(counts.pixels - counts.sky, counts.pixels / 3);
  EXPECT_GT(counts.morphed, 0u);
  EXPECT_GT(counts.wrong_exact, 0u);
  EXPECT_GT(counts.wrong_coarser, 0u);
}

}  // namespace
