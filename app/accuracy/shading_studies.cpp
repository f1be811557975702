#include <epoxy/gl.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <numbers>
#include <random>

#include "app/accuracy/study.h"
#include "globe/clipmap/lighting.h"
#include "globe/gl/context.h"
#include "globe/gl/framebuffer.h"
#include "globe/gl/program.h"
#include "globe/gl/vertex_array.h"
#include "globe/planet/grid.h"
#include "globe/render/tone.h"

namespace app::accuracy {
namespace {

using glm::dvec3;

constexpr double kSteps = 255.0;
const glm::vec3 kSunlight(1.6f), kSkylight(0.175f, 0.23f, 0.32f);  ///< of a day, times 1 / pi

/// Narkowicz 2015 and IEC 61966-2-1, which shaders/lib/tone.glsl stands for.
double exact_tone(double light) {
  const double film =
      std::clamp(light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14), 0.0, 1.0);
  return film <= 0.0031308 ? 12.92 * film : 1.055 * std::pow(film, 1.0 / 2.4) - 0.055;
}

/// A screen filled through a tone curve.
class ToneScreen {
 public:
  ToneScreen(std::shared_ptr<globe::gl::Context> context, bool exact)
      : context_(std::move(context)), array_(globe::gl::VertexArray::create()) {
    globe::gl::ProgramSources sources;
    sources.files = {"accuracy/screen.vert", "accuracy/tone.frag"};
    if (exact) sources.defines = {"EXACT"};
    program_ = globe::gl::Program(sources);
  }

  double draw_ms() const {
    target_.bind();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    array_.bind();
    program_.use();
    program_.set(0, glm::vec2(target_.width(), target_.height()));
    glFinish();
    const auto begin = std::chrono::steady_clock::now();
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glFinish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  }

 private:
  std::shared_ptr<globe::gl::Context> context_;
  globe::gl::Program program_;
  globe::gl::VertexArray array_;
  globe::gl::Framebuffer target_{1280, 720};
};

Study tone_study(const std::shared_ptr<globe::gl::Context>& context) {
  constexpr int kLights = 20000;
  Study study{"shading.tone",
              "From light to the screen",
              "",
              "Narkowicz' film curve and the sRGB encoding, in double",
              std::to_string(kLights) + " lights from 1e-6 to 100 times white, evenly by their logarithm",
              "steps of 255",
              "ms a screen of 1280x720",
              {}};
  for (const bool exact : {false, true}) {
    ErrorSum sum;
    for (int k = 0; k < kLights; ++k) {
      const auto light = static_cast<float>(std::pow(10.0, -6.0 + 8.0 * k / (kLights - 1)));
      const double shown =
          exact ? exact_tone(static_cast<double>(light))
                : std::clamp(static_cast<double>(globe::render::tone_mapped(glm::vec3(light)).x), 0.0, 1.0);
      sum.add(kSteps * (shown - exact_tone(static_cast<double>(light))), [&] {
        char text[32];
        std::snprintf(text, sizeof text, "light %.4g", static_cast<double>(light));
        return std::string(text);
      });
    }
    const auto screen = std::make_shared<const ToneScreen>(context, exact);
    study.settings.push_back({exact ? "both formulas" : "one rational function", sum.figure(),
                              [screen] { return screen->draw_ms(); }, !exact});
  }
  return study;
}

/// A patch of ground of all colours and slopes on one diamond.
struct ShadedGround {
  static constexpr int kLevel = 14;
  static constexpr int kSide = 65;

  int d;
  globe::clipmap::NodeRect nodes;
  std::vector<dvec3> albedo;
  std::vector<glm::dvec2> slope;  ///< of the unit normal, along the diamond's shading frame
  globe::clipmap::ShadingNodes stored;

  ShadedGround(int diamond, int i, int j, std::mt19937_64& random)
      : d(diamond), nodes{i, i + kSide - 1, j, j + kSide - 1} {
    stored.resize(nodes);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (std::size_t k = 0; k < stored.albedo.size(); ++k) {
      albedo.emplace_back(0.02 + 0.8 * unit(random), 0.02 + 0.8 * unit(random), 0.02 + 0.8 * unit(random));
      const double tilt = std::sin(70.0 * std::numbers::pi / 180.0 * unit(random)),
                   turn = 2.0 * std::numbers::pi * unit(random);
      slope.emplace_back(tilt * std::cos(turn), tilt * std::sin(turn));
      stored.albedo[k] = glm::u8vec4(glm::round(glm::sqrt(albedo[k]) * 255.0), 0);
      stored.normal[k] = glm::u16vec2(glm::round((slope[k] * 0.5 + 0.5) * 65534.0));
    }
  }
};

struct Lit {
  dvec3 albedo;
  double up, facing;

  dvec3 shown() const {
    dvec3 result;
    for (int c = 0; c < 3; ++c)
      result[c] = exact_tone(albedo[c] * (static_cast<double>(kSunlight[c]) * std::max(facing, 0.0) +
                                          static_cast<double>(kSkylight[c]) * (0.55 + 0.45 * up)));
    return result;
  }
};

/// The sun's parts exactly, in double.
Lit lit_exactly(const ShadedGround& ground, std::size_t k, const dvec3& sun) {
  const int i = ground.nodes.i0 + static_cast<int>(k) % ShadedGround::kSide,
            j = ground.nodes.j0 + static_cast<int>(k) / ShadedGround::kSide;
  const dvec3 u = globe::planet::node_direction({ground.d, ShadedGround::kLevel, i, j});
  const dvec3 axis = globe::clipmap::shading_axis(ground.d);
  const dvec3 t1 = glm::normalize(axis - u * glm::dot(u, axis)), t2 = glm::cross(u, t1);
  const glm::dvec2& slope = ground.slope[k];
  const double up = std::sqrt(std::max(1.0 - glm::dot(slope, slope), 0.0));
  return {ground.albedo[k], up, glm::dot(sun, u * up + t1 * slope.x + t2 * slope.y)};
}

dvec3 shown(const glm::vec4& texel) {
  const glm::vec3 light = globe::clipmap::light_of(texel, kSunlight, kSkylight);
  return {exact_tone(static_cast<double>(light.x)), exact_tone(static_cast<double>(light.y)),
          exact_tone(static_cast<double>(light.z))};
}

glm::vec4 texel_of(const Lit& lit) {
  return globe::clipmap::lit_texel(glm::vec3(lit.albedo), static_cast<float>(lit.up),
                                   static_cast<float>(lit.facing));
}

glm::vec4 rounded(const glm::vec4& texel, float steps) { return glm::round(texel * steps) / steps; }

Study texel_study() {
  Study study{"shading.texels",
              "ShadedGround lit before it is drawn",
              "",
              "albedo, slope and sun as they are, in double",
              "33,800 nodes of all slopes to 70 degrees on eight patches, from dawn to noon; shown by the "
              "screen's curve",
              "steps of 255",
              "bytes a texel",
              {}};
  std::mt19937_64 random(51);
  std::vector<ShadedGround> patches;
  const int n = globe::planet::nodes_per_side(ShadedGround::kLevel);
  std::uniform_int_distribution<int> node(0, n - ShadedGround::kSide);
  for (int k = 0; k < 8; ++k)
    patches.emplace_back(k % globe::planet::kDiamonds, node(random), node(random), random);
  using Stored = glm::vec4 (*)(const Lit&);
  const std::array<std::tuple<const char*, double, Stored>, 4> ways{
      {{"8 bits, roots", 4.0, nullptr},
       {"8 bits, linear", 4.0,
        [](const Lit& lit) {
          const glm::vec4 texel = texel_of(lit);
          return glm::sqrt(rounded(texel * texel, 255.0f));
        }},
       {"16 bits, roots", 8.0, [](const Lit& lit) { return rounded(texel_of(lit), 65535.0f); }},
       {"half floats", 8.0, [](const Lit& lit) { return glm::unpackHalf(glm::packHalf(texel_of(lit))); }}}};
  for (const auto& [name, bytes, stored] : ways) {
    ErrorSum sum;
    for (std::size_t p = 0; p < patches.size(); ++p) {
      const ShadedGround& ground = patches[p];
      const dvec3 u =
          globe::planet::node_direction({ground.d, ShadedGround::kLevel, ground.nodes.i0, ground.nodes.j0});
      // The sun from 3 to 80 degrees above the horizon there.
      const double high = (3.0 + 11.0 * static_cast<double>(p)) * std::numbers::pi / 180.0;
      const dvec3 aside = glm::normalize(glm::cross(u, dvec3(0.3, 0.5, 0.8)));
      const dvec3 sun = std::sin(high) * u + std::cos(high) * aside;
      const auto drawn = globe::clipmap::lit_nodes({sun, false}, ShadedGround::kLevel, ground.d, ground.nodes,
                                                   ground.nodes, ground.stored);
      for (std::size_t k = 0; k < drawn.size(); ++k) {
        const Lit lit = lit_exactly(ground, k, sun);
        const glm::vec4 texel = stored ? stored(lit) : glm::vec4(drawn[k]) / 255.0f;
        const dvec3 off = kSteps * glm::abs(shown(texel) - lit.shown());
        sum.add(std::max({off.x, off.y, off.z}), [&] {
          char text[80];
          std::snprintf(text, sizeof text, "albedo %.2f %.2f %.2f, slope's cosine %.3f, sun's %.3f",
                        lit.albedo.x, lit.albedo.y, lit.albedo.z, lit.up, lit.facing);
          return std::string(text);
        });
      }
    }
    study.settings.push_back({name, sum.figure(), fixed(bytes), stored == nullptr,
                              stored ? "" : "with normals of 16 bits and the sun every 16 nodes"});
  }
  return study;
}

Study normal_study() {
  Study study{"shading.normals",
              "Slopes of the ground as they are kept to be lit",
              "",
              "the unit normal in double",
              "every tenth of a degree to 85 degrees, every 5 degrees around",
              "degrees",
              "bytes a node",
              {}};
  using Stored = double (*)(double);
  const std::array<std::tuple<const char*, double, Stored>, 3> ways{
      {{"8 bits", 2.0, [](double x) { return std::round((x * 0.5 + 0.5) * 254.0) / 127.0 - 1.0; }},
       {"16 bits", 4.0, [](double x) { return std::round((x * 0.5 + 0.5) * 65534.0) / 32767.0 - 1.0; }},
       {"float", 8.0, [](double x) { return static_cast<double>(static_cast<float>(x)); }}}};
  for (const auto& [name, bytes, stored] : ways) {
    ErrorSum sum;
    for (int tilt = 0; tilt <= 850; ++tilt) {
      for (int turn = 0; turn < 360; turn += 5) {
        const double s = std::sin(tilt * std::numbers::pi / 1800.0), t = turn * std::numbers::pi / 180.0;
        const dvec3 normal(s * std::cos(t), s * std::sin(t), std::sqrt(1.0 - s * s));
        const double x = stored(normal.x), y = stored(normal.y);
        const dvec3 kept(x, y, std::sqrt(std::max(1.0 - x * x - y * y, 0.0)));
        sum.add(std::atan2(glm::length(glm::cross(normal, kept)), glm::dot(normal, kept)) * 180.0 /
                    std::numbers::pi,
                [&] {
                  char text[48];
                  std::snprintf(text, sizeof text, "%.1f degrees steep, toward %d", tilt / 10.0, turn);
                  return std::string(text);
                });
      }
    }
    study.settings.push_back({name, sum.figure(), fixed(bytes), std::string(name) == "16 bits"});
  }
  return study;
}

}  // namespace

std::vector<Study> shading_studies(const Scope& scope) {
  return {tone_study(scope.context), texel_study(), normal_study()};
}

}  // namespace app::accuracy
