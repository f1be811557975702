#include "app/accuracy/seen_ground.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>

namespace app::accuracy {
namespace {

using glm::dvec3;

constexpr double kLeastAhead = 1e-3;  ///< metres: nearer corners have no place in the picture
constexpr double kNowhere = std::numeric_limits<double>::infinity();

/// From the picture's middle, in halves of its sides.
glm::dvec2 on_screen(const globe::render::Camera& camera, const dvec3& relative) {
  const double ahead = glm::dot(relative, camera.forward);
  return {glm::dot(relative, camera.right) / (ahead * camera.tan_x()),
          glm::dot(relative, camera.up) / (ahead * camera.tan_y())};
}

}  // namespace

SeenGround::SeenGround(const globe::render::Camera& camera, int width, int height)
    : camera_(camera),
      width_(width),
      height_(height),
      columns_((width + kPixelStep - 1) / kPixelStep),
      rows_((height + kPixelStep - 1) / kPixelStep),
      distances_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), kNowhere) {
  rays_.reserve(distances_.size());
  for (int j = 0; j < rows_; ++j)
    for (int i = 0; i < columns_; ++i)
      rays_.push_back(globe::render::direction_through(camera, (i * kPixelStep + 0.5) / width,
                                                       (j * kPixelStep + 0.5) / height));
}

void SeenGround::add(const dvec3& a, const dvec3& b, const dvec3& c) {
  const std::array<dvec3, 3> corners{a - camera_.position, b - camera_.position, c - camera_.position};
  glm::dvec2 low(kNowhere), high(-kNowhere);
  int behind = 0;
  for (const dvec3& corner : corners) {
    if (glm::dot(corner, camera_.forward) < kLeastAhead) {
      ++behind;
      continue;
    }
    const glm::dvec2 at = on_screen(camera_, corner);
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  if (behind == 3) return;
  if (behind > 0) {  // it may be seen anywhere
    low = glm::dvec2(-1.0);
    high = glm::dvec2(1.0);
  }
  const auto column = [&](double x) {
    return std::clamp(((1.0 + x) * width_ / 2.0 - 0.5) / kPixelStep, -1.0, columns_ + 0.0);
  };
  const auto row = [&](double y) {
    return std::clamp(((1.0 - y) * height_ / 2.0 - 0.5) / kPixelStep, -1.0, rows_ + 0.0);
  };
  const int i0 = std::max(static_cast<int>(std::floor(column(low.x))), 0),
            i1 = std::min(static_cast<int>(std::ceil(column(high.x))), columns_ - 1),
            j0 = std::max(static_cast<int>(std::floor(row(high.y))), 0),
            j1 = std::min(static_cast<int>(std::ceil(row(low.y))), rows_ - 1);
  for (int j = j0; j <= j1; ++j)
    for (int i = i0; i <= i1; ++i)
      meet(corners,
           static_cast<std::size_t>(j) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(i));
}

/// By the volumes that a ray spans with the sides.
void SeenGround::meet(const std::array<dvec3, 3>& corners, std::size_t ray) {
  const auto& [a, b, c] = corners;
  const dvec3& along = rays_[ray];
  const double u = glm::dot(along, glm::cross(c, b)), v = glm::dot(along, glm::cross(a, c)),
               w = glm::dot(along, glm::cross(b, a));
  if (u < 0.0 || v < 0.0 || w < 0.0 || u + v + w <= 0.0) return;
  const double distance = glm::dot((u * a + v * b + w * c) / (u + v + w), along);
  if (distance > 0.0) distances_[ray] = std::min(distances_[ray], distance);
}

std::optional<double> SeenGround::displacement(std::size_t ray, const GroundZ& z_at) const {
  if (distances_[ray] == kNowhere) return std::nullopt;
  const dvec3 seen = distances_[ray] * rays_[ray];
  const std::optional<double> z = z_at(camera_.position.x + seen.x, camera_.position.y + seen.y);
  if (!z) return std::nullopt;
  const dvec3 meant(seen.x, seen.y, *z - camera_.position.z);
  if (glm::dot(meant, camera_.forward) <= 0.0) return std::nullopt;
  const glm::dvec2 off = on_screen(camera_, meant) - on_screen(camera_, seen);
  return std::hypot(off.x * width_ / 2.0, off.y * height_ / 2.0);
}

void SeenGround::add_displacements(const std::string& view, const GroundZ& z_at, ErrorSum& sum) const {
  std::vector<std::optional<double>> errors(rays_.size());
  tbb::parallel_for(std::size_t{0}, errors.size(),
                    [&](std::size_t ray) { errors[ray] = displacement(ray, z_at); });
  for (std::size_t ray = 0; ray < errors.size(); ++ray) {
    if (!errors[ray]) continue;
    sum.add(*errors[ray], [&] {
      const auto columns = static_cast<std::size_t>(columns_);
      char text[96];
      std::snprintf(text, sizeof text, "%s, pixel %zu,%zu", view.c_str(), ray % columns * kPixelStep,
                    ray / columns * kPixelStep);
      return std::string(text);
    });
  }
}

}  // namespace app::accuracy
