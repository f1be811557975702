#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

#include "globe/gl/context.h"
#include "globe/gl/framebuffer.h"
#include "globe/gl/program.h"
#include "globe/gl/vertex_array.h"

namespace app::accuracy {

/// Ways to make depth of a distance along the view axis. All see from 0.05 m, the globe's near plane, to kFar
/// at the least.
enum class DepthScheme {
  kStandard24,     ///< 1 at the far plane, 24-bit integers
  kStandardFloat,  ///< the same, floats
  kLogarithmic,  ///< log2(1 + w) of a pixel's distance over that of the far plane's, written by the fragment
                 ///< shader; floats
  kReversedFloat,  ///< near / w, floats: what the globe has
};
inline constexpr std::array kDepthSchemes{DepthScheme::kStandard24, DepthScheme::kStandardFloat,
                                          DepthScheme::kLogarithmic, DepthScheme::kReversedFloat};

std::string name_of(DepthScheme scheme);

constexpr double kNear = 0.05;  ///< metres
constexpr double kFar = 1e9;    ///< metres

/// What the depth buffer holds of a distance, growing with it: the formats' arithmetic, single operations
/// rounded as IEEE 754 says.
double stored_depth(DepthScheme scheme, double distance_m);

/// How far apart two distances have to be, this one at or between them, to be told apart for sure, metres:
/// the width of what is stored as one depth.
double smallest_separation(DepthScheme scheme, double distance_m);

/// Distances to try from one to a tenth more, in steps of the golden ratio: none of them lies where a float
/// does for being a round number.
std::vector<double> depth_sample(double distance_m);

/// Planes across the view, drawn with one scheme.
class DepthPlanes {
 public:
  /// @param context  current, and stays so
  DepthPlanes(std::shared_ptr<globe::gl::Context> context, DepthScheme scheme, int width, int height);

  /// Draws planes at these distances in this order, each in a colour of its own; returns which one the middle
  /// of the picture shows.
  int shown(const std::vector<double>& distances_m) const;
  /// Milliseconds of drawing them.
  double draw_ms(const std::vector<double>& distances_m) const;

 private:
  void draw(const std::vector<double>& distances_m) const;

  std::shared_ptr<globe::gl::Context> context_;
  DepthScheme scheme_;
  globe::gl::Program program_;
  globe::gl::VertexArray array_;
  globe::gl::Framebuffer target_;
};

}  // namespace app::accuracy
