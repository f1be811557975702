#include <epoxy/gl.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "app/bench.h"
#include "flat/geomipmap_renderer.h"
#include "flat/height_grid.h"
#include "globe/geo/sun.h"
#include "globe/gl/context.h"
#include "globe/planet/scenic.h"
#include "globe/planet/surface.h"

namespace app {
namespace {

namespace flat = globe::flat;
namespace geo = globe::geo;
namespace render = globe::render;

constexpr int kFlatWidth = 1280;
constexpr int kFlatHeight = 720;
constexpr int kPatches = 16;  ///< a side: Wagner's 257 x 257 posts
constexpr double kSpacing = 30.0;
constexpr int kLevel = 18;  ///< of the built-in planet's ground

/// The ground around a scenic place of the built-in planet, and a walk over it: a low flight across it in as
/// many rounds as there are, so that levels change all the time.
struct FlatWorld {
  explicit FlatWorld(int number_of_rounds)
      : rounds(number_of_rounds), context("auto"), surface(globe::planet::Surface::builtin(1)) {
    const globe::planet::ScenicView scenic = globe::planet::scenic_place(*surface);
    const flat::TangentFrame frame(surface->ellipsoid(), scenic.place.lat_deg, scenic.place.lon_deg);
    const flat::GroundHeights ground = [this](std::span<const glm::dvec3> normals, std::span<float> heights) {
      for (std::size_t k = 0; k < normals.size(); ++k)
        heights[k] = static_cast<float>(surface->drawn_height(surface->height(normals[k], kLevel)));
    };
    constexpr int kPosts = kPatches * flat::kPatchCells;
    const flat::HeightGrid grid =
        flat::sample_ground(frame, kSpacing, {-kPosts / 2, -kPosts / 2, kPosts + 1, kPosts + 1, 1}, ground);
    terrain = std::make_shared<const flat::Terrain>(frame, grid, *grid.extent());
    colors = flat::post_colors(*terrain);
    sun = geo::morning_sun(scenic.place.lon_deg);
  }

  render::Camera camera(int round) const {
    const double half = 0.5 * kPatches * flat::kPatchCells * kSpacing;
    const double y = half * (-0.95 + 1.4 * (round % rounds) / rounds);
    const geo::Geodetic place = terrain->frame().geodetic_from_local({0.0, y, terrain->z_at(0.0, y) + 60.0});
    return render::make_camera(surface->ellipsoid(), place, 0.0, -8.0, 60.0,
                               double(kFlatWidth) / kFlatHeight);
  }

  int rounds;
  globe::gl::Context context;
  std::shared_ptr<const globe::planet::Surface> surface;
  std::shared_ptr<const flat::Terrain> terrain;
  std::vector<glm::vec4> colors;
  glm::dvec3 sun{1, 0, 0};
};

struct FlatRun {
  FlatRun(std::shared_ptr<FlatWorld> shared, const flat::GeomipmapSettings& settings)
      : world(std::move(shared)),
        renderer(world->terrain, world->colors, settings),
        target(kFlatWidth, kFlatHeight) {
    for (int k = 0; k < 3; ++k) renderer.draw(world->camera(k), world->sun, true, target);
    glFinish();
  }

  void draw_next() {
    renderer.set_instant({round / 30.0});
    renderer.draw(world->camera(round++), world->sun, true, target);
    glFinish();
  }

  std::shared_ptr<FlatWorld> world;
  flat::GeomipmapRenderer renderer;
  globe::gl::Framebuffer target;
  int round = 0;
};

}  // namespace

std::vector<BenchmarkEntry> flat_benchmarks(int rounds) {
  const auto shared = std::make_shared<std::shared_ptr<FlatWorld>>();
  const auto world = [shared, rounds] {
    if (!*shared) *shared = std::make_shared<FlatWorld>(rounds);
    return *shared;
  };
  struct Way {
    const char* name;
    flat::Morph morph;
  };
  std::vector<BenchmarkEntry> entries;
  for (const bool full : {false, true}) {
    for (const Way& way :
         {Way{"static", flat::Morph::kOff}, Way{"cpu", flat::Morph::kCpu}, Way{"gpu", flat::Morph::kGpu}}) {
      const std::string name = std::string("flat.") + (full ? "full." : "minimum.") + way.name;
      entries.push_back({name, [=] {
                           flat::GeomipmapSettings settings;
                           settings.morph = way.morph;
                           if (full) {
                             settings.materials = flat::grass_stone_and_mud(*world()->terrain);
                             settings.cloud_cover = 0.4;
                           } else {
                             settings.background = glm::vec3(0.5f);
                           }
                           auto run = std::make_shared<FlatRun>(world(), settings);
                           return Benchmark{name, 1, [run] { run->draw_next(); }};
                         }});
    }
  }
  return entries;
}

}  // namespace app
