// Fisheye pictures and panoramas: every direction on its pixel, and no seam where the faces of the cube meet.

#include "globe/render/wide_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/hard/table.h"
#include "tests/node_planet.h"
#include "tests/render/ground/views.h"
#include "tests/temporary_folder.h"

namespace {

using globe::geo::Ellipsoid;
using globe::gl::Framebuffer;
using globe::render::Projection;
using globe::render::WideFormat;
using globe::render::WideView;
using views::Camera;
using views::dvec3;

constexpr double kPi = std::numbers::pi;
constexpr double kWidePixels = 0.5;

/// A sphere of water.
std::shared_ptr<const views::Surface> sphere_of_water(const tests::TemporaryFolder& folder, double radius) {
  tests::write_node_planet(
      folder / "planet", 2, Ellipsoid{radius, 0.0},
      [&](const globe::planet::Node&) { return -1e-3 * radius; }, "earth");
  return tests::open_surface(folder / "planet");
}

TEST_F(GlTest, TheLimbOfASphereIsACircleOfItsAngularRadiusInAFisheye) {
  constexpr double kRadius = 6371000.0;
  constexpr int kSide = 512;
  const tests::TemporaryFolder folder;
  const auto surface = sphere_of_water(folder, kRadius);
  views::GlobeRenderer renderer(surface, views::geometry_settings(128));
  const Framebuffer picture(kSide, kSide);
  WideView fisheye({Projection::kFisheye, kSide, kSide, 180.0, 1, 0});
  double worst = 0, worst_linear = 0;
  // From where the limb lies within one face, on the edges between faces, and near the rim.
  for (const double height : {2e7, 4.5e6, 2.65e6, 4e5, 2e3}) {
    for (const double pitch : {-90.0, -80.0}) {
      const Camera camera =
          globe::render::make_camera(surface->ellipsoid(), {35.0, 33.0, height}, 20.0, pitch, 180.0, 1.0);
      fisheye.draw(renderer, camera, dvec3(1, 0, 0), true, picture);
      const std::vector<float> depth = picture.read_depth();
      const double limb = std::asin(kRadius / (kRadius + height));
      const dvec3 down = -glm::normalize(camera.position);
      // Every pixel on the wrong side of the limb, by how far it is from it.
      for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
          const auto ray = globe::render::direction_through(Projection::kFisheye, camera, (x + 0.5) / kSide,
                                                            (y + 0.5) / kSide);
          const bool ground = depth[static_cast<std::size_t>(y * kSide + x)] != 0.0f;
          if (!ray) {
            EXPECT_FALSE(ground);
            continue;
          }
          const double off = (std::acos(std::clamp(glm::dot(*ray, down), -1.0, 1.0)) - limb) / (kPi / kSide);
          if ((off < 0.0) != ground) worst = std::max(worst, std::abs(off));
          // Negative control: an orthographic disc.
          const double radius = std::hypot(x + 0.5 - kSide / 2, y + 0.5 - kSide / 2) / (kSide / 2);
          if (pitch == -90.0 && (radius < std::sin(limb)) != ground)
            worst_linear = std::max(worst_linear, std::abs(radius - std::sin(limb)) * kSide / 2);
        }
      }
    }
  }
  hard::report("projection", "limb of a sphere in a fisheye of 512 pixels, 2 km to 20,000 km", "0.5 px",
               hard::figure(worst) + " px");
  EXPECT_LE(worst, kWidePixels);
  EXPECT_GT(worst_linear, kWidePixels);
}

TEST_F(GlTest, DepthInAPanoramaIsTheDistanceToASphereAlongEachRay) {
  constexpr double kRadius = 6371000.0;
  constexpr int kWidth = 512, kHeight = 256;
  const tests::TemporaryFolder folder;
  const auto surface = sphere_of_water(folder, kRadius);
  views::GlobeRenderer renderer(surface, views::geometry_settings(128));
  const Framebuffer picture(kWidth, kHeight);
  WideView panorama({Projection::kEquirectangular, kWidth, kHeight, 180.0, 1, 0});
  const double height = 3e5;
  const Camera camera =
      globe::render::make_camera(surface->ellipsoid(), {-20.0, 100.0, height}, 70.0, 0.0, 180.0, 2.0);
  panorama.draw(renderer, camera, dvec3(1, 0, 0), true, picture);
  const std::vector<float> depth = picture.read_depth();
  const double near_m = globe::render::near_distance(surface->ellipsoid(), height);
  std::size_t wrong = 0, seen = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const float value = depth[static_cast<std::size_t>(y * kWidth + x)];
      if (value == 0.0f) continue;
      ++seen;
      const double shown = near_m / static_cast<double>(value);
      // Somewhere within half a pixel the ray is as long as shown, but for the sag of flat triangles.
      double least = 1e300, most = 0.0;
      for (const double dy : {-kWidePixels, 0.0, kWidePixels}) {
        for (const double dx : {-kWidePixels, 0.0, kWidePixels}) {
          const auto ray = globe::render::direction_through(
              Projection::kEquirectangular, camera, (x + 0.5 + dx) / kWidth, (y + 0.5 + dy) / kHeight);
          if (!ray) continue;
          const double length = globe::geo::ray_ellipsoid(surface->ellipsoid(), 0.0, camera.position, *ray);
          least = std::min(least, length < 0.0 ? 1e300 : length);
          most = std::max(most, length < 0.0 ? 1e300 : length);
        }
      }
      wrong += shown < least * (1 - 1e-3) || shown > most * (1 + 1e-3) ? 1 : 0;
    }
  }
  EXPECT_GT(seen, 10'000u);
  EXPECT_EQ(wrong, 0u);
}

struct Difference {
  double mean = 0, most = 0;
};

/// Between a wide picture and a pinhole camera's of the same place, looked up where each pixel's direction
/// falls, so many pixels aside.
Difference difference(const std::vector<std::uint8_t>& wide, const WideFormat& format, const Camera& camera,
                      const std::vector<std::uint8_t>& pinhole, const Camera& other, int side, double aside) {
  Difference found;
  std::size_t count = 0;
  for (int y = 0; y < format.height; ++y) {
    for (int x = 0; x < format.width; ++x) {
      const auto ray = globe::render::direction_through(
          format.projection, camera, (x + 0.5 + aside) / format.width, (y + 0.5) / format.height);
      const auto at = ray ? globe::render::seen_at(Projection::kPerspective, other, *ray) : std::nullopt;
      if (!at) continue;
      const double column = at->x * side - 0.5, row = at->y * side - 0.5;
      const int c = static_cast<int>(std::floor(column)), r = static_cast<int>(std::floor(row));
      if (c < 0 || r < 0 || c + 1 >= side || r + 1 >= side) continue;
      for (std::size_t channel = 0; channel < 3; ++channel) {
        const auto texel = [&](int i, int j) {
          return static_cast<double>(pinhole[4 * static_cast<std::size_t>(j * side + i) + channel]);
        };
        const double u = column - c, v = row - r;
        const double expected = (texel(c, r) * (1 - u) + texel(c + 1, r) * u) * (1 - v) +
                                (texel(c, r + 1) * (1 - u) + texel(c + 1, r + 1) * u) * v;
        const double off =
            std::abs(expected - wide[4 * static_cast<std::size_t>(y * format.width + x) + channel]);
        found.mean += off;
        found.most = std::max(found.most, off);
        ++count;
      }
    }
  }
  found.mean /= static_cast<double>(std::max<std::size_t>(count, 1));
  return found;
}

TEST_F(GlTest, WidePicturesShowWhatPinholeCamerasShow) {
  const auto surface = views::builtin_planet();
  views::RenderSettings settings;
  settings.clipmap = globe::clipmap::Settings::for_detail(32);
  views::GlobeRenderer renderer(surface, settings);
  constexpr int kSide = 384;
  const Framebuffer pinhole(kSide, kSide);
  for (const double above : {5e6, 2e3, 2.0}) {
    for (const WideFormat& format : {WideFormat{Projection::kFisheye, 256, 256, 180.0, 1, 0},
                                     WideFormat{Projection::kEquirectangular, 512, 256, 180.0, 1, 0}}) {
      const Camera camera = views::camera_above(renderer, *surface, {"range", -43.42, -106.43}, above, 110.0,
                                                above > 1e5 ? -90.0 : 0.0, format.fov_deg);
      Camera wide_camera = camera;
      wide_camera.aspect = static_cast<double>(format.width) / format.height;
      const Framebuffer picture(format.width, format.height);
      WideView wide(format);
      const dvec3 sun = glm::normalize(glm::normalize(camera.position) + camera.right);
      wide.draw(renderer, wide_camera, sun, true, picture);
      const auto rgba = picture.read_rgba8();
      // Turned by half a right angle, so that the borders between faces run through its middle.
      Camera other = camera;
      other.forward = glm::normalize(camera.forward + camera.right);
      other.right = glm::normalize(camera.right - camera.forward);
      other.fov_y_deg = 80.0;
      other.aspect = 1.0;
      renderer.draw(other, sun, true, pinhole);
      const auto flat = pinhole.read_rgba8();
      const Difference same = difference(rgba, format, wide_camera, flat, other, kSide, 0.0);
      const Difference off = difference(rgba, format, wide_camera, flat, other, kSide, 1.0);
      EXPECT_LT(same.mean, 3.0) << above;
      EXPECT_LT(same.mean, 0.75 * off.mean) << above;
    }
  }
}

TEST_F(GlTest, NoSeamShowsWhereFacesMeet) {
  const auto surface = views::builtin_planet();
  views::RenderSettings settings;
  settings.clipmap = globe::clipmap::Settings::for_detail(32);
  views::GlobeRenderer renderer(surface, settings);
  constexpr int kWidth = 512, kHeight = 256, kTurn = kWidth / 8;
  const Framebuffer picture(kWidth, kHeight);
  WideView panorama({Projection::kEquirectangular, kWidth, kHeight, 180.0, 1, 0});
  for (const double above : {5e6, 2e3, 2.0}) {
    // The same panorama with the cube turned by half a right angle: what was a border is a face's middle.
    std::vector<std::vector<std::uint8_t>> turned;
    Camera camera = views::camera_above(renderer, *surface, {"range", -43.42, -106.43}, above, 110.0, 0.0);
    const dvec3 sun = glm::normalize(glm::normalize(camera.position) + camera.right);
    for (const bool turn : {false, true}) {
      if (turn) {
        const dvec3 forward = camera.forward;
        camera.forward = glm::normalize(forward + camera.right);
        camera.right = glm::normalize(camera.right - forward);
      }
      panorama.draw(renderer, camera, sun, true, picture);
      turned.push_back(picture.read_rgba8());
    }
    double at_borders = 0, elsewhere = 0;
    std::size_t border_count = 0, other_count = 0;
    for (int y = kHeight / 3; y < 2 * kHeight / 3; ++y) {  // what upright faces show
      for (int x = 0; x < kWidth; ++x) {
        const int from_border = (x + kTurn) % (2 * kTurn);  // columns right of one of the first picture's
        const bool border = from_border < 2 || from_border >= 2 * kTurn - 2;
        for (std::size_t channel = 0; channel < 3; ++channel) {
          const auto at = [&](const std::vector<std::uint8_t>& rgba, int column) {
            return static_cast<double>(
                rgba[4 * static_cast<std::size_t>(y * kWidth + (column + kWidth) % kWidth) + channel]);
          };
          const double off = std::abs(at(turned[0], x) - at(turned[1], x - kTurn));
          (border ? at_borders : elsewhere) += off;
          ++(border ? border_count : other_count);
        }
      }
    }
    at_borders /= static_cast<double>(border_count);
    elsewhere /= static_cast<double>(other_count);
    EXPECT_LT(at_borders, 1.5 * elsewhere + 0.5) << above;
    EXPECT_LT(elsewhere, 3.0) << above;
  }
}

TEST_F(GlTest, OnlyTheFacesThatAreSeenAreDrawn) {
  EXPECT_EQ(WideView({Projection::kFisheye, 256, 256, 60.0, 1, 0}).faces(), 1u);
  EXPECT_EQ(WideView({Projection::kFisheye, 256, 256, 180.0, 1, 0}).faces(), 5u);
  EXPECT_EQ(WideView({Projection::kFisheye, 256, 256, 300.0, 1, 0}).faces(), 6u);
  EXPECT_EQ(WideView({Projection::kEquirectangular, 512, 256, 180.0, 1, 0}).faces(), 6u);
  EXPECT_EQ(WideView({Projection::kEquirectangular, 512, 256, 60.0, 1, 0}).faces(), 3u);
}

TEST_F(GlTest, FinerFacesAreAKnob) {
  EXPECT_GT(WideView({Projection::kFisheye, 256, 256, 180.0, 1, 1000}).face_side(),
            WideView({Projection::kFisheye, 256, 256, 180.0, 1, 0}).face_side());
}

}  // namespace
