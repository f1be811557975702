#include <algorithm>
#include <glm/common.hpp>
#include <glm/vec4.hpp>

#include "globe/effects/entry.h"
#include "globe/effects/uniform_block.h"
#include "globe/gl/buffer.h"

namespace globe::effects {
namespace {

constexpr double kMurkDepth = 3.912;  ///< optical depth at which a dark thing has 2 % of its contrast left
/// What water itself takes more of the colours than of the one that it takes least, per metre: at 620, 550
/// and 450 nm (Smith and Baker 1981).
constexpr glm::vec3 kTaken{0.29f, 0.045f, 0.0f};
/// Of daylight, which scattered light joins again, a fourth is lost of what a ray loses (Kirk 1984).
constexpr float kDaylight = 0.25f;

struct UnderwaterParameters {
  glm::vec3 color;  ///< albedo, linear
  double visibility_m;
};

UnderwaterParameters read_underwater(scene::Fields& fields) {
  return {fields.light("color").value_or(glm::vec3(0.014f, 0.080f, 0.105f)),
          fields.length_m("visibility", {0.1, 200.0}).value_or(40.0)};
}

/// Mirrors `Underwater` in shaders/effects/underwater.glsl (std140).
struct UnderwaterBlock {
  glm::vec4 color;
  glm::vec4 extinction;
  glm::vec4 dimming;
};

/// Green-blue water around an eye below the sea's surface, darker the deeper.
class Underwater final : public render::Effect {
 public:
  Underwater(const UnderwaterParameters& parameters, const planet::Surface& surface)
      : parameters_(parameters) {
    if (!surface.has_bare_floor())
      throw Refused{"there is no sea to be under: it needs effects.sea",
                    "add [effects.sea], or leave it out"};
  }

  render::EffectShader shader() const override {
    render::EffectShader shader;
    shader.file = "effects/underwater.glsl";
    shader.is_medium = true;
    return shader;
  }

  render::Verdict judge(const render::EffectView& view) const override {
    if (!view.water_m) return {false, "the eye is over land"};
    if (view.height_m >= *view.water_m) return {false, "the eye is above the water"};
    return {true, "the eye is under water"};
  }

  void prepare(const render::EffectView& view, const render::Bindings& bindings) override {
    const auto murk = static_cast<float>(kMurkDepth / parameters_.visibility_m);
    const double depth = std::max(view.water_m.value_or(0.0) - view.height_m, 0.0);
    const UnderwaterBlock block{glm::vec4(parameters_.color, static_cast<float>(depth)),
                                glm::vec4(kTaken + murk, 0.0f),
                                glm::vec4(0.6f * kTaken + kDaylight * murk, 0.0f)};
    block_.bind(block, bindings.block);
  }

  std::size_t gpu_bytes() const override { return block_.bytes(); }

 private:
  UnderwaterParameters parameters_;
  UniformBlock<UnderwaterBlock> block_;
};

}  // namespace

EffectEntry underwater() { return entry_of<UnderwaterParameters, Underwater, read_underwater>("underwater"); }

}  // namespace globe::effects
