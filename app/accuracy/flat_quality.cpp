#include "app/accuracy/flat_quality.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <random>
#include <span>
#include <utility>

#include "app/accuracy/seen_ground.h"
#include "app/flat_camera.h"
#include "flat/fractal/ground.h"
#include "flat/height_grid.h"
#include "globe/geo/sun.h"
#include "globe/planet/scenic.h"

namespace app::accuracy {
namespace {

namespace flat = globe::flat;
namespace render = globe::render;
using glm::dvec3;
using globe::planet::Surface;

constexpr int kCells = 512;          ///< a side
constexpr double kWalkAbove = 30.0;  ///< metres above ground

double aspect_of(const PictureSize& picture) { return static_cast<double>(picture.width) / picture.height; }

render::Camera camera_over(const flat::Terrain& terrain, double x, double y, double above_m,
                           double heading_deg, double pitch_deg, const PictureSize& picture) {
  return render::make_camera(terrain.frame().ellipsoid(),
                             terrain.frame().geodetic_from_local({x, y, terrain.z_at(x, y) + above_m}),
                             heading_deg, pitch_deg, picture.fov_y_deg, aspect_of(picture));
}

flat::TangentFrame frame_at(const Surface& surface) {
  const globe::geo::Geodetic place = globe::planet::scenic_place(surface).place;
  return {surface.ellipsoid(), place.lat_deg, place.lon_deg};
}

/// Pixels by which a move along z goes on the screen; nothing of a place that is not in the picture.
std::optional<double> move_on_screen(const render::Camera& camera, const PictureSize& picture,
                                     const dvec3& place, double move_m) {
  const auto seen = [&](const dvec3& at) {
    const dvec3 relative = at - camera.position;
    const double ahead = glm::dot(relative, camera.forward);
    return glm::dvec3(glm::dot(relative, camera.right) / (ahead * camera.tan_x()),
                      glm::dot(relative, camera.up) / (ahead * camera.tan_y()), ahead);
  };
  const dvec3 now = seen(place);
  if (now.z <= 0.0 || std::abs(now.x) > 1.0 || std::abs(now.y) > 1.0) return std::nullopt;
  const dvec3 before = seen(place - dvec3(0.0, 0.0, move_m));
  if (before.z <= 0.0) return std::nullopt;
  return std::hypot((now.x - before.x) * picture.width / 2.0, (now.y - before.y) * picture.height / 2.0);
}

/// @param camera  in the frame
std::vector<float> levels_from(const flat::Terrain& terrain, const render::Camera& camera, flat::Morph morph,
                               double error_px, const PictureSize& picture) {
  return flat::patch_levels(
      terrain, camera.position,
      flat::error_bound(error_px, camera.fov_y_deg, camera.aspect, picture.height, camera.forward), morph);
}

/// A corner of a drawn triangle: its post, counted from the region's south-west, and z.
struct MeshCorner {
  glm::ivec2 post;
  double z;
};

/// Calls `use` with every triangle that patches of such levels are drawn with.
template <typename Use>
void for_each_triangle(const flat::Terrain& terrain, const std::vector<float>& levels, const Use& use) {
  for (std::size_t patch = 0; patch < terrain.patch_count(); ++patch) {
    const auto east = static_cast<std::size_t>(terrain.patches_east());
    const glm::ivec2 first = flat::kPatchCells * glm::ivec2(patch % east, patch / east);
    const flat::PatchState state =
        flat::patch_state(levels, terrain.patches_east(), terrain.patches_north(), patch);
    const std::vector<flat::PatchVertex> vertices = flat::patch_vertices(terrain, patch, state);
    const std::vector<std::uint16_t> indices = flat::patch_indices(state.shape());
    for (std::size_t k = 0; k < indices.size(); k += 3) {
      std::array<MeshCorner, 3> corners{};
      for (std::size_t c = 0; c < 3; ++c) {
        const flat::PatchVertex& vertex = vertices[indices[k + c]];
        corners[c] = {first + glm::ivec2(vertex.column, vertex.row),
                      static_cast<double>(flat::morphed_z(vertex, state))};
      }
      use(corners);
    }
  }
}

}  // namespace

std::shared_ptr<const flat::Terrain> judged_region() {
  return std::make_shared<const flat::Terrain>(
      flat::TangentFrame(globe::geo::kWgs84, 45.0, 0.0),
      flat::fractal::FractalSource({.roughness = 0.95, .relief_m = 600.0}),
      flat::PostRect{-kCells / 2, -kCells / 2, kCells + 1, kCells + 1, 1});
}

std::vector<JudgedView> judged_region_views(const flat::Terrain& terrain, const PictureSize& picture) {
  const FlatView all = overview(terrain);
  const double length = terrain.spacing_m() * (terrain.posts().rows - 1);
  const auto over = [&](double above_m, double pitch_deg) {
    return camera_over(terrain, -0.2 * length, -0.25 * length, above_m, 35.0, pitch_deg, picture);
  };
  return {{"all of it", render::make_camera(terrain.frame().ellipsoid(), all.place, all.look.heading_deg,
                                            all.look.pitch_deg, picture.fov_y_deg, aspect_of(picture))},
          {"1000 m", over(1000.0, -30.0)},
          {"200 m", over(200.0, -12.0)},
          {"30 m", over(30.0, -6.0)},
          {"eye height", over(2.0, -3.0)}};
}

render::Camera camera_in_frame(const flat::TangentFrame& frame, const render::Camera& camera) {
  render::Camera local = camera;
  local.position = frame.local_from_ecef(camera.position);
  local.forward = camera.forward * frame.axes();
  local.right = camera.right * frame.axes();
  local.up = camera.up * frame.axes();
  return local;
}

RegionFrame::RegionFrame(std::shared_ptr<globe::gl::Context> context,
                         const std::shared_ptr<const flat::Terrain>& terrain,
                         const flat::GeomipmapSettings& settings, const PictureSize& picture)
    : context_(std::move(context)),
      renderer_(terrain, flat::post_colors(*terrain), settings),
      target_(picture.width, picture.height),
      sun_(globe::geo::morning_sun(terrain->frame().origin().lon_deg)) {}

double RegionFrame::draw_ms(const render::Camera& camera) {
  glFinish();
  const auto begin = std::chrono::steady_clock::now();
  renderer_.draw(camera, sun_, true, target_);
  target_.resolve();
  glFinish();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

ErrorFigure displacement(const flat::Terrain& terrain, double error_px, const std::vector<JudgedView>& views,
                         const PictureSize& picture) {
  ErrorSum sum;
  for (const JudgedView& view : views) {
    const render::Camera camera = camera_in_frame(terrain.frame(), view.camera);
    SeenGround seen(camera, picture.width, picture.height);
    const auto place = [&](const MeshCorner& corner) {
      return dvec3(terrain.x_m(corner.post.x), terrain.y_m(corner.post.y), corner.z);
    };
    for_each_triangle(terrain, levels_from(terrain, camera, flat::Morph::kGpu, error_px, picture),
                      [&](const std::array<MeshCorner, 3>& corners) {
                        seen.add(place(corners[0]), place(corners[1]), place(corners[2]));
                      });
    seen.add_displacements(
        view.name,
        [&](double x, double y) {
          return terrain.covers(x, y) ? std::optional(terrain.z_at(x, y)) : std::nullopt;
        },
        sum);
  }
  return sum.figure();
}

std::vector<float> mesh_heights(const flat::Terrain& terrain, const std::vector<float>& levels) {
  const auto columns = static_cast<std::size_t>(terrain.posts().columns);
  std::vector<float> z(terrain.z().size());
  for_each_triangle(terrain, levels, [&](const std::array<MeshCorner, 3>& corners) {
    const auto& [a, b, c] = corners;
    const glm::ivec2 ab = b.post - a.post, ac = c.post - a.post;
    const int det = ab.x * ac.y - ac.x * ab.y;
    const glm::ivec2 low = glm::min(a.post, glm::min(b.post, c.post)),
                     high = glm::max(a.post, glm::max(b.post, c.post));
    for (int j = low.y; j <= high.y; ++j) {
      for (int i = low.x; i <= high.x; ++i) {
        const glm::ivec2 p = glm::ivec2(i, j) - a.post;
        const int v = p.x * ac.y - ac.x * p.y, w = ab.x * p.y - p.x * ab.y;
        if (v < 0 || w < 0 || v + w > det) continue;
        z[static_cast<std::size_t>(j) * columns + static_cast<std::size_t>(i)] =
            static_cast<float>(a.z + (v * (b.z - a.z) + w * (c.z - a.z)) / det);
      }
    }
  });
  return z;
}

std::vector<WalkStep> walk_over(const flat::Terrain& terrain, const PictureSize& picture, int steps_taken) {
  const double half = 0.5 * terrain.spacing_m() * (terrain.posts().rows - 1);
  std::vector<WalkStep> steps;
  for (int k = 0; k < steps_taken; ++k) {
    const double y = half * (-0.9 + 1.2 * k / steps_taken);
    const auto at = [&](double north) {
      return camera_over(terrain, 0.0, north, kWalkAbove, 0.0, -8.0, picture);
    };
    steps.push_back({at(y), at(y + kStep_m)});
  }
  return steps;
}

PlanetGround::PlanetGround(std::shared_ptr<const Surface> surface)
    : surface_(std::move(surface)), frame_(frame_at(*surface_)) {
  constexpr int kPlaces = 1000;
  std::mt19937_64 random(43);
  std::uniform_real_distribution<double> share(-0.49, 0.49);
  while (places_.size() < kPlaces) {
    const double x = share(random) * kSide_m, y = share(random) * kSide_m;
    globe::geo::Geodetic place = frame_.geodetic_from_local({x, y, 0.0});
    place.h_m = surface_->drawn_height(
        surface_->height(globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg), kFinest));
    places_.push_back(frame_.local_from_geodetic(place));
  }
}

std::shared_ptr<const flat::Terrain> PlanetGround::terrain(double spacing_m) const {
  const int level = static_cast<int>(std::ceil(std::log2(surface_->root_edge() / spacing_m)));
  const flat::GroundHeights heights = [&](std::span<const dvec3> normals, std::span<float> out) {
    for (std::size_t k = 0; k < normals.size(); ++k)
      out[k] = static_cast<float>(surface_->drawn_height(surface_->height(normals[k], level)));
  };
  const int cells = static_cast<int>(std::lround(kSide_m / spacing_m));
  const flat::HeightGrid grid =
      flat::sample_ground(frame_, spacing_m, {-cells / 2, -cells / 2, cells + 1, cells + 1, 1}, heights);
  return std::make_shared<const flat::Terrain>(frame_, grid, *grid.extent());
}

ErrorFigure PlanetGround::error(double spacing_m) const {
  const auto region = terrain(spacing_m);
  ErrorSum sum;
  for (const dvec3& place : places_) {
    sum.add(region->z_at(place.x, place.y) - place.z, [&] {
      char text[64];
      std::snprintf(text, sizeof text, "%.1f m east, %.1f m north", place.x, place.y);
      return std::string(text);
    });
  }
  return sum.figure();
}

ErrorFigure leaps(const flat::Terrain& terrain, flat::Morph morph, double error_px,
                  const PictureSize& picture, const std::vector<WalkStep>& walk) {
  const int columns = terrain.posts().columns;
  ErrorSum sum;
  int step = 0;
  for (const WalkStep& taken : walk) {
    const render::Camera after = camera_in_frame(terrain.frame(), taken.after);
    const auto mesh_from = [&](const render::Camera& camera) {
      return mesh_heights(
          terrain, levels_from(terrain, camera_in_frame(terrain.frame(), camera), morph, error_px, picture));
    };
    const std::vector<float> before_z = mesh_from(taken.before), after_z = mesh_from(taken.after);
    for (std::size_t k = 0; k < after_z.size(); ++k) {
      const int i = static_cast<int>(k) % columns, j = static_cast<int>(k) / columns;
      const double z = static_cast<double>(after_z[k]);
      const auto move = move_on_screen(after, picture, {terrain.x_m(i), terrain.y_m(j), z},
                                       z - static_cast<double>(before_z[k]));
      if (!move) continue;
      sum.add(*move, [&] {
        char text[96];
        std::snprintf(text, sizeof text, "step %d, post %d,%d", step, i, j);
        return std::string(text);
      });
    }
    ++step;
  }
  return sum.figure();
}

}  // namespace app::accuracy
