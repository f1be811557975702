#include "globe/planet/appearance.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace globe::planet {
namespace {

using glm::mix;
using glm::vec3;

constexpr vec3 kForest{0.028f, 0.041f, 0.018f};
constexpr vec3 kGrass{0.088f, 0.098f, 0.038f};
constexpr vec3 kSteppe{0.19f, 0.155f, 0.075f};
constexpr vec3 kSand{0.42f, 0.30f, 0.17f};
constexpr vec3 kBeach{0.40f, 0.34f, 0.24f};
constexpr vec3 kTundra{0.115f, 0.100f, 0.058f};
constexpr vec3 kSoil{0.135f, 0.105f, 0.062f};
constexpr vec3 kScree{0.20f, 0.175f, 0.145f};
constexpr vec3 kRock{0.145f, 0.128f, 0.112f};
constexpr vec3 kDryRock{0.25f, 0.165f, 0.105f};
constexpr vec3 kSnow{0.80f, 0.83f, 0.87f};
constexpr vec3 kShallows{0.045f, 0.155f, 0.165f};
constexpr vec3 kDeepSea{0.006f, 0.022f, 0.060f};
constexpr vec3 kSeaSand{0.33f, 0.29f, 0.205f};
constexpr vec3 kSeaMud{0.115f, 0.105f, 0.080f};
constexpr vec3 kSeaRock{0.085f, 0.082f, 0.070f};
constexpr vec3 kSeaWeed{0.035f, 0.058f, 0.024f};

float step_up(float from, float to, float x) { return glm::smoothstep(from, to, x); }

vec3 water(float height) {
  const float near_shore = std::exp(height / 14.0f);
  const float shelf = std::exp(height / 220.0f);
  return mix(mix(kDeepSea, vec3(0.010f, 0.048f, 0.085f), shelf), kShallows, near_shore);
}

/// The sea's floor: sand by the shore with meadows of weed, mud farther down, rock where it is steep.
vec3 sea_floor(const Ground& g) {
  const auto depth = -static_cast<float>(g.height_m);
  const auto slope = static_cast<float>(glm::length(g.slope));
  const float mottle = g.mottle;
  const float grown = step_up(0.12f, 0.42f, mottle - 0.2f * g.prominence) * step_up(1.5f, 5.0f, depth) *
                      (1.0f - step_up(25.0f, 45.0f, depth));
  vec3 color =
      mix(kSeaSand, kSeaMud, step_up(15.0f, 120.0f, depth + 30.0f * mottle)) * (1.0f + 0.18f * mottle);
  color = mix(color, kSeaWeed, 0.85f * grown);
  return mix(color, kSeaRock * (1.0f + 0.3f * mottle), step_up(0.35f, 0.75f, slope * (1.0f + 0.3f * mottle)));
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
  if (g.has_sea && height < 0.0f) {
    return mix(water(height), kSnow * 0.85f, pack_ice(g));
  }

  const float mottle = g.mottle;
  const float snow_from = snow_line(sine);
  const float tree_line = snow_from - 1250.0f;
  const float wet = std::clamp(g.moisture + 0.22f * mottle - 0.10f * g.prominence, 0.0f, 1.0f);

  // Plants by moisture, thinning out towards the tree line.
  vec3 plants = mix(kSand, kSteppe, step_up(0.12f, 0.34f, wet));
  plants = mix(plants, kGrass, step_up(0.32f, 0.52f, wet));
  plants = mix(plants, kForest, step_up(0.47f, 0.66f, wet));
  const float h = height + 260.0f * mottle + 120.0f * g.prominence;
  vec3 color = mix(plants, mix(kSteppe, kGrass, wet), step_up(tree_line - 500.0f, tree_line, h));
  color = mix(color, mix(kScree, kTundra, wet), step_up(tree_line - 50.0f, tree_line + 550.0f, h));
  color = mix(color, kScree, step_up(tree_line + 550.0f, snow_from, h));

  // Patches of bare soil and of lush growth, at every scale.
  color = mix(color, kSoil, 0.55f * wet * step_up(0.25f, 0.6f, mottle));
  color = mix(color, color * 0.6f, step_up(0.2f, 0.6f, -mottle) * wet);

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
    const float near = 1.0f - step_up(150.0f, 1500.0f, static_cast<float>(g.edge_m));  // beaches are narrow
    color = mix(color, kBeach, beach * near * step_up(0.0f, 0.6f, snow_from * 0.001f));
  }
  return color;
}

float luminance(const vec3& c) { return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z; }

/// The map's colour is the mean over a pixel of kilometres: what it mixes is taken apart again by slope,
/// crest, hollow and mottle.
vec3 mapped_colors(const Ground& g) {
  const vec3 map = g.color;
  const auto slope = static_cast<float>(glm::length(g.slope));
  const float light = luminance(map);
  const float strongest = std::max({map.x, map.y, map.z, 1e-4f});
  const float gray = std::min({map.x, map.y, map.z}) / strongest;
  const float blue = map.z / std::max(map.x, 1e-4f);
  const float s = slope * (1.0f + 0.25f * g.mottle);
  if (g.airless) return map * (1.0f + 0.25f * step_up(0.35f, 0.75f, s));

  const float open_water = step_up(1.35f, 1.8f, blue) * (1.0f - step_up(0.12f, 0.2f, light));
  const float snow_share = step_up(0.16f, 0.62f, light) * step_up(0.55f, 0.8f, gray);
  const float green = std::clamp((map.y - std::max(map.x, map.z)) / strongest * 5.0f + 0.25f, 0.0f, 1.0f);

  const float arid = 1.0f - green;
  const vec3 rock = mix(kRock, map * 0.8f, 0.35f + 0.3f * arid) * (1.0f + 0.2f * g.mottle);
  // The snowless part of a mixed pixel is as dark as rock.
  vec3 color = mix(map, mix(map * 0.45f, kScree, 0.6f), snow_share);
  color = mix(color, color * vec3(1.35f, 1.2f, 1.15f),
              0.8f * step_up(0.1f, 0.55f, 0.6f * g.prominence + g.mottle));
  color = mix(color, color * vec3(0.66f, 0.74f, 0.66f),
              0.8f * step_up(0.1f, 0.6f, -0.5f * g.prominence - g.mottle));
  color = mix(color, mix(color, rock, 0.6f), step_up(0.5f, 0.8f, s));
  color = mix(color, rock, step_up(0.72f, 1.25f, s));
  const float lies = snow_share * 2.2f - 0.75f + 0.8f * g.mottle + 0.6f * g.prominence -
                     1.1f * std::max(0.0f, slope - 0.35f);
  color =
      mix(color, kSnow,
          step_up(0.0f, 0.35f, lies) * step_up(0.06f, 0.2f, snow_share) * (1.0f - step_up(0.85f, 1.35f, s)));
  return mix(color, map, open_water);
}

}  // namespace

float pack_ice(const Ground& g) {
  if (g.has_color) {  // the map shows it bright and without colour
    const float strongest = std::max({g.color.x, g.color.y, g.color.z, 1e-4f});
    const float gray = std::min({g.color.x, g.color.y, g.color.z}) / strongest;
    return step_up(0.22f, 0.4f, luminance(g.color)) * step_up(0.6f, 0.8f, gray);
  }
  return step_up(0.955f, 0.975f, static_cast<float>(std::abs(g.sin_latitude)) + 0.012f * g.mottle);
}

bool is_open_water(const Ground& ground, const glm::vec3& albedo) {
  if (!ground.has_sea || ground.height_m >= 0.0) return false;
  return ground.bare_floor ? pack_ice(ground) < 0.5f : albedo.r < 0.3f;
}

vec3 albedo(const Ground& ground) {
  if (ground.bare_floor && ground.height_m < 0.0) {
    const vec3 ice = ground.has_color ? ground.color : kSnow * 0.85f;
    return glm::clamp(mix(sea_floor(ground), ice, pack_ice(ground)), 0.0f, 1.0f);
  }
  const float shade = std::clamp(
      1.0f + 0.5f * static_cast<float>(ground.cavity) + 0.20f * ground.mottle + 0.12f * ground.prominence,
      0.55f, 1.5f);
  const vec3 color = ground.has_color ? mapped_colors(ground) : ground_colors(ground);
  if (ground.has_sea && ground.height_m < 0.0) return glm::clamp(color, 0.0f, 1.0f);
  return glm::clamp(color * shade, 0.0f, 1.0f);
}

}  // namespace globe::planet
