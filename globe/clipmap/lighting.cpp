#include "globe/clipmap/lighting.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "globe/planet/grid.h"

namespace globe::clipmap {
namespace {

namespace shader {
using namespace glm;
#include "shaders/lib/lit_ground.glsl"
}  // namespace shader

/// The sun's parts along u, t1 and t2 over a rectangle of nodes: exact at the corners of blocks, bilinear
/// between.
class SunInFrame {
 public:
  SunInFrame(const dvec3& sun, int level, int d, const NodeRect& rect)
      : block_(1 << std::clamp(level - 5, 0, 4)),
        first_i_(rect.i0 / block_),
        first_j_(rect.j0 / block_),
        columns_(rect.i1 / block_ - first_i_ + 2) {
    const int n = planet::nodes_per_side(level);
    const dvec3 axis = shading_axis(d);
    const int rows = rect.j1 / block_ - first_j_ + 2;
    corners_.reserve(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows));
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns_; ++x) {
        const dvec3 u = planet::node_direction(
            {d, level, std::min((first_i_ + x) * block_, n), std::min((first_j_ + y) * block_, n)});
        const dvec3 t1 = glm::normalize(axis - u * glm::dot(u, axis));
        corners_.emplace_back(glm::dot(sun, u), glm::dot(sun, t1), glm::dot(sun, glm::cross(u, t1)));
      }
    }
  }

  /// The parts along row j, to be walked block by block.
  class Row {
   public:
    Row(const SunInFrame& frame, int j) : frame_(frame) {
      const int y = j / frame.block_ - frame.first_j_;
      above_ = &frame.corners_[static_cast<std::size_t>(y * frame.columns_)];
      below_ = above_ + frame.columns_;
      down_ = static_cast<float>(j % frame.block_) / static_cast<float>(frame.block_);
    }
    glm::vec3 at(int i) const {
      const int x = i / frame_.block_ - frame_.first_i_;
      const float across = static_cast<float>(i % frame_.block_) / static_cast<float>(frame_.block_);
      const glm::vec3 left = above_[x] + (below_[x] - above_[x]) * down_;
      const glm::vec3 right = above_[x + 1] + (below_[x + 1] - above_[x + 1]) * down_;
      return left + (right - left) * across;
    }

   private:
    const SunInFrame& frame_;
    const glm::vec3* above_;
    const glm::vec3* below_;
    float down_;
  };

 private:
  int block_, first_i_, first_j_, columns_;
  std::vector<glm::vec3> corners_;
};

std::uint8_t code(float value) { return static_cast<std::uint8_t>(std::min(value, 1.0f) * 255.0f + 0.5f); }

glm::vec2 decode_normal(const glm::u16vec2& normal) { return glm::vec2(normal) * (2.0f / 65534.0f) - 1.0f; }

}  // namespace

glm::vec3 light_of(const glm::vec4& lit, const glm::vec3& sunlight, const glm::vec3& skylight) {
  return shader::ground_light(lit, sunlight * shader::kSunRange, skylight);
}

glm::vec4 lit_texel(const glm::vec3& albedo, float up, float facing) {
  return shader::lit_ground(albedo, up, facing);
}

void ShadingNodes::resize(const NodeRect& rect) {
  const auto count = static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
  albedo.resize(count);
  normal.resize(count);
}

dvec3 shading_axis(int d) {
  constexpr double kHalf = 0.70710678118654752440;
  constexpr std::array<std::array<double, 2>, 4> kAxes{
      {{-kHalf, kHalf}, {-kHalf, -kHalf}, {kHalf, -kHalf}, {kHalf, kHalf}}};
  const auto& axis = kAxes[static_cast<std::size_t>(d)];
  return {axis[0], axis[1], 0.0};
}

std::vector<glm::u8vec4> lit_nodes(const Lighting& lighting, int level, int d, const NodeRect& part,
                                   const NodeRect& held, const ShadingNodes& ground) {
  std::vector<glm::u8vec4> lit;
  lit.reserve(static_cast<std::size_t>(part.width()) * static_cast<std::size_t>(part.height()));
  const SunInFrame frame(lighting.sun, level, d, part);
  for (int j = part.j0; j <= part.j1; ++j) {
    const SunInFrame::Row sun_along(frame, j);
    std::size_t k = static_cast<std::size_t>(j - held.j0) * static_cast<std::size_t>(held.width()) +
                    static_cast<std::size_t>(part.i0 - held.i0);
    for (int i = part.i0; i <= part.i1; ++i, ++k) {
      const glm::vec2 slope = decode_normal(ground.normal[k]);
      const float up = std::sqrt(std::max(1.0f - glm::dot(slope, slope), 0.0f));
      if (lighting.normals) {
        lit.emplace_back(code(slope.x * 0.5f + 0.5f), code(slope.y * 0.5f + 0.5f), code(up), 0);
        continue;
      }
      const glm::vec3 sun = sun_along.at(i);
      const glm::vec3 root = glm::vec3(ground.albedo[k]) * (1.0f / 255.0f);
      const glm::vec4 texel =
          shader::lit_ground(root * root, up, sun.x * up + sun.y * slope.x + sun.z * slope.y);
      lit.emplace_back(code(texel.x), code(texel.y), code(texel.z), code(texel.w));
    }
  }
  return lit;
}

}  // namespace globe::clipmap
