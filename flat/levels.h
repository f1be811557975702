#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "flat/terrain.h"

namespace globe::flat {

/// How the meshes of levels follow each other.
enum class Morph {
  kOff,  ///< at once
  kCpu,  ///< gradually, heights computed by this program for every frame
  kGpu   ///< gradually, by the vertex shader
};

/// Levels are whole multiples of this, so that differences and sums of them are exact.
inline constexpr float kLevelStep = 1.0f / 1024.0f;

/// The coarsest real-valued level whose error is at most `allowed`, in [0, 4]: level l + f has the mesh of l
/// whose vertices have gone the share f of their way to that of l + 1, and an error of at most
/// (1 - f) errors[l] + f errors[l + 1].
float level_for(const LevelErrors& errors, double allowed);

/// How a view sees errors.
struct ErrorBound {
  double pixels = 1.0;
  /// Times that the picture's corner is stretched more than its middle.
  double corner_stretch = 1.0;
  /// Where the camera looks, unit, in the frame: places near there are stretched less. Zero: everything
  /// counts as though it were seen in the corner.
  dvec3 axis{0.0};
  /// Pixels that a metre across the line of sight, a metre away, covers at the most: in a corner of the
  /// picture, where a plane picture is stretched.
  double pixels_at_1m = 1000.0;
};
/// @param fov_y_deg, aspect  of a pinhole camera
/// @param axis  ErrorBound::axis
ErrorBound error_bound(double pixels, double fov_y_deg, double aspect, int picture_height, const dvec3& axis);

/// Pixels that the meshes of a patch's levels are off by on the screen at the most, seen from a place of the
/// frame: the error of each quarter at its nearest point, from above only as much of it as stands across the
/// line of sight.
LevelErrors pixels_off(const Terrain& terrain, std::size_t patch, const dvec3& eye, const ErrorBound& bound);

/// Level of every patch as seen from a place of the frame: the coarsest whose error
/// stays under the bound, but at most one above each of its four neighbours.
/// @param morph  kOff: whole levels
std::vector<float> patch_levels(const Terrain& terrain, const dvec3& eye, const ErrorBound& bound,
                                Morph morph);

/// Lowers levels until no patch is more than 1 above a neighbour; the greatest such levels.
void limit_steps(std::vector<float>& levels, int patches_east, int patches_north);

enum Side : unsigned char { kWest, kEast, kSouth, kNorth };
inline constexpr std::size_t kSides = 4;

/// How a patch is drawn.
struct PatchState {
  int level = 0;
  std::array<bool, kSides> coarser{};  ///< the side has the posts of level + 1: the neighbour's are no more
  float morph = 0;                     ///< the share f of the patch, in [0, 1)
  std::array<float, kSides> side_morph{};  ///< likewise of its sides

  /// Two patches of one shape have the same triangles and vertices that move alike.
  int shape() const {
    return level * 16 + (coarser[0] ? 1 : 0) + (coarser[1] ? 2 : 0) + (coarser[2] ? 4 : 0) +
           (coarser[3] ? 8 : 0);
  }
};
inline constexpr int kShapes = kLevels * 16;

/// A side that two patches share is drawn at the coarser of their levels: the finer one adapts.
PatchState patch_state(const std::vector<float>& levels, int patches_east, int patches_north,
                       std::size_t patch);

}  // namespace globe::flat
