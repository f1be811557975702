#include <algorithm>
#include <cmath>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "globe/base/angles.h"
#include "globe/effects/entry.h"
#include "globe/effects/lat_long_image.h"
#include "globe/effects/planet_texture.h"
#include "globe/effects/uniform_block.h"
#include "globe/gl/buffer.h"
#include "globe/gl/texture.h"

namespace globe::effects {
namespace {

constexpr double kLit = -1.0 * kDegree,
                 kFull = -9.0 * kDegree;  ///< heights of the sun between which they come on

struct NightLightsParameters {
  std::filesystem::path image;
  double intensity;  ///< light of an image's white, as EffectView has it
  double threshold;  ///< of the image's brightness, below which there is no lamp
};

NightLightsParameters read_night_lights(scene::Fields& fields) {
  return {fields.required("image", fields.file("image"), "name a map of the lights, twice as wide as high"),
          fields.number("intensity", {0.0, 100.0}).value_or(1.0),
          fields.number("threshold", {0.0, 0.99}).value_or(0.2)};
}

/// Mirrors `NightLights` in shaders/effects/night_lights.glsl (std140).
struct NightLightsBlock {
  glm::vec4 lamps;
  glm::vec4 view;
};

/// Lamps of towns, where the sun is down.
class NightLights final : public render::Effect {
 public:
  NightLights(const NightLightsParameters& parameters, const planet::Surface&)
      : parameters_(parameters), image_(read_lat_long_image(parameters.image)) {}

  render::EffectShader shader() const override {
    render::EffectShader shader;
    shader.file = "effects/night_lights.glsl";
    shader.adds_light = true;
    shader.textures = 1;
    return shader;
  }

  render::Verdict judge(const render::EffectView& view) const override {
    if (parameters_.intensity == 0.0) return {false, "they give no light"};
    if (view.patches.patches == 0) return {false, "the ground is out of view"};
    // The darkest ground that can be seen lies away from the sun, as far as the horizon.
    const double radius = view.surface.ellipsoid().mean_radius();
    const double to_horizon = std::acos(std::min(radius / (radius + std::max(view.height_m, 0.0)), 1.0));
    const double sun =
        std::asin(std::clamp(glm::dot(glm::normalize(view.camera.position), view.sun), -1.0, 1.0));
    constexpr double kBeyond = 3.0 * kDegree;  // mountains behind the horizon
    if (sun - to_horizon - kBeyond > kLit) return {false, "all ground in view is in the light"};
    return {true, "some ground in view may be in the dark"};
  }

  void prepare(const render::EffectView& view, const render::Bindings& bindings) override {
    if (lamps_.id() == 0) lamps_ = planet_texture(image_, GL_SRGB8_ALPHA8);
    const double pixel = 2.0 * view.camera.tan_y() / view.target.height();
    const NightLightsBlock block{
        glm::vec4(glm::dvec4(parameters_.intensity, parameters_.threshold, std::sin(kLit), std::sin(kFull))),
        glm::vec4(glm::dvec4(pixel, 0.0, 0.0, 0.0))};
    block_.bind(block, bindings.block);
    lamps_.bind(bindings.unit);
  }

  std::size_t gpu_bytes() const override { return block_.bytes() + lamps_.bytes(); }

 private:
  NightLightsParameters parameters_;
  LatLongImage image_;  ///< without its pixels once the texture is made
  UniformBlock<NightLightsBlock> block_;
  gl::Texture lamps_;
};

}  // namespace

EffectEntry night_lights() {
  return entry_of<NightLightsParameters, NightLights, read_night_lights>("night_lights");
}

}  // namespace globe::effects
