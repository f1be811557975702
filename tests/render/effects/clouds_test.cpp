#include <glm/geometric.hpp>
#include <numbers>

#include "globe/render/projection.h"
#include "tests/render/effects/effect_scene.h"
#include "tests/render/gl_fixture.h"

namespace {

using globe::geo::ecef_from_geodetic;
using globe::geo::Geodetic;
using globe::geo::kWgs84;
using globe::render::Camera;
using globe::render::GlobeRenderer;

constexpr int kSize = 384;
constexpr int kCloudMapWidth = 720;  // half degrees
/// Of the one cloud: the corner of sixteen white pixels, tenths of degrees.
constexpr double kCloudLat = 5.0, kCloudLon = 20.0;

class Clouds : public GlTest {
 protected:
  std::string table(const std::string& keys) const {
    std::vector<std::pair<int, int>> white;
    for (int k = 0; k < 16; ++k)
      white.emplace_back(static_cast<int>((kCloudLon + 180.0) * 10.0) - 2 + k % 4,
                         static_cast<int>((90.0 - kCloudLat) * 10.0) - 2 + k / 4);
    const auto file = effect_scene::write_map(folder_.path() / "cloud.png", 3600, white);
    return "[effects.clouds]\nimage = \"" + file.string() + "\"\n" + keys;
  }

  tests::TemporaryFolder folder_;
};

Camera above(double lat_deg, double lon_deg, double height_m) {
  return globe::render::make_camera(kWgs84, {lat_deg, lon_deg, height_m}, 0.0, -90.0, 60.0, 1.0);
}

glm::dvec2 pixel_of(const Camera& camera, const glm::dvec3& place) {
  return *globe::render::seen_at(globe::render::Projection::kPerspective, camera, place - camera.position) *
         static_cast<double>(kSize);
}

TEST_F(Clouds, MoveEastwardAtTheirSpeed) {
  constexpr double kSpeed = 40.0, kTime = 6 * 3600.0, kAltitude = 10e3;
  GlobeRenderer with = effect_scene::renderer(table("speed = 40\naltitude = 10000\nshadows = false\n"));
  GlobeRenderer without = effect_scene::renderer(table("coverage = 0.0\n"));
  const Camera camera = above(0.0, 24.0, 3000e3);
  const glm::dvec3 sun = globe::geo::normal_from_degrees(0.0, 24.0);
  const auto clear = effect_scene::picture(without, camera, sun, kSize, kSize);
  for (const double time_s : {0.0, kTime}) {
    const auto cloudy = effect_scene::picture(with, camera, sun, kSize, kSize, time_s);
    const double moved_deg = kSpeed * time_s / kWgs84.a * 180.0 / std::numbers::pi;
    const glm::dvec2 expected =
        pixel_of(camera, ecef_from_geodetic(kWgs84, {kCloudLat, kCloudLon + moved_deg, kAltitude}));
    const glm::dvec2 seen = effect_scene::middle_of_difference(cloudy, clear, kSize, kSize);
    EXPECT_NEAR(seen.x, expected.x, 1.0) << time_s;
    EXPECT_NEAR(seen.y, expected.y, 1.0) << time_s;
  }
}

TEST_F(Clouds, AreTheSameAtAnyFrameRate) {
  GlobeRenderer slow = effect_scene::renderer("[effects.clouds]\nspeed = 300\n");
  GlobeRenderer quick = effect_scene::renderer("[effects.clouds]\nspeed = 300\n");
  const Camera camera = above(-30.0, -106.0, 300e3);
  const glm::dvec3 sun = globe::geo::normal_from_degrees(-10.0, -120.0);
  const auto ten = effect_scene::picture(slow, camera, sun, 160, 160, 1.0, 10);
  const auto sixty = effect_scene::picture(quick, camera, sun, 160, 160, 1.0, 60);
  EXPECT_EQ(ten.rgba, sixty.rgba);
  EXPECT_NE(ten.rgba, effect_scene::picture(quick, camera, sun, 160, 160, 300.0).rgba);
}

TEST_F(Clouds, CastTheirShadowsAwayFromTheSun) {
  constexpr double kAltitude = 80e3;
  GlobeRenderer lit = effect_scene::renderer(table("speed = 0\naltitude = 80000\nshadows = false\n"));
  GlobeRenderer shaded = effect_scene::renderer(table("speed = 0\naltitude = 80000\n"));
  const Camera camera = above(kCloudLat, kCloudLon, 1500e3);
  const glm::dvec3 sun = globe::geo::normal_from_degrees(20.0, kCloudLon + 50.0);
  const auto bright = effect_scene::picture(lit, camera, sun, kSize, kSize);
  const auto dark = effect_scene::picture(shaded, camera, sun, kSize, kSize);
  // Where the ray through the cloud meets the ground, by halving.
  const glm::dvec3 cloud = ecef_from_geodetic(kWgs84, {kCloudLat, kCloudLon, kAltitude});
  double low = 0.0, high = 3.0 * kAltitude;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (globe::geo::geodetic_from_ecef(kWgs84, cloud - sun * middle).h_m > 0.0 ? low : high) = middle;
  }
  const glm::dvec2 expected = pixel_of(camera, cloud - sun * low);
  const glm::dvec2 seen = effect_scene::middle_of_difference(bright, dark, kSize, kSize);
  EXPECT_NEAR(seen.x, expected.x, 2.0);
  EXPECT_NEAR(seen.y, expected.y, 2.0);
  EXPECT_GT(glm::distance(expected, pixel_of(camera, cloud)), 15.0);
}

TEST_F(Clouds, AreNotAtWorkOutOfView) {
  GlobeRenderer renderer = effect_scene::renderer("[effects.clouds]\nshadows = false\n");
  Camera camera = above(0.0, 0.0, 2000e3);
  std::swap(camera.forward, camera.up);
  camera.forward = glm::normalize(camera.position);
  const glm::dvec3 sun(1.0, 0.0, 0.0);
  effect_scene::picture(renderer, camera, sun, 64, 64);
  EXPECT_FALSE(renderer.effect_states().front().verdict.active);
  EXPECT_EQ(renderer.effect_states().front().verdict.why, "out of view");
  EXPECT_LT(renderer.effect_states().front().gpu_bytes, 200000u) << "textures are made when first needed";
  effect_scene::picture(renderer, above(0.0, 0.0, 2000e3), sun, 64, 64);
  EXPECT_TRUE(renderer.effect_states().front().verdict.active);
  EXPECT_GT(renderer.effect_states().front().gpu_bytes, 1000000u);
}

class NightLights : public GlTest {
 protected:
  tests::TemporaryFolder folder_;
};

class Lightmap : public NightLights {};

TEST_F(NightLights, ShineWhereTheMapHasThemAtNightAlone) {
  const auto file = effect_scene::write_map(folder_.path() / "lamps.png", kCloudMapWidth, {{410, 160}});
  const Geodetic town{90.0 - 160.5 / 2.0, 410.5 / 2.0 - 180.0, 0.0};
  const std::string table = "[effects.night_lights]\nimage = \"" + file.string() + "\"\n";
  GlobeRenderer with = effect_scene::renderer(table);
  GlobeRenderer without = effect_scene::renderer(table + "intensity = 0\n");
  const Camera camera = above(town.lat_deg + 2.0, town.lon_deg - 3.0, 2000e3);
  const glm::dvec3 noon = globe::geo::normal_from_degrees(0.0, town.lon_deg);
  const auto dark = effect_scene::picture(without, camera, -noon, kSize, kSize);
  const auto lamps = effect_scene::picture(with, camera, -noon, kSize, kSize);
  const glm::dvec2 expected = pixel_of(camera, ecef_from_geodetic(kWgs84, town));
  const glm::dvec2 seen = effect_scene::middle_of_difference(lamps, dark, kSize, kSize);
  EXPECT_NEAR(seen.x, expected.x, 1.0);
  EXPECT_NEAR(seen.y, expected.y, 1.0);
  EXPECT_GT(lamps.green(static_cast<int>(expected.x), static_cast<int>(expected.y), kSize),
            dark.green(static_cast<int>(expected.x), static_cast<int>(expected.y), kSize) + 100.0);
  EXPECT_EQ(effect_scene::picture(with, camera, noon, kSize, kSize).rgba,
            effect_scene::picture(without, camera, noon, kSize, kSize).rgba);
  EXPECT_FALSE(with.effect_states().front().verdict.active);
}

TEST_F(Lightmap, TakesTheLightOfBlackGroundAlone) {
  // White but for a square about a place.
  const auto write = [&](const std::string& name, std::uint8_t square) {
    std::vector<std::uint8_t> pixels(360 * 180, 255);
    for (int row = 75; row < 105; ++row) {
      for (int column = 165; column < 195; ++column)
        pixels[static_cast<std::size_t>(row * 360 + column)] = square;
    }
    return effect_scene::write_pixels(folder_.path() / name, 360, pixels).string();
  };
  const std::string table = "[effects.lightmap]\nimage = \"";
  GlobeRenderer black = effect_scene::renderer(table + write("black.png", 0) + "\"\n");
  GlobeRenderer white = effect_scene::renderer(table + write("white.png", 255) + "\"\n");
  GlobeRenderer without = effect_scene::renderer(table + write("none.png", 0) + "\"\nstrength = 0\n");
  const glm::dvec3 sun(1.0, 0.0, 0.0);
  const Camera inside = above(0.0, 0.0, 100e3), outside = above(0.0, 60.0, 100e3);
  const auto plain = effect_scene::picture(without, inside, sun, 64, 64);
  const auto dark = effect_scene::picture(black, inside, sun, 64, 64);
  EXPECT_LT(dark.green(32, 32, 64), 0.8 * plain.green(32, 32, 64)) << "what is left is the air's";
  EXPECT_EQ(effect_scene::picture(white, inside, sun, 64, 64).rgba, plain.rgba);
  EXPECT_EQ(effect_scene::picture(black, outside, sun, 64, 64).rgba,
            effect_scene::picture(without, outside, sun, 64, 64).rgba);
}

}  // namespace
