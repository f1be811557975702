// The sky as it is drawn with the atmosphere's tables, against the light that an independent integration
// gives.

#include <epoxy/gl.h>

#include <fstream>
#include <glm/geometric.hpp>

#include "app/accuracy/scattering_cases.h"
#include "globe/base/error.h"
#include "globe/effects/list.h"
#include "globe/render/tone.h"
#include "tests/node_planet.h"
#include "tests/render/ground/views.h"
#include "tests/temporary_folder.h"

namespace {

namespace accuracy = app::accuracy;
using views::Camera;
using views::dvec3;

constexpr float kSunlight = 5.0f;  // in units of white, as render::view_block has it
constexpr float kWhite = 0.9f;     // shown: lighter, and the tone curve tells little apart

std::vector<globe::render::NamedEffect> atmosphere(const globe::planet::Surface& surface) {
  const tests::TemporaryFolder folder;
  std::ofstream(folder / "scene.toml") << "planet = \"procedural\"\n[effects.atmosphere]\n";
  const auto scene =
      globe::scene::read_scene((folder / "scene.toml").string(), globe::effects::effect_kinds());
  return globe::effects::make_effects(scene, surface);
}

/// A camera whose middle looks along a ray of round space from over the north pole.
Camera looking_along(const accuracy::ScatteringRay& ray, const globe::geo::Ellipsoid& ellipsoid) {
  const double round = ellipsoid.mean_radius(), height = ray.eye.z - globe::effects::AirModel{}.ground_km;
  const dvec3 rounding(round / ellipsoid.a, round / ellipsoid.a, round / ellipsoid.b());
  Camera camera;
  camera.position = dvec3(0.0, 0.0, round + 1e3 * height) / rounding;
  camera.forward = glm::normalize(ray.direction / rounding);
  camera.right = glm::normalize(glm::cross(camera.forward, dvec3(-ray.direction.y, ray.direction.x, 0.1)));
  camera.up = glm::cross(camera.right, camera.forward);
  camera.fov_y_deg = 0.002;
  camera.aspect = 1.0;
  return camera;
}

TEST_F(GlTest, SkyOfTheAtmosphereIsWithinFivePercentOfAnIndependentIntegration) {
  const auto surface = views::builtin_planet();
  views::RenderSettings settings;
  settings.clipmap = globe::clipmap::Settings::for_detail(16);
  views::GlobeRenderer renderer(surface, settings, atmosphere(*surface));
  const globe::gl::Framebuffer picture(2, 2, {1, GL_RGBA16F, GL_DEPTH_COMPONENT32F});
  const auto cases = accuracy::scattering_cases();
  const auto values = accuracy::scattering_values();
  int looks = 0;
  for (std::size_t k = 0; k < cases.size(); ++k) {
    // The lowest eyes might stand in a hill.
    if (glm::length(cases[k].ray.eye) < 6371.0 + 11.0 || cases[k].name.find("ground") != std::string::npos)
      continue;
    renderer.draw(looking_along(cases[k].ray, surface->ellipsoid()), cases[k].ray.sun, true, picture);
    if (picture.read_depth().front() != 0.0f) continue;  // a mountain at the limb
    const auto rgba = picture.read_rgba_float();
    const glm::vec3 expected = globe::render::tone_mapped(glm::vec3(values[k].sum()) * kSunlight);
    ++looks;
    for (int channel = 0; channel < 3; ++channel) {
      const float truth = static_cast<float>(values[k].sum()[channel]) * kSunlight;
      if (expected[channel] > kWhite) continue;
      // Darker than a step of eight bits can tell, the step counts.
      const float least = globe::render::tone_mapped(glm::vec3(0.95f * truth)).x - 0.002f;
      const float most = globe::render::tone_mapped(glm::vec3(1.05f * truth)).x + 0.002f;
      EXPECT_GE(rgba[static_cast<std::size_t>(channel)], least) << cases[k].name << ", channel " << channel;
      EXPECT_LE(rgba[static_cast<std::size_t>(channel)], most) << cases[k].name << ", channel " << channel;
    }
  }
  EXPECT_GE(looks, 18);
}

TEST_F(GlTest, SkyOfTheAtmosphereMeetsTheHorizonWithoutADarkOrWhiteLine) {
  const auto surface = views::builtin_planet();
  views::RenderSettings settings;
  settings.clipmap = globe::clipmap::Settings::for_detail(32);
  views::GlobeRenderer renderer(surface, settings, atmosphere(*surface));
  constexpr int kRows = 400;
  const globe::gl::Framebuffer picture(8, kRows);
  for (const double height : {10e3, 400e3}) {
    const double dip = std::acos(6371e3 / (6371e3 + height)) * 57.29577951308232;
    Camera camera =
        globe::render::make_camera(surface->ellipsoid(), {10.0, 20.0, height}, 80.0, -dip, 2.0, 0.02);
    renderer.draw(camera, glm::normalize(dvec3(1.0, 0.5, 0.4)), true, picture);
    const auto rgba = picture.read_rgba8();
    const auto depth = picture.read_depth();
    for (int row = 4; row + 4 < kRows; ++row) {
      const auto at = [&](int r) { return static_cast<std::size_t>(r * 8 + 4); };
      const auto green = [&](int r) { return int(rgba[4 * at(r) + 1]); };
      if (depth[at(row)] != 0.0f) break;  // the ground begins
      // No row of sky stands out from both of its neighbours.
      const int above = green(row) - green(row - 1), below = green(row) - green(row + 1);
      if (depth[at(row + 1)] != 0.0f) break;
      EXPECT_FALSE(above * below > 0 && std::min(std::abs(above), std::abs(below)) > 3)
          << height << " m, row " << row;
    }
  }
}

TEST_F(GlTest, PlanetWithoutAirRefusesTheAtmosphereInOneLine) {
  const tests::TemporaryFolder folder;
  tests::write_node_planet(
      folder / "planet", 2, globe::geo::kMars, [](const globe::planet::Node&) { return 0.0; }, "moon");
  const auto surface = tests::open_surface(folder / "planet");
  try {
    atmosphere(*surface);
    FAIL();
  } catch (const globe::Error& error) {
    EXPECT_NE(std::string(error.what()).find("scene.toml:2: effects.atmosphere: the planet has no air; "),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
