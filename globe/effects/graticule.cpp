#include "globe/effects/graticule.h"

#include <cmath>
#include <glm/vec4.hpp>
#include <optional>

#include "globe/base/angles.h"
#include "globe/effects/entry.h"
#include "globe/effects/map_eye.h"
#include "globe/effects/mark_parameters.h"
#include "globe/effects/uniform_block.h"

namespace globe::effects {
namespace {

/// Mirrors `Graticule` in shaders/effects/graticule.glsl (std140).
struct GraticuleBlock {
  MapEye eye;
  glm::vec4 color;
  glm::vec4 lines;
  glm::ivec4 numbers;
};

GraticuleParameters read_graticule(scene::Fields& fields) {
  GraticuleParameters parameters;
  parameters.step_deg = fields.angle_deg("step", {1.0 / 360'000.0, 90.0});
  if (parameters.step_deg && !divides_quarter(*parameters.step_deg))
    fields.refuse("step", "it does not divide 90 degrees", "give a step such as 10, 0.5, or \"1 arcmin\"");
  if (const auto color = fields.color("color")) parameters.color = *color;
  parameters.width_px = fields.number("width", {0.25, 20.0}).value_or(parameters.width_px);
  parameters.opacity = fields.number("opacity", {0.0, 1.0}).value_or(parameters.opacity);
  return parameters;
}

/// Meridians and parallels on whatever surface is drawn.
class Graticule final : public render::Effect {
 public:
  Graticule(const GraticuleParameters& parameters, const planet::Surface& /*surface*/)
      : parameters_(parameters) {}

  render::EffectShader shader() const override {
    render::EffectShader shader;
    shader.file = "effects/graticule.glsl";
    shader.adds_light = true;
    return shader;
  }

  render::Verdict judge(const render::EffectView& view) const override {
    if (view.patches.patches == 0) return {false, "the ground is out of view"};
    return {true, "ground is in view"};
  }

  void prepare(const render::EffectView& view, const render::Bindings& bindings) override {
    const geo::Ellipsoid& ellipsoid = view.surface.ellipsoid();
    const geo::Geodetic eye = geo::geodetic_from_ecef(ellipsoid, view.camera.position);
    const GraticuleSteps steps = parameters_.step_deg
                                     ? fixed_steps(*parameters_.step_deg)
                                     : steps_in_view(ellipsoid, view.camera, eye.h_m - view.above_ground_m);
    const double step = steps.finer_arcsec;
    const double lat = eye.lat_deg * 3600.0 / step, lon = eye.lon_deg * 3600.0 / step;
    const auto ratio = static_cast<long long>(std::llround(steps.step_arcsec / step));
    const auto number = [&](double at) {
      const long long k = std::llround(at) % ratio;
      return static_cast<int>(k < 0 ? k + ratio : k);
    };
    block_.bind(
        {map_eye(ellipsoid, eye), glm::vec4(parameters_.color, static_cast<float>(parameters_.opacity)),
         glm::vec4(glm::dvec4(lon - std::round(lon), lat - std::round(lat), step / 3600.0 * kDegree,
                              parameters_.width_px)),
         glm::ivec4(number(lon), number(lat), static_cast<int>(ratio),
                    static_cast<int>(std::lround(1000.0 * steps.finer_share)))},
        bindings.block);
  }

  std::size_t gpu_bytes() const override { return block_.bytes(); }

 private:
  GraticuleParameters parameters_;
  UniformBlock<GraticuleBlock> block_;
};

}  // namespace

EffectEntry graticule() { return entry_of<GraticuleParameters, Graticule, read_graticule>("graticule"); }

}  // namespace globe::effects
