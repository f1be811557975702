#include "flat/globe_region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "flat/height_grid.h"
#include "globe/geo/sun.h"
#include "globe/render/globe_renderer.h"
#include "tests/render/gl_fixture.h"
#include "tests/unit/flat/rough_ground.h"

namespace {

using namespace globe::flat;
namespace geo = globe::geo;
namespace render = globe::render;
using globe::gl::Framebuffer;

constexpr int kRegionWidth = 320, kRegionHeight = 180;
constexpr glm::vec3 kRegionMagenta(1.0f, 0.0f, 1.0f);
constexpr double kLat = -43.43, kLon = -106.39;  // mountains of the built-in planet
const glm::dvec3 kRegionMorning(geo::morning_sun(kLon));

/// A part of the built-in planet's own ground.
std::shared_ptr<const Terrain> part_of(const std::shared_ptr<const globe::planet::Surface>& surface,
                                       int patches, double spacing_m, double lat_deg, double lon_deg) {
  const TangentFrame frame(surface->ellipsoid(), lat_deg, lon_deg);
  const int level = static_cast<int>(std::ceil(std::log2(surface->root_edge() / spacing_m)));
  const GroundHeights ground = [&](std::span<const glm::dvec3> normals, std::span<float> heights) {
    for (std::size_t k = 0; k < normals.size(); ++k)
      heights[k] = static_cast<float>(surface->drawn_height(surface->height(normals[k], level)));
  };
  const int half = 8 * patches;
  const HeightGrid grid =
      sample_ground(frame, spacing_m, {-half, -half, 2 * half + 1, 2 * half + 1, 1}, ground);
  return std::make_shared<const Terrain>(frame, grid, *grid.extent());
}

class GlobeRegionTest : public GlTest {
 protected:
  std::shared_ptr<const globe::planet::Surface> surface_ = globe::planet::Surface::builtin(1);

  render::GlobeRenderer globe_with(const std::shared_ptr<const Terrain>& terrain,
                                   const GroundSettings& ground = {}, bool sky = false) const {
    render::RenderSettings settings;
    if (!sky) settings.background = kRegionMagenta;
    return {surface_,
            settings,
            {},
            terrain ? std::make_unique<GlobeRegion>(terrain, GroundKnowledge{}, ground) : nullptr};
  }

  /// A camera over a place of the plane of a frame, above whatever is drawn there.
  render::Camera over(const render::GlobeRenderer& globe, const TangentFrame& frame, const glm::dvec2& at,
                      double above_m, double heading_deg, double pitch_deg) const {
    geo::Geodetic place = frame.geodetic_from_local({at.x, at.y, frame.z_at(at.x, at.y, 0.0)});
    place.h_m = 9000.0;
    for (int k = 0; k < 4; ++k)  // the nearer, the finer the ground
      place.h_m += above_m - globe.height_above_ground(geo::ecef_from_geodetic(surface_->ellipsoid(), place));
    return render::make_camera(surface_->ellipsoid(), place, heading_deg, pitch_deg, 60.0,
                               static_cast<double>(kRegionWidth) / kRegionHeight);
  }

  static std::size_t holes(const std::vector<std::uint8_t>& rgba) {
    std::size_t count = 0;
    for (std::size_t k = 0; k < rgba.size(); k += 4)
      count += rgba[k] == 255 && rgba[k + 1] == 0 && rgba[k + 2] == 255;
    return count;
  }
};

/// Ground that fits not at all, hundreds of metres too high and rough from post to post: whatever is not
/// closed by construction stays open.
TEST_F(GlobeRegionTest, ItsRimShowsNoCrackFromAnywhere) {
  const auto terrain = rough_terrain(6, 6, kLat, kLon);
  const double half = terrain->x_m(terrain->posts().columns - 1);
  for (const double error_px : {0.5, 6.0}) {
    GroundSettings ground;
    ground.error_px = error_px;
    render::GlobeRenderer globe = globe_with(terrain, ground);
    const Framebuffer frame(kRegionWidth, kRegionHeight, {.samples = 4});
    for (const double above : {3.0, 60.0, 900.0, 15'000.0, 400'000.0}) {
      for (const glm::dvec2& at : {glm::dvec2(half, 0.3 * half), {-half, -half}, {0.2 * half, 1.1 * half}}) {
        // Looking down along the rim: no sky in view.
        const render::Camera camera = over(globe, terrain->frame(), at, above, 40.0 + above, -75.0);
        globe.draw(camera, kRegionMorning, true, frame);
        frame.resolve();
        EXPECT_EQ(holes(frame.read_rgba8()), 0u) << error_px << ' ' << above << ' ' << at.x << ',' << at.y;
      }
    }
  }
}

/// Where pixels of a picture lie in a frame, row by row from the top.
std::vector<dvec3> places(const Framebuffer& frame, const render::Camera& camera, double near_m,
                          const TangentFrame& local) {
  const auto depth = frame.read_depth();
  std::vector<dvec3> result;
  for (int y = 0; y < kRegionHeight; ++y) {
    for (int x = 0; x < kRegionWidth; ++x) {
      const double right = (2.0 * (x + 0.5) / kRegionWidth - 1.0) * camera.tan_x();
      const double up = (1.0 - 2.0 * (y + 0.5) / kRegionHeight) * camera.tan_y();
      const double along =
          near_m / static_cast<double>(depth[static_cast<std::size_t>(y * kRegionWidth + x)]);
      result.push_back(local.local_from_ecef(
          camera.position + along * (camera.forward + right * camera.right + up * camera.up)));
    }
  }
  return result;
}

/// From a pixel inside of the rim to its neighbour outside the ground goes on as steeply as ground is, even
/// where the globe has detail that the region's posts are too far apart for.
TEST_F(GlobeRegionTest, TheGroundHasNoStepAtTheRim) {
  const auto terrain = part_of(surface_, 8, 30.0, kLat, kLon);
  const render::Room room = room_of(*terrain);
  const double half = room.high.x;
  render::GlobeRenderer globe = globe_with(terrain);
  const Framebuffer frame(kRegionWidth, kRegionHeight);
  for (const double above : {5.0, 50.0, 500.0, 10'000.0}) {
    const render::Camera camera = over(globe, terrain->frame(), {half, 0.2 * half}, above, 10.0, -80.0);
    globe.draw(camera, kRegionMorning, true, frame);
    const double near_m = render::near_distance(surface_->ellipsoid(), globe.nearest_drawn(camera.position));
    const std::vector<dvec3> at = places(frame, camera, near_m, terrain->frame());
    int pairs = 0;
    for (std::size_t k = 0; k + 1 < at.size(); ++k) {
      if (k % kRegionWidth == kRegionWidth - 1 || (at[k].x < half) == (at[k + 1].x < half)) continue;
      ++pairs;
      const dvec3 step = at[k + 1] - at[k];
      EXPECT_LT(std::abs(step.z), 2.0 * std::hypot(step.x, step.y) + 0.002 * above) << above;
    }
    EXPECT_GT(pairs, 10) << above;
  }
}

/// Where both have posts enough, the picture is that of the globe alone.
TEST_F(GlobeRegionTest, ItShowsTheGlobesOwnGround) {
  const auto terrain = part_of(surface_, 8, 30.0, kLat, kLon);
  render::GlobeRenderer globe = globe_with(terrain), plain = globe_with(nullptr);
  const Framebuffer frame(kRegionWidth, kRegionHeight), other(kRegionWidth, kRegionHeight);
  for (const double above : {5'000.0, 20'000.0, 100'000.0}) {
    const render::Camera camera =
        over(globe, terrain->frame(), {0.8 * terrain->x_m(128), 0.0}, above, 10.0, -90.0);
    globe.draw(camera, kRegionMorning, true, frame);
    plain.draw(camera, kRegionMorning, true, other);
    const double near_a = render::near_distance(surface_->ellipsoid(), globe.nearest_drawn(camera.position));
    const double near_b = render::near_distance(surface_->ellipsoid(), plain.nearest_drawn(camera.position));
    const std::vector<dvec3> a = places(frame, camera, near_a, terrain->frame());
    const std::vector<dvec3> b = places(other, camera, near_b, terrain->frame());
    // Straight down a difference of height is seen at an angle, at the picture's corner the largest.
    const double pixels = 0.5 * kRegionHeight / std::tan(std::numbers::pi / 6.0) * 1.2;
    std::vector<double> off;
    for (std::size_t k = 0; k < a.size(); ++k) off.push_back(pixels * std::abs(a[k].z - b[k].z) / above);
    std::sort(off.begin(), off.end());
    EXPECT_LT(off[off.size() / 2], 0.3) << above;
    EXPECT_LT(off[off.size() * 98 / 100], 3.0) << above;  // the rest are behind edges
  }
}

TEST_F(GlobeRegionTest, ItsBordersAreWhereTheGlobesGroundIsDrawn) {
  const auto terrain = part_of(surface_, 8, 30.0, kLat, kLon);
  auto made = std::make_unique<GlobeRegion>(terrain, GroundKnowledge{}, GroundSettings{});
  const GlobeRegion& region = *made;
  render::RenderSettings settings;
  settings.background = kRegionMagenta;
  render::GlobeRenderer globe(surface_, settings, {}, std::move(made));
  const Framebuffer frame(kRegionWidth, kRegionHeight);
  for (const double above : {20.0, 2'000.0, 100'000.0}) {
    globe.draw(over(globe, terrain->frame(), {1000.0, 500.0}, above, 0.0, -60.0), kRegionMorning, true,
               frame);
    const Rim& rim = region.rim();
    EXPECT_GT(rim.outside[kWest].points().size(), 1u);
    // Lifts are the difference between two meshes of one ground: small where both are fine.
    if (above < 100.0) {
      EXPECT_LT(rim.highest_m, 40.0);
    }
    EXPECT_GT(rim.highest_m, 0.0);
  }
}

TEST_F(GlobeRegionTest, TheCpuKnowsTheLiftsOfTheShader) {
  const auto terrain = rough_terrain(4, 4, kLat, kLon);
  GroundSettings ground;
  ground.lod = false;
  auto made = std::make_unique<GlobeRegion>(terrain, GroundKnowledge{}, ground);
  const GlobeRegion& region = *made;
  render::RenderSettings settings;
  settings.background = kRegionMagenta;
  render::GlobeRenderer globe(surface_, settings, {}, std::move(made));
  const Framebuffer frame(kRegionWidth, kRegionHeight);
  const double half = terrain->x_m(terrain->posts().columns - 1);
  const render::Camera camera = over(globe, terrain->frame(), {0.9 * half, 0.9 * half}, 500.0, 0.0, -90.0);
  globe.draw(camera, kRegionMorning, true, frame);
  const double near_m = render::near_distance(surface_->ellipsoid(), globe.nearest_drawn(camera.position));
  const std::vector<dvec3> seen = places(frame, camera, near_m, terrain->frame());
  int compared = 0;
  for (int y = 4; y < kRegionHeight; y += 8) {
    for (int x = 4; x < kRegionWidth; x += 8) {
      const dvec3& at = seen[static_cast<std::size_t>(y * kRegionWidth + x)];
      const double column = (at.x - terrain->x_m(0)) / terrain->spacing_m();
      const double row = (at.y - terrain->y_m(0)) / terrain->spacing_m();
      if (!(column > 0.0 && row > 0.0 && column < terrain->posts().columns - 1 &&
            row < terrain->posts().rows - 1))
        continue;
      const int i = static_cast<int>(column), j = static_cast<int>(row);
      const auto lifted = [&](int c, int r) {
        return static_cast<double>(terrain->z(c, r) + lift_at(region.rim(), terrain->posts(), c, r));
      };
      const double z = in_cell({lifted(i, j), lifted(i + 1, j), lifted(i, j + 1), lifted(i + 1, j + 1)},
                               splits_north_east(i % kPatchCells, j % kPatchCells), column - i, row - j);
      EXPECT_NEAR(at.z, z, 0.02) << column << ',' << row;
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

TEST_F(GlobeRegionTest, ACameraOverItStandsAboveItsGroundAndTheGlobeUnderItIsLeftCoarse) {
  const auto terrain = part_of(surface_, 8, 30.0, kLat, kLon);
  render::GlobeRenderer globe = globe_with(terrain), plain = globe_with(nullptr);
  const Framebuffer frame(kRegionWidth, kRegionHeight);
  const render::Camera camera = over(globe, terrain->frame(), {0.0, 0.0}, 2.0, 0.0, -20.0);
  EXPECT_NEAR(globe.height_above_ground(camera.position), 2.0, 1e-6);
  globe.draw(camera, kRegionMorning, true, frame);
  plain.draw(camera, kRegionMorning, true, frame);
  EXPECT_LT(globe.frame_stats().finest_level, plain.frame_stats().finest_level - 6);
}

TEST_F(GlobeRegionTest, OutOfViewItChangesNothing) {
  const auto terrain = part_of(surface_, 4, 30.0, kLat, kLon);
  render::GlobeRenderer globe = globe_with(terrain, {}, true), plain = globe_with(nullptr, {}, true);
  const Framebuffer a(kRegionWidth, kRegionHeight), b(kRegionWidth, kRegionHeight);
  const TangentFrame far(surface_->ellipsoid(), 46.0, 7.0);
  const render::Camera camera = over(plain, far, {0.0, 0.0}, 400.0, 40.0, -15.0);
  globe.draw(camera, kRegionMorning, true, a);
  plain.draw(camera, kRegionMorning, true, b);
  EXPECT_EQ(a.read_rgba8(), b.read_rgba8());
}

TEST_F(GlobeRegionTest, LiesAcrossTheAntimeridianAndAtAPoleAsAnywhere) {
  for (const auto& [lat, lon] : {std::pair(-16.5, 180.0), std::pair(89.95, 30.0), std::pair(0.0, 90.0)}) {
    const auto terrain = part_of(surface_, 4, 30.0, lat, lon);
    render::GlobeRenderer globe = globe_with(terrain);
    const Framebuffer frame(kRegionWidth, kRegionHeight, {.samples = 4});
    const double half = terrain->x_m(terrain->posts().columns - 1);
    for (const double above : {100.0, 5'000.0}) {
      globe.draw(over(globe, terrain->frame(), {half, half}, above, 200.0, -70.0), kRegionMorning, true,
                 frame);
      frame.resolve();
      EXPECT_EQ(holes(frame.read_rgba8()), 0u) << lat << ' ' << above;
    }
  }
}

}  // namespace
