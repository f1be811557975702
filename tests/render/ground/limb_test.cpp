// H25: the planet's limb stands where that of the ellipsoid does.

#include <epoxy/gl.h>

#include <array>

#include "globe/geo/sun.h"
#include "tests/hard/table.h"
#include "tests/node_planet.h"
#include "tests/render/ground/views.h"
#include "tests/temporary_folder.h"

namespace {

using globe::geo::Ellipsoid;
using views::Camera;
using views::dvec3;

constexpr int kLimbWidth = 32;
constexpr int kLimbHeight = 720;
constexpr double kLimbError = 0.5;              ///< pixels
constexpr double kDegrees = 57.29577951308232;  ///< in a radian

/// Row, from the top, at which the middle column first meets the ellipsoid; pixel rows are spanned by y.
double analytic_row(const Ellipsoid& ellipsoid, const Camera& camera) {
  double above = 1.0, below = -1.0;  // y in the picture: misses, meets
  for (int step = 0; step < 60; ++step) {
    const double y = 0.5 * (above + below);
    const bool meets =
        globe::geo::ray_ellipsoid(ellipsoid, 0.0, camera.position, views::ray(camera, 0.0, y)) >= 0;
    (meets ? below : above) = y;
  }
  return 0.5 * (1.0 - above) * kLimbHeight;
}

/// The same of the picture: rows of background above the ground in the middle column.
double drawn_row(const std::vector<float>& depth) {
  int row = 0;
  while (row < kLimbHeight && depth[static_cast<std::size_t>(row * kLimbWidth + kLimbWidth / 2)] == 0.0f)
    ++row;
  return row;
}

/// How far the limb of a planet of water stands from the ellipsoid's, and from a sphere's, pixels.
struct Limb {
  double worst = 0, worst_sphere = 0;
};

/// @param altitudes  of which four in a row are looked at from four latitudes, from 1.6e-5 radii to 6.3
Limb measure_limb(const Ellipsoid& ellipsoid, int altitudes) {
  const tests::TemporaryFolder folder;
  const double radius = ellipsoid.mean_radius();
  tests::write_node_planet(
      folder / "planet", 2, ellipsoid, [&](const globe::planet::Node&) { return -1e-3 * radius; }, "earth");
  const auto surface = tests::open_surface(folder / "planet");
  EXPECT_TRUE(surface->has_sea());
  views::GlobeRenderer renderer(surface, views::geometry_settings(128));
  const globe::gl::Framebuffer picture(kLimbWidth, kLimbHeight);
  const Ellipsoid sphere{radius, 0.0};
  Limb limb;
  for (int k = 0; k < altitudes; ++k) {
    const int place = k * 4 / altitudes;
    const double lat = std::array{89.0, 1.0, -45.0, 62.0}[static_cast<std::size_t>(place)];
    const double h = radius * 1.57e-5 * std::pow(4e5, (k % (altitudes / 4) * 4 + place) / (altitudes - 1.0));
    const double dip = std::acos(radius / (radius + h)) * kDegrees;
    const Camera camera = globe::render::make_camera(ellipsoid, {lat, 33.0, h}, 72.0 * k, -dip, 20.0,
                                                     static_cast<double>(kLimbWidth) / kLimbHeight);
    renderer.draw(camera, dvec3(1, 0, 0), true, picture);
    // the limb is between the middles of the last row without ground and the first one with it
    const double seen = drawn_row(picture.read_depth());
    limb.worst = std::max(limb.worst, std::abs(seen - analytic_row(ellipsoid, camera)) - 0.5);
    limb.worst_sphere = std::max(limb.worst_sphere, std::abs(seen - analytic_row(sphere, camera)) - 0.5);
  }
  return limb;
}

TEST_F(GlTest, H25TheLimbStandsWhereTheEllipsoidsDoes) {
  const Limb limb = measure_limb(globe::geo::kWgs84, 40);
  hard::report("H25",
               "limb of a planet of water against the ellipsoid's, 40 altitudes, 20 degrees in 720 rows",
               "0.5 px", hard::figure(std::max(limb.worst, 0.0)) + " px");
  hard::report("H25", "negative control: against the limb of a sphere", "> 0.5 px",
               hard::figure(limb.worst_sphere) + " px");
  EXPECT_LE(limb.worst, kLimbError);
  EXPECT_GT(limb.worst_sphere, kLimbError);
}

TEST_F(GlTest, H25TheLimbOfPlanetsOfOtherShapesStandsWhereTheirEllipsoidsDoes) {
  struct Shape {
    const char* name;
    Ellipsoid ellipsoid;
  };
  std::vector<Shape> shapes{{"a sphere of 1 m", {1.0, 0.0}}, {"an ellipsoid with f = 0.2", {6378137.0, 0.2}}};
  if (hard::full()) {
    shapes.push_back({"a sphere of 1e9 m", {1e9, 0.0}});
    shapes.push_back({"Mars", globe::geo::kMars});
  }
  for (const Shape& shape : shapes) {
    const Limb limb = measure_limb(shape.ellipsoid, hard::full() ? 40 : 8);
    hard::report("H25", "the same of " + std::string(shape.name), "0.5 px",
                 hard::figure(std::max(limb.worst, 0.0)) + " px");
    EXPECT_LE(limb.worst, kLimbError) << shape.name;
  }
}

// Where a pixel's middle lies outside the triangle that one of its samples is in, what is interpolated there
// is not to be carried on beyond the triangle's edge: specks would stand on the limb.
TEST_F(GlTest, FourSamplesAPixelLeaveNoSpecksOnTheLimb) {
  const auto surface = views::builtin_planet();
  views::RenderSettings settings;
  settings.clipmap = globe::clipmap::Settings::for_detail(64);
  views::GlobeRenderer renderer(surface, settings);
  constexpr int kAcross = 640, kDown = 360, kFiner = 2;
  const globe::gl::Framebuffer four(kAcross, kDown, {4, GL_RGBA8, GL_DEPTH_COMPONENT32F});
  const globe::gl::Framebuffer fine(kFiner * kAcross, kFiner * kDown);
  const Camera camera =
      globe::render::make_camera(surface->ellipsoid(), {20.0, -100.0, 350e3}, 300.0, -22.0, 60.0, 16.0 / 9.0);
  const dvec3 sun = globe::geo::morning_sun(-100.0);
  renderer.draw(camera, sun, true, four);
  const auto seen = four.read_rgba8();
  renderer.draw(camera, sun, true, fine);
  const auto truth = fine.read_rgba8();
  // Each channel among all the values that the pixel and its neighbours have in the finer picture.
  int worst = 0;
  for (int y = 0; y < kDown; ++y) {
    for (int x = 0; x < kAcross; ++x) {
      for (int c = 0; c < 3; ++c) {
        int least = 255, most = 0;
        for (int v = std::max(kFiner * (y - 1), 0); v < std::min(kFiner * (y + 2), kFiner * kDown); ++v) {
          for (int u = std::max(kFiner * (x - 1), 0); u < std::min(kFiner * (x + 2), kFiner * kAcross); ++u) {
            const int value = truth[static_cast<std::size_t>(4 * (v * kFiner * kAcross + u) + c)];
            least = std::min(least, value);
            most = std::max(most, value);
          }
        }
        const int value = seen[static_cast<std::size_t>(4 * (y * kAcross + x) + c)];
        worst = std::max({worst, least - value, value - most});
      }
    }
  }
  EXPECT_LE(worst, 35) << "of 255, beyond the colours around";
}

}  // namespace
