#include <filesystem>
#include <glm/vec4.hpp>

#include "globe/effects/entry.h"
#include "globe/effects/lat_long_image.h"
#include "globe/effects/planet_texture.h"
#include "globe/effects/uniform_block.h"
#include "globe/gl/texture.h"

namespace globe::effects {
namespace {

constexpr double kLeast = 1.0 / 512;  ///< share of the map that shows in eight bits

struct LightmapParameters {
  std::filesystem::path image;
  double strength;  ///< share of the map in the ground's light
};

LightmapParameters read_lightmap(scene::Fields& fields) {
  return {fields.required("image", fields.file("image"), "name a map of the light, twice as wide as high"),
          fields.number("strength", {0.0, 1.0}).value_or(1.0)};
}

/// Mirrors `Lightmap` in shaders/effects/lightmap.glsl (std140).
struct LightmapBlock {
  glm::vec4 map;
};

/// Light of the ground by a map, which stays as it is whatever the level of the triangles: white leaves the
/// sun's and the sky's light as they are, black takes all of it.
class Lightmap final : public render::Effect {
 public:
  Lightmap(const LightmapParameters& parameters, const planet::Surface&)
      : parameters_(parameters), image_(read_lat_long_image(parameters.image)) {}

  render::EffectShader shader() const override {
    render::EffectShader shader;
    shader.file = "effects/lightmap.glsl";
    shader.dims_light = true;
    shader.textures = 1;
    return shader;
  }

  render::Verdict judge(const render::EffectView& view) const override {
    if (parameters_.strength < kLeast) return {false, "too weak to see"};
    if (view.patches.patches == 0) return {false, "the ground is out of view"};
    return {true, "it lies on the ground in view"};
  }

  void prepare(const render::EffectView& view, const render::Bindings& bindings) override {
    if (light_.id() == 0) light_ = planet_texture(image_, GL_SRGB8_ALPHA8);
    const double pixel = 2.0 * view.camera.tan_y() / view.target.height();
    const LightmapBlock block{glm::vec4(glm::dvec4(parameters_.strength, pixel, 0.0, 0.0))};
    block_.bind(block, bindings.block);
    light_.bind(bindings.unit);
  }

  std::size_t gpu_bytes() const override { return block_.bytes() + light_.bytes(); }

 private:
  LightmapParameters parameters_;
  LatLongImage image_;  ///< without its pixels once the texture is made
  UniformBlock<LightmapBlock> block_;
  gl::Texture light_;
};

}  // namespace

EffectEntry lightmap() { return entry_of<LightmapParameters, Lightmap, read_lightmap>("lightmap"); }

}  // namespace globe::effects
