// From space the sky is drawn as a disc of air and a sun: both whole, and where they belong.

#include <glm/geometric.hpp>

#include "globe/render/air.h"
#include "tests/render/ground/views.h"

namespace {

using views::Camera;
using views::dvec3;

constexpr int kSkySide = 1600;

/// Column and row from the top-left corner at which a direction is seen.
glm::dvec2 pixel_toward(const Camera& camera, const dvec3& direction) {
  const double ahead = glm::dot(direction, camera.forward);
  const double x = glm::dot(direction, camera.right) / (ahead * camera.tan_x());
  const double y = glm::dot(direction, camera.up) / (ahead * camera.tan_y());
  return {0.5 * (1.0 + x) * kSkySide, 0.5 * (1.0 - y) * kSkySide};
}

/// The brightest of a pixel's three bytes.
int brightness(const std::vector<std::uint8_t>& rgba, int column, int row) {
  const auto at = 4 * (static_cast<std::size_t>(row) * kSkySide + static_cast<std::size_t>(column));
  return std::max({rgba[at], rgba[at + 1], rgba[at + 2]});
}

views::RenderSettings sky_settings() {
  views::RenderSettings settings;
  settings.clipmap = globe::clipmap::Settings::for_detail(32);
  return settings;
}

TEST_F(GlTest, SkyFromSpaceIsARingOfAirWithoutAGap) {
  const auto surface = views::builtin_planet();
  views::GlobeRenderer renderer(surface, sky_settings());
  const globe::gl::Framebuffer picture(kSkySide, kSkySide);
  const auto& ellipsoid = surface->ellipsoid();
  const double round = ellipsoid.mean_radius();
  const dvec3 rounding(round / ellipsoid.a, round / ellipsoid.a, round / ellipsoid.b());
  for (const double height : {1.0e6, 5.0e6, 2.0e7}) {
    const double radius = height + round;
    const double fov = 2.0 * 57.29577951308232 * std::asin((round + 3e5) / radius);
    const Camera camera = globe::render::make_camera(ellipsoid, {90.0, 0.0, height}, 0.0, -90.0, fov, 1.0);
    renderer.draw(camera, glm::normalize(dvec3(0.02, 0.01, 1.0)), true, picture);
    const auto rgba = picture.read_rgba8();
    const double eye = glm::length(camera.position * rounding);
    const double pixel_m = 2.0 * camera.tan_y() / kSkySide * std::sqrt(eye * eye - round * round);
    for (int k = 0; k < 720; ++k) {
      const double azimuth = k * 0.5 / 57.29577951308232;
      const auto seen = [&](double above_m) {  // along the ray whose lowest point lies so high
        const double sine = (round + above_m) / eye;
        const dvec3 ray(sine * std::cos(azimuth), sine * std::sin(azimuth), -std::sqrt(1.0 - sine * sine));
        const glm::dvec2 at = pixel_toward(camera, ray / rounding);
        return brightness(rgba, static_cast<int>(at.x), static_cast<int>(at.y));
      };
      const double top_m = 1e3 * globe::render::air_top_km();
      EXPECT_GT(seen(1.5 * pixel_m + 10e3), 8) << height << " m, azimuth " << 0.5 * k;
      EXPECT_EQ(seen(1.5 * pixel_m + top_m), 0) << height << " m, azimuth " << 0.5 * k;
    }
  }
}

TEST_F(GlTest, NightSideFromSpaceIsDark) {
  const auto surface = views::builtin_planet();
  views::GlobeRenderer renderer(surface, sky_settings());
  const globe::gl::Framebuffer picture(kSkySide, kSkySide);
  for (const double height : {2.0e6, 2.0e7}) {
    const Camera camera =
        globe::render::make_camera(surface->ellipsoid(), {0.0, 180.0, height}, 0.0, -90.0, 20.0, 1.0);
    const dvec3 sun(std::cos(0.6), 0.0, std::sin(0.6));  // 56 degrees below the horizon
    renderer.draw(camera, sun, true, picture);
    const auto rgba = picture.read_rgba8();
    int brightest = 0;
    for (int row = kSkySide / 4; row < 3 * kSkySide / 4; ++row) {
      for (int column = kSkySide / 4; column < 3 * kSkySide / 4; ++column)
        brightest = std::max(brightest, brightness(rgba, column, row));
    }
    EXPECT_LE(brightest, 1) << height;
  }
}

TEST_F(GlTest, SunFromSpaceIsADiscInItsPlace) {
  const auto surface = views::builtin_planet();
  views::GlobeRenderer renderer(surface, sky_settings());
  const globe::gl::Framebuffer picture(kSkySide, kSkySide);
  const Camera camera =
      globe::render::make_camera(surface->ellipsoid(), {20.0, 50.0, 4.0e6}, 70.0, 40.0, 10.0, 1.0);
  for (const glm::dvec2 place : {glm::dvec2(0.0), glm::dvec2(-0.7, 0.4), glm::dvec2(0.2, -0.9)}) {
    const dvec3 sun = views::ray(camera, place.x, place.y);
    renderer.draw(camera, sun, true, picture);
    const auto rgba = picture.read_rgba8();
    int count = 0;
    glm::dvec2 sum(0.0);
    for (int row = 0; row < kSkySide; ++row) {
      for (int column = 0; column < kSkySide; ++column) {
        if (brightness(rgba, column, row) < 128) continue;
        ++count;
        sum += glm::dvec2(column + 0.5, row + 0.5);
      }
    }
    const double radius =
        std::tan(0.266 / 57.29577951308232) / camera.tan_y() * 0.5 * kSkySide;  // 0.266 degrees
    EXPECT_NEAR(count, 3.14159265 * radius * radius, 0.05 * count);
    EXPECT_LT(glm::distance(sum / double(std::max(count, 1)), pixel_toward(camera, sun)), 0.5);
  }
}

}  // namespace
