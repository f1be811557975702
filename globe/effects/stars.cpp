#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec4.hpp>
#include <numbers>
#include <vector>

#include "globe/effects/bright_stars.h"
#include "globe/effects/entry.h"
#include "globe/gl/buffer.h"
#include "globe/gl/program.h"
#include "globe/gl/vertex_array.h"
#include "globe/render/effect_shaders.h"

namespace globe::effects {
namespace {

constexpr double kBrightSun = -1.0, kDarkSun = -7.0;      ///< degrees: stars come out as it goes down
constexpr double kThinAir = 20'000.0, kSpace = 90'000.0;  ///< metres: by day they come out going up
constexpr float kRadius = 3.0f;                           ///< pixels, of a star's image
constexpr float kFirstMagnitude = 1.6f;  ///< light in the middle of the image of a star of magnitude 1

struct StarParameters {
  double faintest = 5.0;    ///< magnitude
  double brightness = 1.0;  ///< factor
};

StarParameters read_stars(scene::Fields& fields) {
  return {fields.number("faintest", {-2.0, 5.0}).value_or(5.0),
          fields.number("brightness", {0.0, 1e4}).value_or(1.0)};
}

/// Mirrors the attributes of shaders/effects/stars.vert.
struct StarVertex {
  glm::vec4 direction_and_light;
  glm::vec3 color;
};

/// Light of a black body of a temperature (kelvin) in red, green and blue, the brightest 1: Planck's law at
/// 610, 550 and 465 nm against the same of 6504 K, which is white (sRGB).
glm::vec3 black_body(double kelvin) {
  constexpr double kSecondRadiation = 1.4388e-2;  // metre kelvin
  const auto planck = [](double metres, double t) {
    return 1.0 / std::expm1(kSecondRadiation / (metres * t));
  };
  glm::vec3 color(0.0f);
  const double waves[3] = {610e-9, 550e-9, 465e-9};
  for (int c = 0; c < 3; ++c)
    color[c] = static_cast<float>(planck(waves[c], kelvin) / planck(waves[c], 6504.0));
  return color / std::max({color.r, color.g, color.b});
}

/// Temperature of a star by its color index (Ballesteros 2012, equation 14), kelvin.
double temperature(double b_minus_v) {
  return 4600.0 * (1.0 / (0.92 * b_minus_v + 1.7) + 1.0 / (0.92 * b_minus_v + 0.62));
}

StarVertex vertex_of(const BrightStar& star) {
  const double ra = star.right_ascension_deg * std::numbers::pi / 180.0;
  const double dec = star.declination_deg * std::numbers::pi / 180.0;
  const auto light = kFirstMagnitude * std::pow(10.0, -0.4 * (static_cast<double>(star.magnitude) - 1.0));
  return {
      glm::vec4(glm::dvec4(std::cos(dec) * std::cos(ra), std::cos(dec) * std::sin(ra), std::sin(dec), light)),
      black_body(temperature(static_cast<double>(star.b_minus_v)))};
}

/// The stars up to magnitude 5 where they stand, as bright as an eye used to the dark sees them: by day the
/// air hides them.
class Stars final : public render::Effect {
 public:
  Stars(const StarParameters& parameters, const planet::Surface& surface)
      : parameters_(parameters), air_(render::has_air(surface.info())) {}

  render::Stage stage() const override { return render::Stage::kHeavens; }

  render::Verdict judge(const render::EffectView& view) const override {
    if (visible(view) <= 0.0) return {false, "the sky is too bright"};
    return {true, "the sky is dark"};
  }

  void compile(const render::EffectHost& host) override {
    gl::ProgramSources sources;
    sources.files = {"effects/stars.vert", "effects/stars.frag"};
    sources.defines = host.shaders.defines();
    sources.reader = host.shaders.reader();
    program_ = gl::Program(sources);
  }

  void prepare(const render::EffectView& /*view*/, const render::Bindings& /*bindings*/) override {
    if (count_ > 0) return;
    std::vector<StarVertex> vertices;
    for (const BrightStar& star : bright_stars()) {
      if (static_cast<double>(star.magnitude) <= parameters_.faintest) vertices.push_back(vertex_of(star));
    }
    count_ = static_cast<int>(vertices.size());
    if (count_ == 0) return;
    vertices_ = gl::Buffer::of(vertices);
    array_ = gl::VertexArray::create();
    array_.set_vertices(0, vertices_, 0, sizeof(StarVertex), 1);
    array_.set_attribute(0, {0, 4, GL_FLOAT, 0, gl::Attribute::Kind::kFloat});
    array_.set_attribute(0, {1, 3, GL_FLOAT, offsetof(StarVertex, color), gl::Attribute::Kind::kFloat});
  }

  void draw(const render::EffectView& view) override {
    if (count_ == 0) return;
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    array_.bind();
    program_.use();
    program_.set(0, glm::mat3(view.instant.ecef_from_celestial));
    program_.set(1, glm::vec4(2.0f / static_cast<float>(view.target.width()),
                              2.0f / static_cast<float>(view.target.height()), kRadius,
                              static_cast<float>(parameters_.brightness * visible(view))));
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count_);
  }

  std::size_t gpu_bytes() const override { return vertices_.size(); }

 private:
  /// How much of the stars is seen, 0 to 1.
  double visible(const render::EffectView& view) const {
    if (!air_) return 1.0;
    const double altitude_deg =
        std::asin(std::clamp(glm::dot(glm::normalize(view.camera.position), view.sun), -1.0, 1.0)) * 180.0 /
        std::numbers::pi;
    const double night = glm::smoothstep(-kBrightSun, -kDarkSun, -altitude_deg);
    const double outside = glm::smoothstep(kThinAir, kSpace, view.height_m);
    return std::max(night, outside);
  }

  StarParameters parameters_;
  bool air_;
  gl::Program program_;
  gl::Buffer vertices_;
  gl::VertexArray array_;
  int count_ = 0;
};

}  // namespace

EffectEntry stars() { return entry_of<StarParameters, Stars, read_stars>("stars"); }

}  // namespace globe::effects
