// The shaders' own functions, compiled as C++, against closed forms and integrals, and on the GPU against the
// CPU.

#include <glm/glm.hpp>
#include <random>

#include "globe/clipmap/morph.h"
#include "globe/clipmap/torus.h"
#include "globe/gl/buffer.h"
#include "tests/hard/table.h"
#include "tests/render/gl_fixture.h"

namespace {
namespace shader {
using namespace glm;
#define OUT(type) type&
#include "shaders/lib/atmosphere.glsl"
#include "shaders/lib/clipmap.glsl"
#include "shaders/lib/sky_map.glsl"
#include "shaders/lib/tone.glsl"
#undef OUT

// Used by the shaders alone.
[[maybe_unused]] const auto kUnused = std::make_tuple(&haze, &light_before, &sky_light);
}  // namespace shader
}  // namespace

namespace {

constexpr float kGround = 6371.0f;

TEST(ShaderLibrary, HexLengthAndMorphFactorAreTheClipmapsOwn) {
  std::mt19937 random(1);
  const auto settings = globe::clipmap::Settings::for_detail(64);
  const auto band = globe::clipmap::morph_band(settings);
  for (int k = 0; k < 100000; ++k) {
    const glm::ivec2 p{static_cast<int>(random() % 200001) - 100000,
                       static_cast<int>(random() % 200001) - 100000};
    const int length = shader::hex_length(p);
    ASSERT_EQ(length, globe::planet::hex_length(p.x, p.y));
    ASSERT_EQ(shader::morph_factor(length, band.begin, band.end), globe::clipmap::morph_factor(band, length));
  }
}

TEST(ShaderLibrary, ExactMixIsExactAtBothEndsAndBetweenThemElsewhere) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> value(-1e5f, 1e5f), unit(0.0f, 1.0f);
  int mix_fails = 0;
  for (int k = 0; k < 100000; ++k) {
    const float a = value(random), b = value(random), t = unit(random);
    ASSERT_EQ(shader::exact_mix(a, b, 0.0f), a);
    ASSERT_EQ(shader::exact_mix(a, b, 1.0f), b);
    ASSERT_NEAR(shader::exact_mix(a, b, t), a + (b - a) * double(t), 0.05);
    mix_fails += a + (b - a) * 1.0f == b ? 0 : 1;
  }
  hard::report("mix", "negative control: a + (b - a) at 1 is not b, of 100000", "> 0",
               std::to_string(mix_fails));
  EXPECT_GT(mix_fails, 0);
}

TEST(ShaderLibrary, ShadingTurnsOverInsideTheMorphBand) {
  EXPECT_EQ(shader::shading_share(0.0f), 0.0f);
  EXPECT_EQ(shader::shading_share(0.5f), 0.0f);
  EXPECT_EQ(shader::shading_share(0.625f), 0.5f);
  EXPECT_EQ(shader::shading_share(0.75f), 1.0f);
  EXPECT_EQ(shader::shading_share(1.0f), 1.0f);
}

/// A fit's error, in shares of white: less than a step of eight bits.
constexpr double kToneError = 0.0035;

double srgb_encoded(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055; }

TEST(ShaderLibrary, ToneCurveIsTheFilmicOneInSrgb) {
  double worst = 0;
  float before = -1.0f;
  for (double x = 1e-7; x < 1e4; x *= 1.003) {
    const double filmic = std::min((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), 1.0);
    const float seen =
        std::clamp(shader::tone_mapped(glm::vec3(static_cast<float>(x))).x, 0.0f, 1.0f);  // as bytes are
    worst = std::max(worst, std::abs(double(seen) - srgb_encoded(filmic)));
    if (x < 600.0) {
      ASSERT_GE(seen, before) << x;
    }
    before = seen;
  }
  EXPECT_EQ(shader::tone_mapped(glm::vec3(0.0f)), glm::vec3(0.0f));
  hard::report("tone", "fitted tone curve against its formulas, shares of white", "0.0035",
               hard::figure(worst));
  EXPECT_LE(worst, kToneError);
}

TEST(ShaderLibrary, TorusTexelsWrapOnceInBothDirections) {
  for (int size : {51, 147}) {
    for (int origin = 0; origin < size; ++origin) {
      for (int node = 0; node < size; ++node) {
        ASSERT_EQ(shader::torus_texel(glm::ivec2(node, 0), glm::ivec2(origin, origin), size),
                  glm::ivec2((node + origin) % size, origin));
      }
    }
  }
}

TEST(ShaderLibrary, BrickTexelsAreThoseOfTheTorus) {
  std::mt19937 random(4);
  for (const int side : {17, 75}) {
    const auto torus = globe::clipmap::Torus::hexagon(side);
    const glm::ivec3 brick(torus.width, torus.height, torus.shift);
    for (int k = 0; k < 200000; ++k) {
      const glm::ivec2 first{static_cast<int>(random() % 100000) - 50000,
                             static_cast<int>(random() % 100000) - 50000};
      const glm::ivec2 node{static_cast<int>(random() % static_cast<unsigned>(2 * side + 1)),
                            static_cast<int>(random() % static_cast<unsigned>(2 * side + 1))};
      ASSERT_EQ(shader::brick_texel(node, torus.texel(first.x, first.y), brick),
                torus.texel(first.x + node.x, first.y + node.y));
    }
  }
}

TEST(ShaderLibrary, SkyMapMappingsAndTheirInversesComposeToTheIdentity) {
  for (const float eye :
       {kGround + 0.002f, kGround + 10.0f, kGround + 79.0f, kGround + 400.0f, kGround + 40000.0f}) {
    const glm::vec2 bounds = shader::sky_bounds(eye, kGround, kGround + 80.0f);
    ASSERT_LT(bounds.x, bounds.y);
    EXPECT_EQ(shader::sky_row(bounds.x, bounds), 0.0f);
    EXPECT_EQ(shader::sky_row(bounds.y, bounds), 1.0f);
    for (float x = 0.0f; x <= 1.0f; x += 0.01f) {
      // the row is a square root: near the horizon the rounding of a cosine is that of a row, enlarged
      const float tolerance = 1e-5f + 1e-7f / ((bounds.y - bounds.x) * std::max(x, 0.01f));
      EXPECT_NEAR(shader::sky_row(shader::cos_zenith_of_row(x, bounds), bounds), x, tolerance) << eye;
      EXPECT_NEAR(shader::sky_column(shader::cos_azimuth_of_column(x)), x, 1e-6f);
    }
  }
}

/// Share of sunlight by adding the air up along the ray.
glm::dvec3 integrated_transmittance(double h, double cos_sun) {
  const double from = kGround + h, top = kGround + 120.0;
  const double length = -from * cos_sun + std::sqrt(from * from * (cos_sun * cos_sun - 1.0) + top * top);
  double rayleigh = 0, mie = 0;
  constexpr int kSteps = 20000;
  for (int k = 0; k < kSteps; ++k) {
    const double s = length * std::pow((k + 0.5) / kSteps, 2.0),
                 ds = 2.0 * length * (k + 0.5) / kSteps / kSteps;
    const double height = std::sqrt(from * from + s * s + 2.0 * from * s * cos_sun) - kGround;
    rayleigh += std::exp(-height / double(shader::kRayleighHeight)) * ds;
    mie += std::exp(-height / double(shader::kMieHeight)) * ds;
  }
  return glm::exp(-(glm::dvec3(shader::kRayleigh) * rayleigh + double(shader::kMieExtinction) * mie));
}

/// What the approximation of the Chapman function costs; sought at every height and angle above the horizon.
constexpr double kTransmittanceError = 0.06;

TEST(ShaderLibrary, SunTransmittanceIsNearTheIntegral) {
  double worst = 0;
  for (const double h : {0.0, 0.5, 2.0, 8.0, 20.0}) {
    const double horizon = -std::sqrt(1.0 - std::pow(kGround / (kGround + h), 2.0));
    for (double c = horizon + 1e-4; c <= 1.0; c += 0.01) {
      const glm::vec3 seen = shader::sun_transmittance(float(h), float(c), kGround);
      const glm::dvec3 truth = integrated_transmittance(h, c);
      for (int k = 0; k < 3; ++k) worst = std::max(worst, std::abs(double(seen[k]) - truth[k]));
    }
  }
  hard::report("air", "sun_transmittance against integration, share of sunlight", "0.06",
               hard::figure(worst));
  EXPECT_LE(worst, kTransmittanceError);
}

TEST(ShaderLibrary, NoSunlightPassesThroughThePlanet) {
  for (const float h : {0.0f, 2.0f, 9.0f}) {
    for (float c = -1.0f; c < -0.2f; c += 0.001f) {
      const glm::vec3 seen = shader::sun_transmittance(h, c, kGround);
      ASSERT_LT(std::max({seen.x, seen.y, seen.z}), 1e-6f) << h << " km, cosine " << c;
    }
  }
}

TEST(ShaderLibrary, MieLightAddsToTheSkyAndNeverMoreThanItsRedTells) {
  const glm::vec4 sky(0.1f, 0.2f, 0.4f, 0.05f);
  const glm::vec3 without = shader::with_mie(glm::vec4(0.1f, 0.2f, 0.4f, 0.0f), 0.9f);
  EXPECT_EQ(without, glm::vec3(0.1f, 0.2f, 0.4f));
  const glm::vec3 light = shader::with_mie(sky, 0.9f);
  EXPECT_NEAR(light.x - 0.1f, 0.05f * shader::mie_phase(0.9f), 1e-6f);
  EXPECT_GT(light.z, 0.4f);
  // Where next to no light is left the red's share is bounded.
  EXPECT_LT(shader::with_mie(glm::vec4(1e-9f, 1e-9f, 1e-9f, 0.05f), 0.9f).x, 1e-7f);
}

TEST_F(GlTest, ShaderLibraryGivesTheSameOnTheGpu) {
  const std::string program =
      "#define OUT(type) out type\n"
      "#include \"lib/clipmap.glsl\"\n#include \"lib/atmosphere.glsl\"\n#include \"lib/sky_map.glsl\"\n"
      "layout(local_size_x = 64) in;\n"
      "layout(std430, binding = 0) readonly buffer In { vec4 values[]; };\n"
      "layout(std430, binding = 1) writeonly buffer Out { vec4 results[]; };\n"
      "void main() {\n"
      "  uint k = gl_GlobalInvocationID.x;\n"
      "  vec4 v = values[k];\n"
      "  vec2 bounds = sky_bounds(6371.0 + v.x, 6371.0, 6451.0);\n"
      "  results[2 * k] = vec4(sun_transmittance(v.x * 0.5, v.y, 6371.0), exact_mix(v.x, v.z, v.w));\n"
      "  results[2 * k + 1] = vec4(sky_row(v.y, bounds), cos_zenith_of_row(v.w, bounds),\n"
      "      morph_factor(int(v.z * 1000.0), 100, 7000), float(hex_length(ivec2(v.xz * 100.0))));\n"
      "}\n";
  globe::gl::ProgramSources sources;
  sources.files = {"probe.comp"};
  sources.reader = [&](const std::string& name) -> std::optional<std::string> {
    return name == "probe.comp" ? program : globe::gl::read_shader(name);
  };
  constexpr std::size_t kCount = 4096;
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<glm::vec4> values(kCount);
  for (glm::vec4& v : values)
    v = {20.0f * unit(random), 1.1f * unit(random) - 0.1f, 10.0f * unit(random), unit(random)};
  const auto in = globe::gl::Buffer::of(values);
  const globe::gl::Buffer out(2 * kCount * sizeof(glm::vec4));
  in.bind_base(GL_SHADER_STORAGE_BUFFER, 0);
  out.bind_base(GL_SHADER_STORAGE_BUFFER, 1);
  const globe::gl::Program probe(sources);
  probe.use();
  glDispatchCompute(kCount / 64, 1, 1);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  const auto results = out.read<glm::vec4>(0, 2 * kCount);
  float worst = 0;
  for (std::size_t k = 0; k < kCount; ++k) {
    const glm::vec4& v = values[k];
    const glm::vec2 bounds = shader::sky_bounds(6371.0f + v.x, 6371.0f, 6451.0f);
    const glm::vec4 first(shader::sun_transmittance(v.x * 0.5f, v.y, 6371.0f),
                          shader::exact_mix(v.x, v.z, v.w));
    const glm::vec4 second(shader::sky_row(v.y, bounds), shader::cos_zenith_of_row(v.w, bounds),
                           shader::morph_factor(int(v.z * 1000.0f), 100, 7000),
                           float(shader::hex_length(glm::ivec2(int(v.x * 100.0f), int(v.z * 100.0f)))));
    for (int c = 0; c < 4; ++c) {
      worst = std::max(
          {worst, std::abs(first[c] - results[2 * k][c]), std::abs(second[c] - results[2 * k + 1][c])});
    }
  }
  hard::report("shaders", "library functions on the GPU against the CPU, 4096 inputs", "1e-5",
               hard::figure(double(worst)));
  EXPECT_LE(worst, 1e-5f);
}

}  // namespace
