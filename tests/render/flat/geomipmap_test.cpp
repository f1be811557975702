#include "flat/geomipmap_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <random>

#include "flat/height_grid.h"
#include "globe/clipmap/ray.h"
#include "globe/geo/sun.h"
#include "globe/render/globe_renderer.h"
#include "tests/hard/table.h"
#include "tests/render/gl_fixture.h"
#include "tests/unit/flat/rough_ground.h"

namespace {

using namespace globe::flat;
namespace geo = globe::geo;
namespace render = globe::render;
using globe::gl::Framebuffer;

constexpr int kFlatWidth = 320, kFlatHeight = 180;
constexpr glm::vec3 kMagenta(1.0f, 0.0f, 1.0f);

GeomipmapSettings plain() {
  GeomipmapSettings settings;
  settings.background = kMagenta;
  return settings;
}

GeomipmapRenderer renderer_of(const std::shared_ptr<const Terrain>& terrain,
                              const GeomipmapSettings& settings) {
  return {terrain, post_colors(*terrain), settings};
}

/// A camera over a place of the frame's plane.
render::Camera camera_over(const Terrain& terrain, double x, double y, double above, double heading,
                           double pitch) {
  const geo::Geodetic place = terrain.frame().geodetic_from_local({x, y, terrain.z_at(x, y) + above});
  return render::make_camera(terrain.frame().ellipsoid(), place, heading, pitch, 60.0,
                             static_cast<double>(kFlatWidth) / kFlatHeight);
}

std::vector<render::Camera> tour(const Terrain& terrain, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const double half = 0.4 * (terrain.posts().columns - 1) * terrain.spacing_m();
  std::vector<render::Camera> cameras;
  cameras.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k)
    cameras.push_back(camera_over(terrain, half * (2 * share(random) - 1), half * (2 * share(random) - 1),
                                  2.0 * std::pow(500.0, share(random)), 360 * share(random),
                                  -90.0 * share(random)));
  return cameras;
}

const glm::dvec3 kMorning(geo::morning_sun(-122.19));

class Geomipmap : public GlTest {
 protected:
  std::vector<std::uint8_t> picture(GeomipmapRenderer& renderer, const render::Camera& camera) {
    const Framebuffer frame(kFlatWidth, kFlatHeight);
    renderer.draw(camera, kMorning, true, frame);
    return frame.read_rgba8();
  }
};

/// Where a ray meets the mesh of level 0, by every triangle of the region.
std::optional<double> first_hit(const Terrain& terrain, const glm::dvec3& eye, const glm::dvec3& direction) {
  const globe::clipmap::Ray ray(eye, direction);
  std::optional<double> nearest;
  const auto at = [&](int i, int j) {
    return glm::dvec3(terrain.x_m(i), terrain.y_m(j), static_cast<double>(terrain.z(i, j)));
  };
  const auto meet = [&](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const auto hit = ray.meet(a, b, c);
    if (hit && hit->distance_m > 0.1 && (!nearest || hit->distance_m < *nearest)) nearest = hit->distance_m;
  };
  for (int j = 0; j + 1 < terrain.posts().rows; ++j) {
    for (int i = 0; i + 1 < terrain.posts().columns; ++i) {
      const glm::dvec3 sw = at(i, j), se = at(i + 1, j), nw = at(i, j + 1), ne = at(i + 1, j + 1);
      if (splits_north_east(i, j)) {
        meet(sw, se, ne);
        meet(sw, ne, nw);
      } else {
        meet(sw, se, nw);
        meet(se, ne, nw);
      }
    }
  }
  return nearest;
}

TEST_F(Geomipmap, ThePictureIsThatOfTheMeshInDoublePrecision) {
  const auto terrain = rough_terrain(4, 4);
  GeomipmapSettings settings = plain();
  settings.lod = false;
  GeomipmapRenderer renderer = renderer_of(terrain, settings);
  const Framebuffer frame(kFlatWidth, kFlatHeight);
  std::mt19937 random(2);
  int on_ground = 0, wrong = 0;
  for (const render::Camera& camera : tour(*terrain, 8, 1)) {
    renderer.draw(camera, kMorning, true, frame);
    const std::vector<float> depth = frame.read_depth();
    const double near_m = render::near_distance(geo::kWgs84, renderer.nearest_drawn(camera.position));
    const glm::dvec3 eye = terrain->frame().local_from_ecef(camera.position);
    for (int k = 0; k < 40; ++k) {
      const int x = static_cast<int>(random() % kFlatWidth), y = static_cast<int>(random() % kFlatHeight);
      const glm::dvec3 along =
          render::direction_through(camera, (x + 0.5) / kFlatWidth, (y + 0.5) / kFlatHeight);
      const auto hit = first_hit(*terrain, eye, along * terrain->frame().axes());
      const auto shown = static_cast<double>(depth[static_cast<std::size_t>(y * kFlatWidth + x)]);
      if (!hit || shown == 0.0) {
        wrong += hit.has_value() != (shown != 0.0) ? 1 : 0;
        continue;
      }
      ++on_ground;
      const double distance = near_m / shown / glm::dot(along, camera.forward);
      // Near a ridge or at a grazing angle a tenth of a pixel is far along the ray.
      if (std::abs(distance - *hit) > 0.02 * *hit + 0.01) ++wrong;
    }
  }
  EXPECT_GT(on_ground, 150);
  EXPECT_LE(wrong, on_ground / 50);
}

TEST_F(Geomipmap, MorphingByThisProgramAndByTheShaderGiveOnePicture) {
  const auto terrain = rough_terrain(6, 6);
  GeomipmapSettings settings = plain();
  settings.error_px = 4.0;
  GeomipmapRenderer gpu = renderer_of(terrain, settings);
  settings.morph = Morph::kCpu;
  GeomipmapRenderer cpu = renderer_of(terrain, settings);
  settings.morph = Morph::kOff;
  GeomipmapRenderer off = renderer_of(terrain, settings);
  bool differs = false;
  for (const render::Camera& camera : tour(*terrain, 6, 4)) {
    const auto by_shader = picture(gpu, camera);
    EXPECT_EQ(by_shader, picture(cpu, camera));
    differs = differs || by_shader != picture(off, camera);
  }
  EXPECT_TRUE(differs);
}

/// HARD-CASES H16 for regions: straight down nothing but ground can be seen.
TEST_F(Geomipmap, NoBackgroundLeaksBetweenPatchesOfAnyLevels) {
  const auto terrain = rough_terrain(8, 8);
  for (const double error_px : {0.5, 3.0, 12.0}) {
    GeomipmapSettings settings = plain();
    settings.error_px = error_px;
    GeomipmapRenderer renderer = renderer_of(terrain, settings);
    std::mt19937 random(7);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    for (int k = 0; k < (hard::full() ? 350 : 20); ++k) {
      const render::Camera camera =
          camera_over(*terrain, 900 * share(random), 900 * share(random),
                      30.0 + 400.0 * std::abs(share(random)), 180 * share(random), -90);
      const auto rgba = picture(renderer, camera);
      int leaks = 0;
      for (std::size_t p = 0; p < rgba.size(); p += 4)
        leaks += rgba[p] > 180 && rgba[p + 1] < 60 && rgba[p + 2] > 180 ? 1 : 0;
      EXPECT_EQ(leaks, 0);
    }
  }
}

TEST_F(Geomipmap, CullingAndVisibleSetsLeaveThePictureAsItIs) {
  const auto terrain = rough_terrain(6, 6);
  GeomipmapSettings settings = plain();
  settings.lod = false;
  GeomipmapRenderer culled = renderer_of(terrain, settings);
  settings.culling = false;
  GeomipmapRenderer all = renderer_of(terrain, settings);
  settings.culling = true;
  settings.visibility = std::make_shared<const Visibility>(Visibility::compute(*terrain));
  GeomipmapRenderer hidden = renderer_of(terrain, settings);
  std::size_t least = 1000;
  for (const render::Camera& camera : tour(*terrain, 10, 9)) {
    const auto whole = picture(all, camera);
    EXPECT_EQ(all.drawn().size(), 36u);
    EXPECT_EQ(picture(culled, camera), whole);
    EXPECT_EQ(picture(hidden, camera), whole);
    EXPECT_LE(hidden.drawn().size(), culled.drawn().size());
    least = std::min(least, hidden.drawn().size());
  }
  EXPECT_LT(least, 20u);
}

TEST_F(Geomipmap, FewerTrianglesWhereErrorsAreAllowed) {
  const auto terrain = rough_terrain(8, 8);
  const render::Camera camera = camera_over(*terrain, 0, -1800, 300, 0, -15);
  std::size_t before = 1'000'000;
  for (const double error_px : {0.0, 1.0, 4.0, 16.0}) {
    GeomipmapSettings settings = plain();
    settings.error_px = error_px;
    GeomipmapRenderer renderer = renderer_of(terrain, settings);
    picture(renderer, camera);
    EXPECT_LE(renderer.frame_stats().triangles, before);
    before = renderer.frame_stats().triangles;
  }
  EXPECT_LT(before, 8000u);
}

TEST_F(Geomipmap, APatchKeepsItsBufferAsLongAsItsShapeStays) {
  const auto terrain = rough_terrain(6, 6);
  GeomipmapRenderer renderer = renderer_of(terrain, plain());
  const render::Camera camera = camera_over(*terrain, 0, 0, 100, 30, -20);
  picture(renderer, camera);
  EXPECT_GT(renderer.frame_stats().upload_bytes, 10'000u);
  picture(renderer, camera);
  EXPECT_LT(renderer.frame_stats().upload_bytes, 36u * 48u);
  EXPECT_LE(renderer.inactive_patch_bytes(), 200u);
}

/// A part of the built-in planet: the globe and the region, seen from one place.
TEST_F(Geomipmap, ARegionShowsTheGroundThatTheGlobeShowsAtTheSamePixel) {
  constexpr int kLevel = 11;  // edges of 5 km
  const auto surface = globe::planet::Surface::builtin(1);
  for (const auto& [lat, lon] : {std::pair(46.0, 7.0), std::pair(-16.5, 179.99)}) {
    const TangentFrame frame(surface->ellipsoid(), lat, lon);
    const GroundHeights ground = [&](std::span<const glm::dvec3> normals, std::span<float> heights) {
      for (std::size_t k = 0; k < normals.size(); ++k)
        heights[k] = static_cast<float>(surface->drawn_height(surface->height(normals[k], kLevel)));
    };
    const HeightGrid grid = sample_ground(frame, 800.0, {-64, -64, 129, 129, 1}, ground);
    const auto terrain = std::make_shared<const Terrain>(frame, grid, *grid.extent());
    GeomipmapSettings settings = plain();
    settings.error_px = 0.1;
    GeomipmapRenderer region = renderer_of(terrain, settings);
    render::RenderSettings of_globe;
    of_globe.max_level = kLevel;
    render::GlobeRenderer globe(surface, of_globe);
    const render::Camera camera = camera_over(*terrain, 0, 0, 20'000.0, 40.0, -70.0);
    const Framebuffer frame_a(kFlatWidth, kFlatHeight), frame_b(kFlatWidth, kFlatHeight);
    region.draw(camera, kMorning, true, frame_a);
    globe.draw(camera, kMorning, true, frame_b);
    const auto depth_a = frame_a.read_depth(), depth_b = frame_b.read_depth();
    const double near_a = render::near_distance(surface->ellipsoid(), region.nearest_drawn(camera.position));
    const double near_b = render::near_distance(surface->ellipsoid(), globe.nearest_drawn(camera.position));
    std::vector<double> apart;
    for (std::size_t k = 0; k < depth_a.size(); ++k) {
      ASSERT_GT(depth_a[k], 0.0f);
      const double a = near_a / static_cast<double>(depth_a[k]), b = near_b / static_cast<double>(depth_b[k]);
      apart.push_back(std::abs(a - b) / b);
    }
    std::sort(apart.begin(), apart.end());
    // A pixel is 1/156 of the distance wide; the globe's triangles are coarser toward the picture's rim.
    EXPECT_LT(apart[apart.size() / 2], 0.001) << lon;
    EXPECT_LT(apart[apart.size() * 95 / 100], 0.006) << lon;
  }
}

}  // namespace
