// Planets of other shapes and sizes: a sphere of 1 m, of 1e9 m, Mars, an ellipsoid with f = 0.2, and data of
// one level, are drawn without leaks and picked as they are drawn.

#include <random>

#include "tests/hard/table.h"
#include "tests/node_planet.h"
#include "tests/render/ground/depth_picture.h"
#include "tests/temporary_folder.h"

namespace {

using globe::clipmap::Settings;
using globe::geo::Ellipsoid;
using views::Camera;
using views::DepthPicture;
using views::GlobeRenderer;
using views::kPictureHeight;
using views::kPictureWidth;
using views::Place;

struct Shape {
  std::string name;
  Ellipsoid ellipsoid;
  int data_level;
};

class PlanetShapes : public GlTest, public testing::WithParamInterface<Shape> {};

struct ShapeCounts {
  std::size_t pixels = 0, leaks = 0, picked = 0, wrong = 0;
};

/// Sky among the rays that meet the ellipsoid lowered to below all that is drawn, or nearly: ground made up
/// below coarse data may lie lower still. At the limb double precision sees sky there too.
void count_leaks(const DepthPicture& picture, const globe::clipmap::DrawnSurface& drawn,
                 const Ellipsoid& ellipsoid, double lowest_m, ShapeCounts& counts) {
  for (int y = 0; y < kPictureHeight; ++y) {
    for (int x = 0; x < kPictureWidth; ++x) {
      if (globe::geo::ray_ellipsoid(ellipsoid, lowest_m, picture.camera().position, picture.direction(x, y)) <
          0)
        continue;
      ++counts.pixels;
      counts.leaks += picture.height(x, y) || picture.agrees(drawn, x, y) ? 0 : 1;
    }
  }
}

/// Sky below ground in a column. Beside a picture's middle columns lean, so that a cliff may have sky below
/// it: there double precision sees sky too.
void count_below_ground(const DepthPicture& picture, const globe::clipmap::DrawnSurface& drawn,
                        ShapeCounts& counts) {
  for (int x = 0; x < kPictureWidth; ++x) {
    bool ground = false;
    for (int y = 0; y < kPictureHeight; ++y) {
      const bool sky = !picture.height(x, y);
      counts.pixels += ground ? 1 : 0;
      counts.leaks += ground && sky && !picture.agrees(drawn, x, y) ? 1 : 0;
      ground = ground || !sky;
    }
  }
}

TEST_P(PlanetShapes, AreDrawnWithoutLeaksAndPickedAsTheyAreDrawn) {
  const Shape& shape = GetParam();
  const double radius = shape.ellipsoid.mean_radius();
  const double relief = 1e-3 * radius;
  const tests::TemporaryFolder folder;
  tests::write_node_planet(folder / "planet", shape.data_level, shape.ellipsoid,
                           tests::hashed_heights(5, -relief, relief));
  const auto surface = tests::open_surface(folder / "planet");
  GlobeRenderer renderer(surface, views::geometry_settings(16));
  const Settings& settings = renderer.clipmap_settings();
  const int max_level = views::RenderSettings{}.max_level;
  const globe::gl::Framebuffer frame(kPictureWidth, kPictureHeight);
  // The base level's flat triangles lie this deep below the ellipsoid, by the least radius of curvature.
  const double side = std::ldexp(1.56 / std::sqrt(3.0) * surface->root_edge(), -settings.base_level);
  const double least_radius = shape.ellipsoid.b() * shape.ellipsoid.b() / shape.ellipsoid.a;
  const double lowest_m = -1.1 * (side * side / (2.0 * least_radius) + relief);
  std::mt19937_64 random(77);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  ShapeCounts counts;
  const std::size_t cameras = hard::full() ? 120 : 12;
  for (std::size_t k = 0; k < cameras; ++k) {
    const Place& place = views::hard_places()[k % views::hard_places().size()];
    // from three millionths of the radius to three radii, 2 m at least on planets
    const double above = std::max(radius * 3e-6 * std::pow(1e6, unit(random)), std::min(2.0, 3e-6 * radius));
    const bool down = k % 3 == 0;
    const Camera camera = views::camera_above(renderer, *surface, place, above, 360.0 * unit(random),
                                              down ? -90.0 : -30.0 * unit(random), k % 2 == 0 ? 60.0 : 12.0);
    const DepthPicture picture(renderer, frame, *surface, camera);
    const auto drawn = globe::clipmap::complete_surface(settings, surface, camera.position, max_level);
    if (down) {
      count_leaks(picture, drawn, shape.ellipsoid, lowest_m, counts);
    } else {
      count_below_ground(picture, drawn, counts);
    }
    for (int p = 0; p < 20; ++p) {
      const auto x = static_cast<int>(random() % kPictureWidth),
                 y = static_cast<int>(random() % kPictureHeight);
      counts.picked += picture.height(x, y) ? 1 : 0;
      counts.wrong += picture.agrees(drawn, x, y) ? 0 : 1;
    }
  }
  hard::report("H16", shape.name + ": sky through ground, " + std::to_string(counts.pixels) + " px", "0",
               std::to_string(counts.leaks));
  hard::report(
      "H23",
      shape.name + ": picked heights off the picture's, " + std::to_string(counts.picked) + " px of ground",
      "0", std::to_string(counts.wrong));
  EXPECT_EQ(counts.leaks, 0u);
  EXPECT_EQ(counts.wrong, 0u);
  EXPECT_GT(counts.pixels, cameras * 1000);
  EXPECT_GT(counts.picked, cameras * 2);
}

INSTANTIATE_TEST_SUITE_P(Shapes, PlanetShapes,
                         testing::Values(Shape{"sphere of 1 m", {1.0, 0.0}, 5},
                                         Shape{"sphere of 1e9 m", {1e9, 0.0}, 5},
                                         Shape{"Mars", globe::geo::kMars, 1},
                                         Shape{"f = 0.2", {6378137.0, 0.2}, 5}),
                         [](const auto& which) { return "Number" + std::to_string(which.index); });

}  // namespace
