#include <algorithm>
#include <glm/vec4.hpp>
#include <optional>
#include <string>

#include "globe/effects/atmosphere_tables.h"
#include "globe/effects/entry.h"
#include "globe/effects/uniform_block.h"
#include "globe/gl/buffer.h"
#include "globe/gl/texture.h"

namespace globe::effects {
namespace {

struct AtmosphereParameters {
  AirModel model;
  AirTableSizes sizes;
  int sky_panels = kSkyPanels;
  int haze_panels = kHazePanels;
};

AtmosphereParameters read_atmosphere(scene::Fields& fields) {
  AtmosphereParameters p;
  const auto km = [&](const char* key, double least_km, double most_km, double otherwise) {
    const auto value = fields.length_m(key, {1e3 * least_km, 1e3 * most_km});
    return value ? 1e-3 * *value : otherwise;
  };
  const auto number = [&](const char* key, double least, double most, double otherwise) {
    return fields.number(key, {least, most}).value_or(otherwise);
  };
  AirModel& air = p.model;
  air.rayleigh *= number("rayleigh", 0.0, 20.0, 1.0);
  air.rayleigh_height_km = km("rayleigh_height", 0.5, 15.0, air.rayleigh_height_km);
  air.turbidity = number("turbidity", 0.0, 50.0, air.turbidity);
  air.mie_height_km = km("mie_height", 0.1, 15.0, air.mie_height_km);
  air.mie_asymmetry = number("mie_asymmetry", 0.0, 0.95, air.mie_asymmetry);
  air.ozone *= number("ozone", 0.0, 20.0, 1.0);
  air.albedo = number("albedo", 0.0, 1.0, air.albedo);
  p.sizes.orders = fields.integer("orders", 1, 50).value_or(p.sizes.orders);
  const auto panels = [&](const char* key, int otherwise) {
    const int samples = fields.integer(key, 4, 256).value_or(4 * otherwise);
    if (samples % 4 != 0)
      fields.refuse(key, "samples come in fours", "write " + std::to_string((samples + 3) / 4 * 4));
    return samples / 4;
  };
  p.sky_panels = panels("sky_samples", p.sky_panels);
  p.haze_panels = panels("haze_samples", p.haze_panels);
  return p;
}

/// Air by precomputed tables in place of the plain one: in the sky, before the ground, on it, and in the
/// light of every other effect.
class Atmosphere final : public render::Effect {
 public:
  Atmosphere(const AtmosphereParameters& parameters, const planet::Surface& surface)
      : parameters_(parameters) {
    if (!render::has_air(surface.info()))
      throw Refused{"the planet has no air", "leave the effect out, or take a planet with air"};
    parameters_.model.ground_km = 1e-3 * surface.ellipsoid().mean_radius();
  }

  render::EffectShader shader() const override {
    render::EffectShader shader;
    shader.textures = 2;
    shader.replaced = {{"lib/atmosphere.glsl", "effects/atmosphere.glsl"},
                       {"lib/sky_map.glsl", "effects/atmosphere_map.glsl"}};
    shader.defines = {"SKY_PANELS " + std::to_string(parameters_.sky_panels),
                      "HAZE_PANELS " + std::to_string(parameters_.haze_panels)};
    return shader;
  }

  render::Verdict judge(const render::EffectView&) const override {
    return {true, "air is between the eye and all there is to see"};
  }

  void compile(const render::EffectHost&) override {
    const AirTables tables = air_tables(parameters_.model, parameters_.sizes);
    transmittance_ = gl::Texture::flat(GL_RGBA32F, tables.transmittance_size.x, tables.transmittance_size.y);
    transmittance_.upload({0, 0, transmittance_.width(), transmittance_.height()},
                          tables.transmittance.data());
    moments_ = gl::Texture::array(GL_RGBA32F, tables.moments_size.x, tables.moments_size.y,
                                  static_cast<int>(tables.moments.size()));
    for (int layer = 0; layer < moments_.layers(); ++layer)
      moments_.upload({0, 0, moments_.width(), moments_.height(), layer},
                      tables.moments[static_cast<std::size_t>(layer)].data());
    for (gl::Texture* texture : {&transmittance_, &moments_}) {
      texture->set_filter(GL_LINEAR, GL_LINEAR);
      texture->set_wrap(GL_CLAMP_TO_EDGE);
    }
    air_ = air_block(parameters_.model);
    air_.sizes = glm::vec4(tables.transmittance_size, tables.moments_size);
  }

  void prepare(const render::EffectView&, const render::Bindings& bindings) override {
    block_.bind(air_, bindings.block);
    transmittance_.bind(bindings.unit);
    moments_.bind(bindings.unit + 1);
  }

  std::size_t gpu_bytes() const override {
    return block_.bytes() + transmittance_.bytes() + moments_.bytes();
  }

 private:
  AtmosphereParameters parameters_;
  AirBlock air_;
  UniformBlock<AirBlock> block_;
  gl::Texture transmittance_, moments_;
};

}  // namespace

EffectEntry atmosphere() { return entry_of<AtmosphereParameters, Atmosphere, read_atmosphere>("atmosphere"); }

}  // namespace globe::effects
