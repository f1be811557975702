#include "flat/levels.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "flat/box.h"

namespace globe::flat {
namespace {

/// Of the bound, for a patch's own level. The rest is for cells beside a side that the neighbour has coarser:
/// they were seen to be off by up to 1.16 times what either patch is.
constexpr double kOwnShare = 0.8;

}  // namespace

float level_for(const LevelErrors& errors, double allowed) {
  for (std::size_t level = 0; level + 1 < kLevels; ++level) {
    const auto fine = static_cast<double>(errors[level]);
    const auto coarse = static_cast<double>(errors[level + 1]);
    if (coarse <= allowed) continue;
    const double share = std::max(allowed - fine, 0.0) / (coarse - fine);
    const double steps = std::floor(share / static_cast<double>(kLevelStep));
    return static_cast<float>(level) + std::min(static_cast<float>(steps) * kLevelStep, 1.0f - kLevelStep);
  }
  return static_cast<float>(kLevels - 1);
}

ErrorBound error_bound(double pixels, double fov_y_deg, double aspect, int picture_height,
                       const dvec3& axis) {
  const double tan_y = std::tan(fov_y_deg * std::numbers::pi / 360.0);
  // A small step across a ray at an angle a from the axis is stretched by 1 / cos(a) twice: the picture's
  // plane is that much farther off than where the ray ends, and it is tilted.
  const double stretch = 1.0 + tan_y * tan_y * (1.0 + aspect * aspect);
  return {pixels, stretch, axis, 0.5 * picture_height / tan_y * stretch};
}

namespace {

/// Share of the corner's stretch that a box has at the most, seen from `eye`: 1 / cos^2 of the angle from the
/// axis to the farthest of the ball around it and so far beyond.
double stretch_share(const ErrorBound& bound, const Box& box, const dvec3& eye, double beyond_m) {
  const dvec3 to = 0.5 * (box.low + box.high) - eye;
  const double distance = glm::length(to), radius = 0.5 * glm::distance(box.low, box.high) + beyond_m;
  if (radius >= distance) return 1.0;
  const double cosine = glm::dot(to, bound.axis) / distance, spread = radius / distance;
  const double farthest =
      cosine * std::sqrt(1.0 - spread * spread) - std::sqrt(std::max(1.0 - cosine * cosine, 0.0)) * spread;
  if (farthest <= 0.0) return 1.0;
  return std::min(1.0 / (farthest * farthest * bound.corner_stretch), 1.0);
}

}  // namespace

void limit_steps(std::vector<float>& levels, int patches_east, int patches_north) {
  const auto at = [&](int i, int j) -> float& {
    return levels[static_cast<std::size_t>(j) * static_cast<std::size_t>(patches_east) +
                  static_cast<std::size_t>(i)];
  };
  for (int j = 0; j < patches_north; ++j) {
    for (int i = 0; i < patches_east; ++i) {
      if (i > 0) at(i, j) = std::min(at(i, j), at(i - 1, j) + 1.0f);
      if (j > 0) at(i, j) = std::min(at(i, j), at(i, j - 1) + 1.0f);
    }
  }
  for (int j = patches_north - 1; j >= 0; --j) {
    for (int i = patches_east - 1; i >= 0; --i) {
      if (i + 1 < patches_east) at(i, j) = std::min(at(i, j), at(i + 1, j) + 1.0f);
      if (j + 1 < patches_north) at(i, j) = std::min(at(i, j), at(i, j + 1) + 1.0f);
    }
  }
}

LevelErrors pixels_off(const Terrain& terrain, std::size_t patch, const dvec3& eye, const ErrorBound& bound) {
  const Box box = patch_box(terrain, patch);
  const dvec3 middle = 0.5 * (box.low + box.high);
  LevelErrors pixels{};
  for (std::size_t quarter = 0; quarter < 4; ++quarter) {
    Box part = box;
    (quarter % 2 == 0 ? part.high : part.low).x = middle.x;
    (quarter / 2 == 0 ? part.high : part.low).y = middle.y;
    const dvec3 nearest = glm::clamp(eye, part.low, part.high);
    // An error stands upright: of it counts the part across the line of sight, level / distance, over the
    // distance. Of all lines of sight into the box that is most at the height nearest to the eye's, and there
    // as far away on the level as up.
    const double nearest_level = std::hypot(eye.x - nearest.x, eye.y - nearest.y);
    const double farthest_level =
        std::hypot(std::max(std::abs(eye.x - part.low.x), std::abs(eye.x - part.high.x)),
                   std::max(std::abs(eye.y - part.low.y), std::abs(eye.y - part.high.y)));
    const double up = std::abs(eye.z - nearest.z);
    const double level = std::max(std::clamp(up, nearest_level, farthest_level), 1e-6);
    const double a_metre = bound.pixels_at_1m * level / (level * level + up * up);
    for (std::size_t k = 0; k < kLevels; ++k) {
      // A side that the neighbour has coarser moves the cells beside it too.
      const double share =
          stretch_share(bound, part, eye, std::ldexp(terrain.spacing_m(), static_cast<int>(k)));
      pixels[k] = std::max(
          pixels[k], static_cast<float>(a_metre * share *
                                        static_cast<double>(terrain.patch(patch).errors_m[quarter][k])));
    }
  }
  return pixels;
}

std::vector<float> patch_levels(const Terrain& terrain, const dvec3& eye, const ErrorBound& bound,
                                Morph morph) {
  std::vector<float> levels(terrain.patch_count());
  for (std::size_t k = 0; k < levels.size(); ++k) {
    levels[k] = level_for(pixels_off(terrain, k, eye, bound), kOwnShare * bound.pixels);
    if (morph == Morph::kOff) levels[k] = std::floor(levels[k]);
  }
  limit_steps(levels, terrain.patches_east(), terrain.patches_north());
  return levels;
}

PatchState patch_state(const std::vector<float>& levels, int patches_east, int patches_north,
                       std::size_t patch) {
  const auto east = static_cast<std::size_t>(patches_east);
  const int i = static_cast<int>(patch % east);
  const int j = static_cast<int>(patch / east);
  const float own = levels[patch];
  const std::array<float, kSides> sides{i > 0 ? std::max(own, levels[patch - 1]) : own,
                                        i + 1 < patches_east ? std::max(own, levels[patch + 1]) : own,
                                        j > 0 ? std::max(own, levels[patch - east]) : own,
                                        j + 1 < patches_north ? std::max(own, levels[patch + east]) : own};
  PatchState state;
  state.level = static_cast<int>(own);
  state.morph = own - static_cast<float>(state.level);
  for (std::size_t side = 0; side < kSides; ++side) {
    const int level = static_cast<int>(sides[side]);
    state.coarser[side] = level > state.level;
    state.side_morph[side] = sides[side] - static_cast<float>(level);
  }
  return state;
}

}  // namespace globe::flat
