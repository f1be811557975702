#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "flat/fractal/drawer.h"
#include "flat/fractal/low_flight.h"
#include "tests/render/gl_fixture.h"

namespace globe::flat::fractal {
namespace {

class FractalDrawer : public GlTest {
 protected:
  static TerrainSettings settings() {
    TerrainSettings result;
    result.ground.iterations = 9;
    result.ground.relief_m = 500;  // so low that no ray that looks down leaves the square
    result.pager = {.log2_cells = 3, .log2_blocks = 5};
    result.rings = {3, 6};
    return result;
  }
  static double side_m(const TerrainSettings& settings) {
    return settings.ground.spacing_m() *
           std::ldexp(1.0, settings.pager.log2_cells + settings.pager.log2_blocks);
  }
};

std::size_t magenta_pixels(const std::vector<std::uint8_t>& rgba) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < rgba.size(); k += 4)
    count += rgba[k] > 200 && rgba[k + 1] < 60 && rgba[k + 2] > 200;
  return count;
}

TEST_F(FractalDrawer, NothingShinesThroughBetweenBlocksOfAnyLevels) {
  const TerrainSettings with_levels = settings();
  Terrain terrain(with_levels);
  // Magenta behind the ground, and nothing else; back faces are culled.
  Drawer drawer(terrain, {.sky = {1.0f, 0.0f, 1.0f}});
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const int samples : {1, 4}) {
    const gl::Framebuffer target(160, 120, {.samples = samples});
    for (int trial = 0; trial < 16; ++trial) {
      // Over the ground, looking down so that all of the picture is ground: low over the finest level, and
      // high enough to see the rims of both rings.
      const glm::dvec2 at = glm::dvec2(unit(random), unit(random)) * 1e4;
      terrain.move_to(at);
      const double above = side_m(with_levels) * (trial % 2 == 0 ? 0.02 : 0.3);
      const glm::dvec3 eye(at, terrain.height_m(at) + above);
      const double pitch = trial % 2 == 0 ? -55.0 : -90.0;
      const Drawer::Stats stats =
          drawer.draw(flat_camera(180.0 * unit(random), pitch, 50.0, 4.0 / 3.0), eye, 0.01 * above, target);
      ASSERT_GT(stats.triangles, 100u);
      ASSERT_EQ(magenta_pixels(target.read_rgba8()), 0u) << samples << " samples, trial " << trial;
    }
  }
}

TEST_F(FractalDrawer, AHoleWouldShow) {
  const TerrainSettings with_levels = settings();
  Terrain terrain(with_levels);
  Drawer drawer(terrain, {.sky = {1.0f, 0.0f, 1.0f}});
  const gl::Framebuffer target(200, 150);
  // So high that the square's own rim is in the picture.
  drawer.draw(flat_camera(0, -90, 50, 4.0 / 3.0), {0, 0, 2 * side_m(with_levels)}, 1.0, target);
  EXPECT_GT(magenta_pixels(target.read_rgba8()), 1000u);
}

TEST_F(FractalDrawer, CullingChangesNoPixel) {
  TerrainSettings culled = settings(), all = settings();
  all.culling = false;
  Terrain few(culled), many(all);
  Drawer with(few), without(many);
  const gl::Framebuffer target(320, 240);
  for (const double heading : {0.0, 77.0, 200.0}) {
    for (const double pitch : {-20.0, -70.0, 15.0}) {
      const render::Camera camera = flat_camera(heading, pitch, 60.0, 4.0 / 3.0);
      few.move_to({8e7, -8e7});
      const glm::dvec3 eye(8e7, -8e7, few.height_m({8e7, -8e7}) + 200);
      const Drawer::Stats a = with.draw(camera, eye, 1.0, target);
      const std::vector<std::uint8_t> picture = target.read_rgba8();
      const Drawer::Stats b = without.draw(camera, eye, 1.0, target);
      EXPECT_TRUE(picture == target.read_rgba8());
      EXPECT_LT(a.triangles, b.triangles);
    }
  }
}

TEST_F(FractalDrawer, TheSamePlaceLooksTheSameWhicheverWayOneCame) {
  Terrain straight(settings()), roundabout(settings());
  Drawer a(straight), b(roundabout);
  const gl::Framebuffer target(320, 240);
  const render::Camera camera = flat_camera(30, -20, 60, 4.0 / 3.0);
  const glm::dvec3 place(1000, 2000, 3000);
  a.draw(camera, place, 1.0, target);
  const std::vector<std::uint8_t> picture = target.read_rgba8();
  for (const glm::dvec3& before :
       {glm::dvec3(0, 0, 100), glm::dvec3(-5000, 2000, 100), glm::dvec3(1000, 2040, 9)})
    b.draw(camera, before, 1.0, target);
  // Into the middle of the box, where both squares have the same middle.
  b.draw(camera, {1000, 2000, 3000}, 1.0, target);
  EXPECT_EQ(straight.pager().middle(), roundabout.pager().middle());
  EXPECT_TRUE(picture == target.read_rgba8());
}

/// HARD-CASES H17 for endless ground: the frames before and after blocks are paged differ by nothing to be
/// seen, and without morphing they do.
TEST_F(FractalDrawer, PagingShowsNoPop) {
  const auto worst_change = [&](bool morph) {
    TerrainSettings ground = settings();
    ground.rings = {4, 9};
    ground.morph = morph;
    ground.ground.roughness = 0.5;
    Terrain terrain(ground);
    Drawer drawer(terrain);
    const gl::Framebuffer target(320, 240);
    terrain.move_to({0.0, 0.0});
    const double border = 8.0 * 0.625;  // of the box about the middle, posts
    const double up = terrain.height_m({0.0, 0.0}) + 0.15 * side_m(ground);
    std::vector<std::uint8_t> before;
    int worst = 0;
    for (const double x : {border - 1e-4, border + 1e-4}) {
      drawer.draw(flat_camera(90.0, -45.0, 50.0, 4.0 / 3.0), {x, 0.0, up}, 1.0, target);
      const std::vector<std::uint8_t> picture = target.read_rgba8();
      for (std::size_t k = 0; k < before.size(); ++k)
        worst = std::max(worst, std::abs(int{picture[k]} - int{before[k]}));
      before = picture;
    }
    EXPECT_EQ(terrain.pager().middle().x, 1);
    return worst;
  };
  const int off = worst_change(false), on = worst_change(true);
  EXPECT_GT(off, 3 * on) << on;
  EXPECT_LT(on, 12);
}

TEST(FractalLowFlight, KeepsItsClearance) {
  Settings ground;
  ground.iterations = 9;
  const Ground made(ground);
  const LowFlight flight(made,
                         {.from_m = {1e6, -3e5}, .heading_deg = 77, .length_m = 30000, .clearance_m = 150});
  Ground::Workspace workspace;
  for (int k = 0; k <= 2000; ++k) {
    const glm::dvec3 eye = flight.at(k / 2000.0);
    std::array<float, 4> around{};
    made.heights(9, {std::int64_t(std::floor(eye.x)), std::int64_t(std::floor(eye.y)), 2, 2, 1}, around,
                 workspace);
    EXPECT_GE(eye.z, double(*std::max_element(around.begin(), around.end())) + 149.9);
  }
}

}  // namespace
}  // namespace globe::flat::fractal
