#include "globe/planet/appearance.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace globe::planet {

glm::vec3 albedo(const Ground& ground) {
  const auto slope = static_cast<float>(glm::length(ground.slope));
  const float shade =
      std::clamp(1.0f + 0.6f * static_cast<float>(ground.cavity) + 0.15f * ground.mottle, 0.4f, 1.6f);
  if (ground.has_color) return glm::clamp(ground.color * shade, 0.0f, 1.0f);
  if (ground.has_sea && ground.height_m < 0.0) {
    const float deep = static_cast<float>(std::exp(ground.height_m / 800.0));
    return glm::mix(glm::vec3(0.005f, 0.02f, 0.06f), glm::vec3(0.03f, 0.14f, 0.17f), deep);
  }
  const float t = std::clamp(static_cast<float>(ground.height_m / 5000.0), 0.0f, 1.0f);
  const glm::vec3 low(0.07f, 0.13f, 0.03f);
  const glm::vec3 high(0.25f, 0.20f, 0.15f);
  const glm::vec3 rock(0.16f, 0.14f, 0.12f);
  return glm::clamp(
      glm::mix(glm::mix(low, high, t), rock, std::clamp(slope * 1.5f - 0.5f, 0.0f, 1.0f)) * shade, 0.0f,
      1.0f);
}

}  // namespace globe::planet
