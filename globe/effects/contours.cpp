#include <glm/vec4.hpp>

#include "globe/effects/entry.h"
#include "globe/effects/uniform_block.h"

namespace globe::effects {
namespace {

/// Mirrors `Contours` in shaders/effects/contours.glsl (std140).
struct ContourBlock {
  glm::vec4 color;
  glm::vec4 heights;
};

struct ContourParameters {
  glm::vec3 color;  ///< linear
  double every_m;
  double width_px;
};

ContourParameters read_contours(scene::Fields& fields) {
  return {fields.light("color").value_or(glm::vec3(0.02f, 0.01f, 0.0f)),
          fields.length_m("every", {0.1, 1e5}).value_or(100.0),
          fields.number("width", {0.5, 20.0}).value_or(1.0)};
}

/// Lines of equal height on the ground.
class Contours final : public render::Effect {
 public:
  Contours(const ContourParameters& parameters, const planet::Surface& /*surface*/)
      : parameters_(parameters) {}

  render::EffectShader shader() const override {
    render::EffectShader shader;
    shader.file = "effects/contours.glsl";
    shader.adds_light = true;
    return shader;
  }

  render::Verdict judge(const render::EffectView& view) const override {
    if (view.patches.patches == 0) return {false, "the ground is out of view"};
    // From higher up lines lie closer than a pixel everywhere but on plains.
    if (view.above_ground_m > 5000.0 * parameters_.every_m) return {false, "the lines are too close to see"};
    return {true, "ground is in view"};
  }

  void prepare(const render::EffectView& /*view*/, const render::Bindings& bindings) override {
    block_.bind({glm::vec4(parameters_.color, static_cast<float>(parameters_.width_px)),
                 glm::vec4(static_cast<float>(parameters_.every_m))},
                bindings.block);
  }
  std::size_t gpu_bytes() const override { return block_.bytes(); }

 private:
  ContourParameters parameters_;
  UniformBlock<ContourBlock> block_;
};

}  // namespace

EffectEntry contours() { return entry_of<ContourParameters, Contours, read_contours>("contours"); }

}  // namespace globe::effects
