#include "app/accuracy/position_yardsticks.h"

#include <epoxy/gl.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <utility>

namespace app::accuracy {
namespace {

constexpr double kHighStep = 65536.0;  ///< metres
constexpr double kNearPlane = 0.05;    ///< metres

/// Mirrors `Eye` in shaders/accuracy/position.vert (std140).
struct EyeBlock {
  glm::mat4 clip_from_relative{1.0f};
  glm::vec4 high{0.0f}, low{0.0f};
  glm::uvec4 low_words{0}, high_words{0};
  glm::vec4 offset{0.0f};
};

bool is_split(Yardstick yardstick) {
  return yardstick == Yardstick::kHighLow || yardstick == Yardstick::kDoubleSingle;
}

std::vector<std::string> defines_of(Yardstick yardstick) {
  switch (yardstick) {
    case Yardstick::kFloat:
      break;
    case Yardstick::kAnchored:
      return {"ANCHORED"};
    case Yardstick::kHighLow:
      return {"SPLIT"};
    case Yardstick::kDoubleSingle:
      return {"SPLIT", "TWO_SUM"};
    case Yardstick::kDouble:
      return {"DOUBLE"};
  }
  return {};
}

globe::gl::Program program_of(Yardstick yardstick) {
  globe::gl::ProgramSources sources;
  sources.files = {"accuracy/position.vert", "accuracy/plain.frag"};
  sources.defines = defines_of(yardstick);
  sources.captured = {"gl_Position"};
  return globe::gl::Program(sources);
}

/// A coordinate as two words: floats, or halves of the double; the second is not always needed.
std::array<std::uint32_t, 2> words_of(Yardstick yardstick, double x) {
  if (yardstick == Yardstick::kDouble) {
    const auto bits = std::bit_cast<std::uint64_t>(x);
    return {static_cast<std::uint32_t>(bits >> 32U), static_cast<std::uint32_t>(bits)};
  }
  const double rounded = yardstick == Yardstick::kHighLow ? std::trunc(x / kHighStep) * kHighStep
                                                          : static_cast<double>(static_cast<float>(x));
  return {std::bit_cast<std::uint32_t>(static_cast<float>(rounded)),
          std::bit_cast<std::uint32_t>(static_cast<float>(x - rounded))};
}

}  // namespace

std::string name_of(Yardstick yardstick) {
  switch (yardstick) {
    case Yardstick::kFloat:
      return "float from the centre";
    case Yardstick::kAnchored:
      return "float from a place near by";
    case Yardstick::kHighLow:
      return "high and low float";
    case Yardstick::kDoubleSingle:
      return "double-single";
    case Yardstick::kDouble:
      break;
  }
  return "double";
}

int bytes_a_vertex(Yardstick yardstick) {
  return is_split(yardstick) || yardstick == Yardstick::kDouble ? 24 : 12;
}

YardstickMesh::YardstickMesh(std::shared_ptr<globe::gl::Context> context, Yardstick yardstick,
                             const std::vector<glm::dvec3>& corners, const globe::render::Camera& camera,
                             const glm::dvec3& anchor)
    : context_(std::move(context)),
      count_(corners.size()),
      program_(program_of(yardstick)),
      array_(globe::gl::VertexArray::create()) {
  const bool is_wide = bytes_a_vertex(yardstick) > 12;
  std::vector<std::uint32_t> words;
  for (const glm::dvec3& corner : corners) {
    const glm::dvec3 place = yardstick == Yardstick::kAnchored ? corner - anchor : corner;
    for (int half = 0; half < (is_wide ? 2 : 1); ++half) {
      for (int axis = 0; axis < 3; ++axis)
        words.push_back(words_of(yardstick, place[axis])[static_cast<std::size_t>(half)]);
    }
  }
  vertices_ = globe::gl::Buffer::of(words);
  array_.set_vertices(0, vertices_, 0, bytes_a_vertex(yardstick));
  using globe::gl::Attribute;
  for (GLuint half = 0; half < (is_wide ? 2U : 1U); ++half) {
    array_.set_attribute(0, yardstick == Yardstick::kDouble
                                ? Attribute{half, 3, GL_UNSIGNED_INT, 12 * half, Attribute::Kind::kInteger}
                                : Attribute{half, 3, GL_FLOAT, 12 * half});
  }
  const auto x = words_of(yardstick, camera.position.x), y = words_of(yardstick, camera.position.y),
             z = words_of(yardstick, camera.position.z);
  EyeBlock eye;
  eye.clip_from_relative = glm::mat4(globe::render::clip_from_relative(camera, kNearPlane));
  eye.high_words = {x[0], y[0], z[0], 0};
  eye.low_words = {x[1], y[1], z[1], 0};
  eye.high = glm::uintBitsToFloat(eye.high_words);
  eye.low = glm::uintBitsToFloat(eye.low_words);
  eye.offset = glm::vec4(glm::vec3(anchor - camera.position), 0.0f);
  eye_ = globe::gl::Buffer(sizeof eye, &eye);
}

std::vector<glm::vec4> YardstickMesh::clip() const {
  const globe::gl::Buffer recorded(count_ * sizeof(glm::vec4));
  target_.bind();
  glEnable(GL_RASTERIZER_DISCARD);
  array_.bind();
  program_.use();
  eye_.bind_base(GL_UNIFORM_BUFFER, 0);
  recorded.bind_base(GL_TRANSFORM_FEEDBACK_BUFFER, 0);
  glBeginTransformFeedback(GL_TRIANGLES);
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(count_));
  glEndTransformFeedback();
  glDisable(GL_RASTERIZER_DISCARD);
  return recorded.read<glm::vec4>(0, count_);
}

double YardstickMesh::draw_ns() const {
  target_.bind();
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glDisable(GL_CULL_FACE);
  target_.clear_depth(0.0f);
  array_.bind();
  program_.use();
  eye_.bind_base(GL_UNIFORM_BUFFER, 0);
  glFinish();
  const auto begin = std::chrono::steady_clock::now();
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(count_));
  glFinish();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count() /
         static_cast<double>(count_);
}

}  // namespace app::accuracy
