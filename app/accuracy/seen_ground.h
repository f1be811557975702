#pragma once

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/accuracy/study.h"
#include "globe/render/camera.h"

namespace app::accuracy {

/// z of some ground over a place of the plane; nothing where there is none.
using GroundZ = std::function<std::optional<double>(double x_m, double y_m)>;

/// Ground drawn in a frame whose z is up, as a camera sees it: what rays through the middles of pixels, every
/// kPixelStep-th across and down, meet first of its triangles. In double: what the GPU rounds is not in it.
class SeenGround {
 public:
  /// @param camera  place and directions in the frame
  SeenGround(const globe::render::Camera& camera, int width, int height);

  /// A triangle, counter-clockwise seen from above; corners in the frame.
  void add(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

  /// Adds how far what is seen is from the ground straight above or below it: pixels on the screen.
  /// @param view  for where an error was
  void add_displacements(const std::string& view, const GroundZ& z_at, ErrorSum& sum) const;

 private:
  void meet(const std::array<glm::dvec3, 3>& corners, std::size_t ray);
  std::optional<double> displacement(std::size_t ray, const GroundZ& z_at) const;

  globe::render::Camera camera_;
  int width_, height_, columns_, rows_;
  std::vector<glm::dvec3> rays_;
  std::vector<double> distances_;  ///< in lengths of the ray; infinite where none is met
};
constexpr int kPixelStep = 2;

}  // namespace app::accuracy
