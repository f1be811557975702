#include "globe/planet/appearance.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace globe::planet {
namespace {

using glm::mix;
using glm::vec3;

constexpr vec3 kForest{0.022f, 0.040f, 0.014f};
constexpr vec3 kGrass{0.085f, 0.105f, 0.030f};
constexpr vec3 kSteppe{0.19f, 0.155f, 0.075f};
constexpr vec3 kSand{0.42f, 0.30f, 0.17f};
constexpr vec3 kBeach{0.40f, 0.34f, 0.24f};
constexpr vec3 kTundra{0.115f, 0.100f, 0.058f};
constexpr vec3 kScree{0.20f, 0.175f, 0.145f};
constexpr vec3 kRock{0.145f, 0.128f, 0.112f};
constexpr vec3 kDryRock{0.25f, 0.165f, 0.105f};
constexpr vec3 kSnow{0.80f, 0.83f, 0.87f};
constexpr vec3 kShallows{0.045f, 0.155f, 0.165f};
constexpr vec3 kDeepSea{0.006f, 0.022f, 0.060f};

float step_up(float from, float to, float x) { return glm::smoothstep(from, to, x); }

vec3 water(float height) {
  const float near_shore = std::exp(height / 14.0f);
  const float shelf = std::exp(height / 220.0f);
  return mix(mix(kDeepSea, vec3(0.010f, 0.048f, 0.085f), shelf), kShallows, near_shore);
}

/// Height of the lower limit of lasting snow, metres: Earth's, 5000 in the horse latitudes, 3000 in the Alps,
/// 500 at 75 degrees.
float snow_line(float sine) {
  const float s2 = sine * sine;
  return 5200.0f - 3200.0f * s2 - 2000.0f * s2 * s2 * s2 - 450.0f * std::max(0.0f, 1.0f - 9.0f * s2);
}

vec3 ground_colors(const Ground& g) {
  const auto height = static_cast<float>(g.height_m);
  const auto slope = static_cast<float>(glm::length(g.slope));
  const auto sine = static_cast<float>(std::abs(g.sin_latitude));
  if (g.has_sea && height < 0.0f) return water(height);

  const float mottle = g.mottle;
  const float snow_from = snow_line(sine);
  const float tree_line = snow_from - 1250.0f;
  const float wet = std::clamp(g.moisture + 0.14f * mottle - 0.10f * g.prominence, 0.0f, 1.0f);

  // Plants by moisture, thinning out towards the tree line.
  vec3 plants = mix(kSand, kSteppe, step_up(0.12f, 0.34f, wet));
  plants = mix(plants, kGrass, step_up(0.32f, 0.52f, wet));
  plants = mix(plants, kForest, step_up(0.47f, 0.66f, wet));
  const float h = height + 260.0f * mottle + 120.0f * g.prominence;
  vec3 color = mix(plants, mix(kSteppe, kGrass, wet), step_up(tree_line - 500.0f, tree_line, h));
  color = mix(color, mix(kScree, kTundra, wet), step_up(tree_line - 50.0f, tree_line + 550.0f, h));
  color = mix(color, kScree, step_up(tree_line + 550.0f, snow_from, h));

  // Bare rock on steep ground: scree from 30 degrees, cliffs from 42 to 62.
  const vec3 rock = mix(kDryRock, kRock, step_up(0.15f, 0.5f, wet)) * (1.0f + 0.25f * mottle);
  const float s = slope * (1.0f + 0.2f * mottle);
  color = mix(color, mix(kScree, rock, 0.4f), 0.75f * step_up(0.5f, 0.8f, s));
  color = mix(color, rock, step_up(0.72f, 1.25f, s));

  // Snow lies from the snow line on, first on gentle ground and in hollows, never on cliffs.
  const float lies = h - 160.0f * g.prominence - snow_from - 500.0f * std::max(0.0f, slope - 0.45f);
  color = mix(color, kSnow, step_up(-150.0f, 250.0f, lies) * (1.0f - step_up(0.85f, 1.35f, s)));

  if (g.has_sea) {
    const float beach =
        (1.0f - step_up(2.0f, 7.0f, height + 2.0f * mottle)) * (1.0f - step_up(0.1f, 0.3f, slope));
    color = mix(color, kBeach, beach * step_up(0.0f, 0.6f, snow_from * 0.001f));
  }
  return color;
}

}  // namespace

vec3 albedo(const Ground& ground) {
  const float shade =
      std::clamp(1.0f + 0.5f * static_cast<float>(ground.cavity) + 0.16f * ground.mottle, 0.55f, 1.5f);
  const vec3 color = ground.has_color ? ground.color : ground_colors(ground);
  if (ground.has_sea && ground.height_m < 0.0) return glm::clamp(color, 0.0f, 1.0f);
  return glm::clamp(color * shade, 0.0f, 1.0f);
}

}  // namespace globe::planet
