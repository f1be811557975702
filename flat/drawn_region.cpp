#include "flat/drawn_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "flat/box.h"
#include "flat/cell.h"

namespace globe::flat {
namespace {

/// Whether a ray's line passes through a box (slabs); in the frame.
bool meets(const clipmap::Ray& ray, const Box& box) {
  double begin = 0.0, end = INFINITY;
  for (int k = 0; k < 3; ++k) {
    const double a = (box.low[k] - ray.origin()[k]) / ray.direction()[k];
    const double b = (box.high[k] - ray.origin()[k]) / ray.direction()[k];
    if (std::isnan(a) || std::isnan(b)) continue;  // along a side, in its plane
    begin = std::max(begin, std::min(a, b));
    end = std::min(end, std::max(a, b));
  }
  return begin <= end;
}

}  // namespace

DrawnRegion::DrawnRegion(std::shared_ptr<const Terrain> terrain, const Rim& rim)
    : terrain_(std::move(terrain)), highest_lift_m_(rim.highest_m) {
  const PostRect& posts = terrain_->posts();
  z_.reserve(static_cast<std::size_t>(posts.columns) * static_cast<std::size_t>(posts.rows));
  for (int row = 0; row < posts.rows; ++row) {
    for (int column = 0; column < posts.columns; ++column)
      z_.push_back(terrain_->z(column, row) + lift_at(rim, posts, column, row));
  }
  std::vector<CollarVertex> triangles;
  const PatchState finest;
  for (std::size_t patch = 0; patch < terrain_->patch_count(); ++patch) {
    if (is_at_border(*terrain_, patch))
      add_collar(*terrain_, rim, {patch, finest, patch_vertices(*terrain_, patch, finest)}, false, {0.0, 0.0},
                 triangles);
  }
  for (const CollarVertex& vertex : triangles) {
    const glm::dvec2 at(vertex.post);
    double z = static_cast<double>(vertex.z);
    if (vertex.lifted != 0.0f) z = post(static_cast<int>(at.x), static_cast<int>(at.y)).z;
    collar_.emplace_back(terrain_->x_m(0) + at.x * terrain_->spacing_m(),
                         terrain_->y_m(0) + at.y * terrain_->spacing_m(), z);
  }
}

dvec3 DrawnRegion::post(int column, int row) const {
  const auto k = static_cast<std::size_t>(row) * static_cast<std::size_t>(terrain_->posts().columns) +
                 static_cast<std::size_t>(column);
  return {terrain_->x_m(column), terrain_->y_m(row), static_cast<double>(z_[k])};
}

std::optional<double> DrawnRegion::hit_in(std::size_t patch, const clipmap::Ray& ray,
                                          double nearest_m) const {
  const auto east = static_cast<std::size_t>(terrain_->patches_east());
  const int column = static_cast<int>(patch % east) * kPatchCells,
            row = static_cast<int>(patch / east) * kPatchCells;
  std::optional<double> first;
  const auto meet = [&](const dvec3& a, const dvec3& b, const dvec3& c) {
    const auto hit = ray.meet(a, b, c);
    if (hit && hit->distance_m >= nearest_m && (!first || hit->distance_m < *first)) first = hit->distance_m;
  };
  for (int j = 0; j < kPatchCells; ++j) {
    for (int i = 0; i < kPatchCells; ++i) {
      const dvec3 sw = post(column + i, row + j), se = post(column + i + 1, row + j);
      const dvec3 nw = post(column + i, row + j + 1), ne = post(column + i + 1, row + j + 1);
      split_cell(splits_north_east(i, j), sw, se, nw, ne, meet);
    }
  }
  return first;
}

std::optional<double> DrawnRegion::first_hit(const clipmap::Ray& ray, double nearest_m) const {
  const TangentFrame& frame = terrain_->frame();
  const clipmap::Ray local(frame.local_from_ecef(ray.origin()), ray.direction() * frame.axes());
  std::optional<double> first;
  const auto take = [&](const std::optional<double>& hit) {
    if (hit && (!first || *hit < *first)) first = hit;
  };
  for (std::size_t patch = 0; patch < terrain_->patch_count(); ++patch) {
    Box box = patch_box(*terrain_, patch);
    box.low.z -= highest_lift_m_;
    box.high.z += highest_lift_m_;
    if (meets(local, box)) take(hit_in(patch, local, nearest_m));
  }
  for (std::size_t k = 0; k < collar_.size(); k += 3) {
    const auto hit = local.meet(collar_[k], collar_[k + 1], collar_[k + 2]);
    if (hit && hit->distance_m >= nearest_m) take(hit->distance_m);
  }
  return first;
}

std::optional<GroundHit> first_hit(const clipmap::DrawnSurface& globe, const DrawnRegion& region,
                                   const render::Room& room, const clipmap::Ray& ray, double nearest_m) {
  const std::optional<double> own = region.first_hit(ray, nearest_m);
  std::optional<clipmap::DrawnPoint> around = globe.first_hit(ray, nearest_m);
  while (around && room.holds(around->position)) {
    // Just behind what is left out: a hair more than the distance's own rounding.
    around = globe.first_hit(ray, around->distance_m + 1e-6 + 1e-12 * around->distance_m);
  }
  if (around && (!own || around->distance_m < *own)) return GroundHit{around->distance_m, around};
  if (own) return GroundHit{*own, std::nullopt};
  return std::nullopt;
}

}  // namespace globe::flat
