#include "app/accuracy/endless_quality.h"

#include <epoxy/gl.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <utility>

#include "app/accuracy/seen_ground.h"
#include "flat/fractal/low_flight.h"
#include "flat/fractal/mesh.h"
#include "flat/terrain.h"

namespace app::accuracy {
namespace {

namespace flat = globe::flat;
namespace fractal = globe::flat::fractal;

/// z over a place, posts, of the triangles between all posts.
std::optional<double> ground_z(const fractal::Terrain& terrain, const glm::dvec2& posts) {
  const auto i = static_cast<std::int64_t>(std::floor(posts.x)),
             j = static_cast<std::int64_t>(std::floor(posts.y));
  const fractal::Pager& pager = terrain.pager();
  const auto beyond = [&](std::int64_t post, std::int64_t first) {
    const std::int64_t from_first = post - first * pager.cells();
    return from_first < 0 || from_first + 1 >= std::int64_t{pager.blocks()} * pager.cells();
  };
  if (beyond(i, pager.first().x) || beyond(j, pager.first().y)) return std::nullopt;
  const auto at = [&](int di, int dj) {
    return terrain.height_m({static_cast<double>(i + di), static_cast<double>(j + dj)});
  };
  return flat::in_cell({at(0, 0), at(1, 0), at(0, 1), at(1, 1)}, (i + j) % 2 == 0,
                       posts.x - static_cast<double>(i), posts.y - static_cast<double>(j));
}

void add_block(const fractal::Terrain& terrain, const fractal::BlockDraw& draw, const glm::dvec3& eye,
               SeenGround& seen) {
  const fractal::Pager& pager = terrain.pager();
  const double spacing = terrain.spacing_m();
  const fractal::BlockKey first = pager.first();
  const int side = pager.cells() + 1;
  const auto corner = [&](std::uint16_t post) {
    const int i = post % side, j = post / side;
    const float height = terrain.drawn_height_m(draw, i, j, {eye.x, eye.y});
    return glm::dvec3(static_cast<double>((first.x + draw.column) * pager.cells() + i) * spacing,
                      static_cast<double>((first.y + draw.row) * pager.cells() + j) * spacing,
                      static_cast<double>(height));
  };
  const std::vector<std::uint16_t> triangles =
      fractal::block_triangles(pager.cells(), draw.level, draw.edges);
  for (std::size_t k = 0; k < triangles.size(); k += 3)
    seen.add(corner(triangles[k]), corner(triangles[k + 1]), corner(triangles[k + 2]));
}

}  // namespace

fractal::TerrainSettings endless_ground(const std::optional<fractal::Rings>& rings) {
  fractal::TerrainSettings settings;
  settings.pager = {.log2_cells = 4, .log2_blocks = 6};
  settings.lod = rings.has_value();
  if (rings) settings.rings = *rings;
  return settings;
}

std::vector<EndlessView> judged_endless_views(const PictureSize& picture) {
  const fractal::Ground ground{fractal::Settings{}};
  const fractal::LowFlight flight(ground, {});
  std::vector<EndlessView> views;
  for (const double share : {0.0, 0.4, 0.8}) {
    views.push_back({"km " + std::to_string(static_cast<int>(24 * share)) + " of the flight",
                     fractal::flat_camera(30.0, -8.0, picture.fov_y_deg,
                                          static_cast<double>(picture.width) / picture.height),
                     flight.at(share)});
  }
  return views;
}

EndlessFrame::EndlessFrame(std::shared_ptr<globe::gl::Context> context,
                           const fractal::TerrainSettings& settings, const PictureSize& picture)
    : context_(std::move(context)),
      terrain_(settings),
      drawer_(terrain_),
      target_(picture.width, picture.height) {}

double EndlessFrame::draw_ms(const EndlessView& view) {
  glFinish();
  const auto begin = std::chrono::steady_clock::now();
  triangles_ = drawer_.draw(view.camera, view.eye, kEndlessNear_m, target_).triangles;
  target_.resolve();
  glFinish();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

ErrorFigure displacement(const fractal::TerrainSettings& settings, const std::vector<EndlessView>& views,
                         const PictureSize& picture) {
  fractal::Terrain terrain(settings);
  const fractal::Pager& pager = terrain.pager();
  const double spacing = terrain.spacing_m();
  ErrorSum sum;
  for (const EndlessView& view : views) {
    terrain.move_to({view.eye.x, view.eye.y});
    globe::render::Camera camera = view.camera;
    camera.position = view.eye * glm::dvec3(spacing, spacing, 1.0);
    SeenGround seen(camera, picture.width, picture.height);
    for (int block = 0; block < pager.blocks() * pager.blocks(); ++block)
      add_block(terrain, terrain.block_draw(block % pager.blocks(), block / pager.blocks()), view.eye, seen);
    seen.add_displacements(
        view.name,
        [&](double x, double y) {
          return ground_z(terrain, {x / spacing, y / spacing});
        },
        sum);
  }
  return sum.figure();
}

}  // namespace app::accuracy
