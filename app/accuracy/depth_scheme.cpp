#include "app/accuracy/depth_scheme.h"

#include <epoxy/gl.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace app::accuracy {
namespace {

constexpr float kUnits24 = 16777215.0f;

/// Clip z = x * distance + y, for depth in [0, 1].
glm::vec2 depth_row(DepthScheme scheme) {
  if (scheme == DepthScheme::kReversedFloat || scheme == DepthScheme::kLogarithmic)
    return {0.0f, static_cast<float>(kNear)};
  return {static_cast<float>(kFar / (kFar - kNear)), static_cast<float>(-kFar * kNear / (kFar - kNear))};
}

float log_far() { return static_cast<float>(std::log2(1.0 + kFar)); }

}  // namespace

std::string name_of(DepthScheme scheme) {
  switch (scheme) {
    case DepthScheme::kStandard24:
      return "standard, 24 bits";
    case DepthScheme::kStandardFloat:
      return "standard, float";
    case DepthScheme::kLogarithmic:
      return "logarithmic, float";
    case DepthScheme::kReversedFloat:
      break;
  }
  return "reversed, float";
}

double stored_depth(DepthScheme scheme, double distance_m) {
  const auto w = static_cast<float>(distance_m);
  if (scheme == DepthScheme::kLogarithmic) {
    const auto log = static_cast<float>(std::log2(static_cast<double>(1.0f + w)));
    return static_cast<double>(log / log_far());
  }
  const glm::vec2 row = depth_row(scheme);
  const float z = row.x * w + row.y;
  const float depth = z / w;
  if (scheme == DepthScheme::kReversedFloat) return -static_cast<double>(depth);
  if (scheme == DepthScheme::kStandard24) return std::round(static_cast<double>(depth) * kUnits24);
  return static_cast<double>(depth);
}

double smallest_separation(DepthScheme scheme, double distance_m) {
  const double here = stored_depth(scheme, distance_m);
  // From the distance outward to where another depth begins, `way` 1 behind it and -1 before it.
  const auto reach = [&](double way, double farthest) {
    const auto is_other = [&](double step) { return stored_depth(scheme, distance_m + way * step) != here; };
    double same = 0.0, other = distance_m * 0x1p-30;
    while (!is_other(other)) {
      same = other;
      other *= 2.0;
      if (other >= farthest) return farthest;
    }
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (same + other);
      (is_other(middle) ? other : same) = middle;
    }
    return other;
  };
  return reach(-1.0, distance_m - kNear) + reach(1.0, kFar - distance_m);
}

std::vector<double> depth_sample(double distance_m) {
  constexpr int kCount = 2000;
  std::vector<double> sample;
  sample.reserve(kCount);
  for (int k = 0; k < kCount; ++k) {
    const double turns = k * (std::numbers::phi - 1.0);
    sample.push_back(distance_m * (1.0 + 0.1 * (turns - std::floor(turns))));
  }
  return sample;
}

DepthPlanes::DepthPlanes(std::shared_ptr<globe::gl::Context> context, DepthScheme scheme, int width,
                         int height)
    : context_(std::move(context)), scheme_(scheme), array_(globe::gl::VertexArray::create()) {
  globe::gl::ProgramSources sources;
  sources.files = {"accuracy/depth.vert", "accuracy/depth.frag"};
  if (scheme == DepthScheme::kLogarithmic) sources.defines = {"LOGARITHMIC"};
  program_ = globe::gl::Program(sources);
  globe::gl::FramebufferFormat format;
  if (scheme == DepthScheme::kStandard24) format.depth = GL_DEPTH_COMPONENT24;
  target_ = globe::gl::Framebuffer(width, height, format);
}

void DepthPlanes::draw(const std::vector<double>& distances_m) const {
  const bool reversed = scheme_ == DepthScheme::kReversedFloat;
  target_.bind();
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(reversed ? GL_GREATER : GL_LESS);
  glDisable(GL_CULL_FACE);
  target_.clear_depth(reversed ? 0.0f : 1.0f);
  array_.bind();
  program_.use();
  program_.set(0, depth_row(scheme_));
  if (scheme_ == DepthScheme::kLogarithmic) program_.set(3, log_far());
  for (std::size_t k = 0; k < distances_m.size(); ++k) {
    program_.set(1, static_cast<float>(distances_m[k]));
    program_.set(2, static_cast<float>(k) / 255.0f);
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
}

int DepthPlanes::shown(const std::vector<double>& distances_m) const {
  draw(distances_m);
  const std::vector<std::uint8_t> picture = target_.read_rgba8();
  const std::size_t middle =
      static_cast<std::size_t>(target_.height() / 2) * static_cast<std::size_t>(target_.width()) +
      static_cast<std::size_t>(target_.width() / 2);
  return picture[4 * middle];
}

double DepthPlanes::draw_ms(const std::vector<double>& distances_m) const {
  glFinish();
  const auto begin = std::chrono::steady_clock::now();
  draw(distances_m);
  glFinish();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace app::accuracy
