#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <string>
#include <vector>

#include "globe/gl/buffer.h"
#include "globe/gl/context.h"
#include "globe/gl/framebuffer.h"
#include "globe/gl/program.h"
#include "globe/gl/vertex_array.h"
#include "globe/render/camera.h"

namespace app::accuracy {

/// Ways to bring a vertex to the camera (shaders/accuracy/position.vert).
enum class Yardstick {
  kFloat,         ///< a float a coordinate, from the planet's centre
  kAnchored,      ///< a float a coordinate, from one place on the ground near by
  kHighLow,       ///< two floats a coordinate, the high one in steps of 65536 m, the camera subtracted by
                  ///< parts (Ohlarik 2008, "Precisions, Precisions")
  kDoubleSingle,  ///< two floats a coordinate, the low one the other's rounding error, subtracted by two-sum
                  ///< (Dekker 1971)
  kDouble,        ///< a double a coordinate, in the shader too
};
inline constexpr std::array kYardsticks{Yardstick::kFloat, Yardstick::kAnchored, Yardstick::kHighLow,
                                        Yardstick::kDoubleSingle, Yardstick::kDouble};

std::string name_of(Yardstick yardstick);
int bytes_a_vertex(Yardstick yardstick);

/// Triangles of one yardstick before a camera.
class YardstickMesh {
 public:
  /// @param context  current, and stays so
  /// @param corners  ECEF metres, three a triangle
  /// @param anchor   ECEF metres, of kAnchored
  YardstickMesh(std::shared_ptr<globe::gl::Context> context, Yardstick yardstick,
                const std::vector<glm::dvec3>& corners, const globe::render::Camera& camera,
                const glm::dvec3& anchor);

  /// Clip coordinates of all corners, as the GPU has them.
  std::vector<glm::vec4> clip() const;

  /// Nanoseconds a corner of drawing them all into a picture of 64x36 pixels.
  double draw_ns() const;

 private:
  std::shared_ptr<globe::gl::Context> context_;
  std::size_t count_;
  globe::gl::Program program_;
  globe::gl::Buffer vertices_, eye_;
  globe::gl::VertexArray array_;
  globe::gl::Framebuffer target_{64, 36};
};

}  // namespace app::accuracy
