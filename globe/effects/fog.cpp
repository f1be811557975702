#include <algorithm>
#include <cmath>
#include <glm/vec4.hpp>
#include <numbers>

#include "globe/effects/entry.h"
#include "globe/effects/uniform_block.h"

namespace globe::effects {
namespace {

constexpr double kFogDepth =
    3.912;  ///< optical depth at which a dark thing has 2 % of its contrast left (Koschmieder)
constexpr double kLeastDepth = 1.0 / 512;  ///< that shows in eight bits

struct FogParameters {
  glm::vec3 color;      ///< albedo, linear
  double visibility_m;  ///< at the base
  double base_m;        ///< above the ellipsoid
  double thickness_m;   ///< height in which density falls to 1/e
};

FogParameters read_fog(scene::Fields& fields) {
  return {fields.light("color").value_or(glm::vec3(0.85f, 0.87f, 0.91f)),
          fields.length_m("visibility", {1.0, 1e7}).value_or(5000.0),
          fields.length_m("base", {-1e4, 1e5}).value_or(0.0),
          fields.length_m("thickness", {1.0, 1e5}).value_or(300.0)};
}

/// Mirrors `Fog` in shaders/effects/fog.glsl (std140).
struct FogBlock {
  glm::vec4 color;
  glm::vec4 layer;
};

/// Fog whose density falls exponentially with height, lit by the sun and the sky above it.
class Fog final : public render::Effect {
 public:
  Fog(const FogParameters& parameters, const planet::Surface& surface)
      : parameters_(parameters), radius_m_(surface.ellipsoid().mean_radius()) {}

  render::EffectShader shader() const override {
    render::EffectShader shader;
    shader.file = "effects/fog.glsl";
    shader.is_medium = true;
    return shader;
  }

  render::Verdict judge(const render::EffectView& view) const override {
    const double above_m = view.height_m - parameters_.base_m;
    const double at_eye = extinction() * std::exp(std::min(-above_m / parameters_.thickness_m, 50.0));
    const double level = at_eye * std::sqrt(0.5 * std::numbers::pi * parameters_.thickness_m * radius_m_);
    if (level >= kLeastDepth) return {true, "the eye is in it"};
    if (view.patches.patches == 0) return {false, "the ground is out of view"};
    const double down = extinction() * parameters_.thickness_m;
    if (down < kLeastDepth) return {false, "too thin to see from here"};
    return {true, "it lies over the ground in view"};
  }

  void prepare(const render::EffectView& view, const render::Bindings& bindings) override {
    const FogBlock block{glm::vec4(parameters_.color, static_cast<float>(extinction())),
                         glm::vec4(glm::dvec4(parameters_.base_m, parameters_.thickness_m,
                                              view.height_m - parameters_.base_m, radius_m_))};
    block_.bind(block, bindings.block);
  }

  std::size_t gpu_bytes() const override { return block_.bytes(); }

 private:
  double extinction() const { return kFogDepth / parameters_.visibility_m; }

  FogParameters parameters_;
  double radius_m_;
  UniformBlock<FogBlock> block_;
};

}  // namespace

EffectEntry fog() { return entry_of<FogParameters, Fog, read_fog>("fog"); }

}  // namespace globe::effects
