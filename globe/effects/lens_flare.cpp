#include <epoxy/gl.h>

#include <array>
#include <cmath>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <string>

#include "globe/effects/entry.h"
#include "globe/gl/framebuffer.h"
#include "globe/gl/program.h"
#include "globe/gl/vertex_array.h"

namespace globe::effects {
namespace {

constexpr double kSunRadius = 0.00464;  ///< radians
constexpr float kSunDisc = 60.0f;       ///< its light in shaders/sky.frag, in units of sunlight

/// One image of the sun on the line from it (1) through the middle of the picture (0).
struct Ghost {
  float place;
  float half_size;  ///< in half heights of the picture
  float shape;      ///< 0 disc, 1 ring, 2 glow
  float share;      ///< of the sun's light, per unit of strength
  glm::vec3 tint;
};

constexpr std::array kGhosts{Ghost{1.0f, 0.85f, 2.0f, 0.55f, {1.0f, 0.93f, 0.82f}},
                             Ghost{1.0f, 0.34f, 1.0f, 0.045f, {1.0f, 0.62f, 0.42f}},
                             Ghost{0.55f, 0.055f, 0.0f, 0.10f, {0.55f, 0.75f, 1.0f}},
                             Ghost{0.32f, 0.11f, 0.0f, 0.05f, {0.95f, 0.72f, 0.42f}},
                             Ghost{-0.22f, 0.05f, 0.0f, 0.09f, {0.5f, 1.0f, 0.7f}},
                             Ghost{-0.48f, 0.16f, 0.0f, 0.045f, {0.6f, 0.6f, 1.0f}},
                             Ghost{-0.85f, 0.09f, 0.0f, 0.06f, {1.0f, 0.5f, 0.55f}},
                             Ghost{-1.15f, 0.30f, 1.0f, 0.05f, {0.55f, 0.8f, 1.0f}}};

struct FlareParameters {
  double strength = 1.0;
};

FlareParameters read_lens_flare(scene::Fields& fields) {
  return {fields.number("strength", {0.0, 100.0}).value_or(1.0)};
}

/// Where the sun stands in a picture, [-1, 1] across and up; nothing when it is not in it.
std::optional<glm::dvec2> place_of_sun(const render::EffectView& view) {
  const render::Camera& camera = view.camera;
  const double ahead = glm::dot(view.sun, camera.forward);
  if (ahead <= 0.0) return std::nullopt;
  const glm::dvec2 place(glm::dot(view.sun, camera.right) / (ahead * camera.tan_x()),
                         glm::dot(view.sun, camera.up) / (ahead * camera.tan_y()));
  if (std::abs(place.x) >= 1.0 || std::abs(place.y) >= 1.0) return std::nullopt;
  return place;
}

/// Reflections of the sun in a lens, as bright as what is seen of its disc: none where ground or cloud is
/// before it.
class LensFlare final : public render::Effect {
 public:
  LensFlare(const FlareParameters& parameters, const planet::Surface& /*surface*/)
      : parameters_(parameters) {}

  render::Stage stage() const override { return render::Stage::kLens; }
  int passes() const override { return 2; }

  render::Verdict judge(const render::EffectView& view) const override {
    if (!place_of_sun(view)) return {false, "the sun is out of the picture"};
    return {true, "the sun is in the picture"};
  }

  void compile(const render::EffectHost& /*host*/) override {
    gl::ProgramSources seen;
    seen.files = {"wide_view.vert", "effects/seen_sun.frag"};
    seen_program_ = gl::Program(seen);
    gl::ProgramSources ghosts;
    ghosts.files = {"effects/lens_flare.vert", "effects/lens_flare.frag"};
    ghosts.defines = {"GHOSTS " + std::to_string(kGhosts.size())};
    ghost_program_ = gl::Program(ghosts);
    for (std::size_t k = 0; k < kGhosts.size(); ++k) {
      const Ghost& ghost = kGhosts[k];
      const auto at = static_cast<GLint>(k);
      ghost_program_.set(1 + at, glm::vec4(ghost.place, ghost.half_size, ghost.shape, ghost.share));
      ghost_program_.set(32 + at, ghost.tint);
    }
    array_ = gl::VertexArray::create();
  }

  void prepare(const render::EffectView& /*view*/, const render::Bindings& /*bindings*/) override {
    if (seen_.width() == 0) seen_ = gl::Framebuffer(1, 1, {1, GL_RGBA16F, GL_DEPTH_COMPONENT32F});
  }

  void draw(const render::EffectView& view) override {
    const glm::dvec2 place = place_of_sun(view).value_or(glm::dvec2(0.0));
    const gl::Framebuffer& picture = view.target;
    picture.resolve();
    seen_.bind();
    glDisable(GL_DEPTH_TEST);
    array_.bind();
    picture.color().bind(0);
    picture.depth().bind(1);
    seen_program_.use();
    const double radius = 0.5 * picture.height() * kSunRadius / view.camera.tan_y();
    seen_program_.set(0, glm::vec4(glm::dvec4((place.x * 0.5 + 0.5) * picture.width(),
                                              (place.y * 0.5 + 0.5) * picture.height(), radius,
                                              static_cast<double>(kSunDisc * view.block.sun.w))));
    glDrawArrays(GL_TRIANGLES, 0, 3);

    picture.bind();
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    seen_.color().bind(0);
    ghost_program_.use();
    ghost_program_.set(0, glm::vec4(glm::dvec4(place, view.camera.aspect, parameters_.strength)));
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(kGhosts.size()));
    glEnable(GL_DEPTH_TEST);
  }

  std::size_t gpu_bytes() const override {
    return seen_.width() == 0 ? 0 : seen_.color().bytes() + seen_.depth().bytes();
  }

 private:
  FlareParameters parameters_;
  gl::Program seen_program_, ghost_program_;
  gl::VertexArray array_;
  gl::Framebuffer seen_;
};

}  // namespace

EffectEntry lens_flare() { return entry_of<FlareParameters, LensFlare, read_lens_flare>("lens_flare"); }

}  // namespace globe::effects
