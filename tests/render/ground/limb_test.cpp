// H25: the planet's limb stands where that of the ellipsoid does.

#include <OpenImageIO/imageio.h>

#include <array>

#include "converters/convert.h"
#include "globe/planet/dataset.h"
#include "tests/hard/table.h"
#include "tests/render/ground/views.h"
#include "tests/temporary_folder.h"

namespace {

using globe::geo::Ellipsoid;
using views::Camera;
using views::dvec3;

constexpr int kWidth = 32;
constexpr int kHeight = 720;
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
  return 0.5 * (1.0 - above) * kHeight;
}

/// The same of the picture: rows of background above the ground in the middle column.
double drawn_row(const std::vector<float>& depth) {
  int row = 0;
  while (row < kHeight && depth[static_cast<std::size_t>(row * kWidth + kWidth / 2)] == 0.0f) ++row;
  return row;
}

/// A planet that is sea all over: a map of one depth, converted.
std::shared_ptr<const views::Surface> water_planet(const tests::TemporaryFolder& folder) {
  const std::string map = folder / "depth.tif";
  const std::vector<float> depth(32 * 16, -4000.0f);
  const auto output = OIIO::ImageOutput::create(map);
  EXPECT_TRUE(output && output->open(map, OIIO::ImageSpec(32, 16, 1, OIIO::TypeDesc::FLOAT)) &&
              output->write_image(OIIO::TypeDesc::FLOAT, depth.data()) && output->close());
  converters::ConvertOptions options;
  options.heights = {converters::MapInput{map, {}, {}}};
  options.planet = folder / "planet";
  converters::convert(options, {});
  return views::Surface::from_dataset(std::make_shared<const globe::planet::Dataset>(
      globe::planet::Dataset::open(options.planet, std::size_t{1} << 24)));
}

TEST_F(GlTest, H25TheLimbStandsWhereTheEllipsoidsDoes) {
  const tests::TemporaryFolder folder;
  const auto surface = water_planet(folder);
  ASSERT_TRUE(surface->has_sea());
  views::GlobeRenderer renderer(surface, views::geometry_settings(128));
  const globe::gl::Framebuffer picture(kWidth, kHeight);
  const Ellipsoid& ellipsoid = surface->ellipsoid();
  const Ellipsoid sphere{ellipsoid.mean_radius(), 0.0};
  double worst = 0, worst_sphere = 0;
  for (int k = 0; k < 40; ++k) {
    const double lat = std::array{89.0, 1.0, -45.0, 62.0}[static_cast<std::size_t>(k / 10)];
    const double h = 100.0 * std::pow(4e5, (k % 10 * 4 + k / 10) / 39.0);
    const double dip = std::acos(ellipsoid.mean_radius() / (ellipsoid.mean_radius() + h)) * kDegrees;
    const Camera camera = globe::render::make_camera(ellipsoid, {lat, 33.0, h}, 72.0 * k, -dip, 20.0,
                                                     static_cast<double>(kWidth) / kHeight);
    renderer.draw(camera, dvec3(1, 0, 0), true, picture);
    // the limb is between the middles of the last row without ground and the first one with it
    const double seen = drawn_row(picture.read_depth());
    worst = std::max(worst, std::abs(seen - analytic_row(ellipsoid, camera)) - 0.5);
    worst_sphere = std::max(worst_sphere, std::abs(seen - analytic_row(sphere, camera)) - 0.5);
  }
  hard::report("H25",
               "limb of a planet of water against the ellipsoid's, 40 altitudes, 20 degrees in 720 rows",
               "0.5 px", hard::figure(std::max(worst, 0.0)) + " px");
  hard::report("H25", "negative control: against the limb of a sphere", "> 0.5 px",
               hard::figure(worst_sphere) + " px");
  EXPECT_LE(worst, kLimbError);
  EXPECT_GT(worst_sphere, kLimbError);
}

}  // namespace
