#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec4.hpp>
#include <string>

#include "globe/effects/entry.h"
#include "globe/effects/uniform_block.h"
#include "globe/effects/waves.h"
#include "globe/gl/buffer.h"
#include "globe/gl/program.h"
#include "globe/render/effect_program.h"
#include "globe/render/effect_shaders.h"
#include "globe/render/patch_drawer.h"

namespace globe::effects {
namespace {

constexpr std::size_t kMostWaves = 40;
constexpr int kFinest = 26;         ///< level of the floor that waves are shallow over
constexpr double kUsualWind = 7.0;  ///< metres a second
/// Of pure sea water, per metre, at 620, 550 and 450 nm (Smith and Baker 1981, "Optical properties of the
/// clearest natural waters").
constexpr glm::vec3 kPureWater{0.31f, 0.065f, 0.020f};

struct SeaParameters {
  geo::Geodetic reference{};
  double wind_speed = kUsualWind;
  std::vector<Wave> waves;
  glm::vec3 color{0.0f};  ///< of deep water, albedo, linear
  double clarity_m = 0;   ///< depth at which a white disc is lost to sight
  bool foam = true;
};

double bearing(scene::Fields& fields, const std::string& key, double otherwise) {
  return fields.angle_deg(key, {-360.0, 360.0}).value_or(otherwise);
}

Wave read_wave(scene::Fields& fields, double wind_from_deg) {
  Wave wave;
  wave.amplitude_m = fields.required("amplitude", fields.length_m("amplitude", {0.0, planet::kHighestWave}),
                                     "say how far it rises above height 0, as amplitude = 0.5");
  const auto length_m = fields.length_m("wavelength", {0.05, 1e5});
  const auto per_second = fields.number("frequency", {0.005, 5.0});
  if (length_m && per_second)
    fields.refuse("frequency", "the wave has a wavelength too, and either follows from the other",
                  "leave one of the two out");
  wave.wavelength_m = per_second ? deep_water_length(*per_second)
                                 : fields.required("wavelength", length_m,
                                                   "give it in metres, or a frequency in waves a second");
  wave.phase = fields.angle_deg("phase").value_or(0.0) * 3.14159265358979323846 / 180.0;
  wave.from_deg = bearing(fields, "from", wind_from_deg);
  fields.finish();
  return wave;
}

SeaParameters read_sea(scene::Fields& fields) {
  SeaParameters sea;
  if (const auto place = fields.place("at")) sea.reference = place->position;
  sea.wind_speed = fields.number("wind_speed", {0.0, 25.0}).value_or(kUsualWind);
  const double from_deg = bearing(fields, "wind_from", 225.0);
  if (fields.has("waves")) {
    for (scene::Fields& wave : fields.tables("waves")) sea.waves.push_back(read_wave(wave, from_deg));
  } else {
    sea.waves = wind_waves(sea.wind_speed, from_deg);
  }
  if (sea.waves.size() > kMostWaves)
    fields.refuse("waves", "there are more than " + std::to_string(kMostWaves), "leave the smallest out");
  double sum = 0.0;
  for (const Wave& wave : sea.waves) sum += wave.amplitude_m;
  if (sum > planet::kHighestWave)
    fields.refuse("waves", "together they rise by more than 40 m", "give them smaller amplitudes");
  sea.color = fields.light("color").value_or(glm::vec3(0.008f, 0.033f, 0.072f));
  sea.clarity_m = fields.length_m("clarity", {0.1, 80.0}).value_or(30.0);
  sea.foam = fields.flag("foam").value_or(true);
  return sea;
}

/// Mirrors `Sea` in shaders/effects/sea_block.glsl (std140).
struct SeaBlock {
  glm::vec4 level{0.0f};
  glm::vec4 color{0.0f};
  glm::vec4 dimming{0.0f};
  std::array<glm::vec4, kMostWaves> along{};
  std::array<glm::vec4, kMostWaves> form{};
};

/// What is lost of light a metre, by the depth at which a white disc is lost to sight: 1.7 over it (Poole and
/// Atkins 1929), more of the colours that water itself takes.
glm::vec3 dimming_of(double clarity_m) {
  const auto murk = static_cast<float>(std::max(1.7 / clarity_m - 0.035, 0.0));
  return kPureWater + murk * glm::vec3(0.9f, 0.8f, 1.0f);
}

/// How steep the crests are that break, so that a wind breaks as many as it does: share of the sea under
/// whitecaps by Monahan and O'Muircheartaigh 1980; slopes taken for Gaussian.
double breaking_steepness(double wind_speed, const std::vector<Wave>& waves) {
  const double share = std::clamp(3.84e-6 * std::pow(wind_speed, 3.41), 1e-6, 0.2);
  std::vector<Wave> long_waves;
  for (const Wave& wave : waves)
    if (wave.wavelength_m > 1.6) long_waves.push_back(wave);
  // Of the Gaussian's upper tail, to a few per cent (Abramowitz and Stegun 26.2.22).
  const double t = std::sqrt(-2.0 * std::log(share));
  const double deviations = t - (2.30753 + 0.27061 * t) / (1.0 + 0.99229 * t + 0.04481 * t * t);
  return deviations * std::sqrt(slope_variance(long_waves));
}

/// A sea at the level of the ellipsoid, with waves: drawn over its floor, the clipmap's patches a second
/// time.
class SeaEffect final : public render::Effect {
 public:
  SeaEffect(const SeaParameters& parameters, const planet::Surface& surface)
      : parameters_(parameters), sea_(surface.ellipsoid(), parameters.reference, parameters.waves) {
    if (!surface.has_bare_floor())
      throw Refused{"the planet has no sea", "leave the effect out, or choose a planet like the Earth"};
    const double rest = slope_variance(parameters.wind_speed) - slope_variance(parameters.waves);
    data_.level = glm::vec4(
        glm::dvec4(static_cast<double>(parameters.waves.size()), sea_.radius_m(), sea_.amplitudes_m(), 0.0));
    data_.color = glm::vec4(parameters.color, static_cast<float>(std::max(rest, 0.003)));
    const double breaking = breaking_steepness(parameters.wind_speed, parameters.waves);
    data_.dimming = glm::vec4(dimming_of(parameters.clarity_m),
                              parameters.foam ? static_cast<float>(std::max(breaking, 1e-3)) : -1.0f);
  }

  render::EffectShader shader() const override {
    render::EffectShader shader;
    shader.file = "effects/sea.glsl";
    shader.dims_light = true;
    shader.defines = {"MAX_WAVES " + std::to_string(kMostWaves)};
    return shader;
  }
  bool moves() const override { return true; }
  render::Stage stage() const override { return render::Stage::kSurface; }

  std::optional<double> water_height_m(const render::EffectView& view) const override {
    const geo::Geodetic place = geo::geodetic_from_ecef(view.surface.ellipsoid(), view.camera.position);
    const glm::dvec3 u = geo::normal_from_degrees(place.lat_deg, place.lon_deg);
    const double depth = -view.surface.mesh_height(view.surface.height_at_hand(u, kFinest));
    if (depth <= 0.0) return std::nullopt;
    const double reach = std::max(2.0 * sea_.amplitudes_m(), 1e-3);
    const double share = std::min(depth / reach, 1.0);
    return sea_.height_m(sea_.foot(view.camera.position), view.instant.time_s) * share * share *
           (3.0 - 2.0 * share);
  }

  render::Verdict judge(const render::EffectView& view) const override {
    if (!view.patches.has_water()) return {false, "no water in view"};
    return {true, is_under_water(view) ? "the eye is under it" : "water is in view"};
  }

  void compile(const render::EffectHost& host) override {
    for (const render::Kind kind : {render::Kind::kPlain, render::Kind::kMorphing, render::Kind::kRim})
      programs_[static_cast<std::size_t>(kind)] = program(kind, host);
  }
  void warm_up() override {
    for (render::EffectProgram& program : programs_) program.for_active(0, render::Serving::kAny);
  }

  void prepare(const render::EffectView& view, const render::Bindings& bindings) override {
    const glm::dvec3 foot = sea_.foot(view.camera.position);
    const std::vector<Wave>& waves = sea_.waves();
    data_.level.w = is_under_water(view) ? 1.0f : 0.0f;
    double rest = 0.0;
    for (std::size_t k = waves.size(); k-- > 0;) {
      const Sea::Local local = sea_.at(k, foot, view.instant.time_s);
      const double number = 2.0 * 3.14159265358979323846 / waves[k].wavelength_m;
      rest += 0.5 * std::pow(waves[k].amplitude_m * number, 2.0);
      data_.along[k] = glm::vec4(glm::dvec4(local.along, number));
      data_.form[k] = glm::vec4(glm::dvec4(waves[k].amplitude_m, local.phase, local.cotangent, rest));
    }
    block_.bind(data_, bindings.block);
  }

  void draw(const render::EffectView& view) override {
    // Its far sides are seen from below only.
    if (!is_under_water(view)) glEnable(GL_CULL_FACE);
    view.host.patches.draw(
        view.patches, view.host.textures, [&](const render::Batch& batch) -> const gl::Program* {
          if (!batch.water) return nullptr;
          return &programs_[static_cast<std::size_t>(batch.look.kind)].for_active(view.active, view.serving);
        });
    glDisable(GL_CULL_FACE);
  }

  std::size_t gpu_bytes() const override { return block_.bytes(); }

 private:
  static bool is_under_water(const render::EffectView& view) {
    return view.water_m && view.height_m < *view.water_m;
  }

  static render::EffectProgram program(render::Kind kind, const render::EffectHost& host) {
    gl::ProgramSources sources;
    sources.files = {"clipmap.vert", "effects/sea.frag"};
    sources.defines = host.textures.defines();
    sources.defines.push_back("MAX_SLOTS " + std::to_string(render::kMaxSlots));
    sources.defines.push_back("HAZE_STEPS " + std::to_string(host.air.haze));
    sources.defines.insert(sources.defines.end(), {"SEA", "SHADE_FINE"});
    if (kind != render::Kind::kPlain)
      sources.defines.insert(sources.defines.end(), {"MORPH", "SHADE_COARSE"});
    if (kind == render::Kind::kRim) sources.defines.emplace_back("RIM");
    return {std::move(sources), host.shaders};
  }

  SeaParameters parameters_;
  Sea sea_;
  SeaBlock data_;
  UniformBlock<SeaBlock> block_;
  std::array<render::EffectProgram, 3> programs_;  ///< by render::Kind
};

}  // namespace

EffectEntry sea() {
  EffectEntry entry = entry_of<SeaParameters, SeaEffect, read_sea>("sea");
  entry.draws_sea = true;
  return entry;
}

}  // namespace globe::effects
