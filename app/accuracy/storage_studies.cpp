#include <glm/gtc/packing.hpp>

#include "app/accuracy/study.h"
#include "globe/planet/surface.h"

namespace app::accuracy {
namespace {

constexpr int kLevel = 8;

/// A way to keep a height, there and back.
struct Code {
  const char* name;
  double bytes;
  float (*round_trip)(float metres, float low, float high);
  bool is_default;
};

float quantized(float metres, float low, float high, float most) {
  const float code = std::round((metres - low) / (high - low) * most);
  return low + code / most * (high - low);
}

constexpr std::array kCodes{
    Code{"8 bits over the range", 1,
         [](float metres, float low, float high) { return quantized(metres, low, high, 255.0F); }, false},
    Code{"half float", 2,
         [](float metres, float, float) { return glm::unpackHalf1x16(glm::packHalf1x16(metres)); }, false},
    Code{"16 bits over the range", 2,
         [](float metres, float low, float high) { return quantized(metres, low, high, 65535.0F); }, false},
    Code{"float", 4, [](float metres, float, float) { return metres; }, true}};

}  // namespace

std::vector<Study> storage_studies(const Scope& scope) {
  const auto surface = globe::planet::Surface::builtin(1);
  const int level = scope.full ? kLevel + 1 : kLevel;
  const int n = globe::planet::nodes_per_side(level);
  std::vector<double> heights;
  std::vector<std::array<int, 3>> nodes;
  for (int d = 0; d < globe::planet::kDiamonds; ++d) {
    for (int j = 0; j < n; j += 2) {
      for (int i = 0; i < n; i += 2) {
        heights.push_back(surface->height({d, level, i, j}));
        nodes.push_back({d, i, j});
      }
    }
  }
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  Study study{
      "storage.heights",
      "What a stored height loses",
      "",
      "the height in double",
      std::to_string(heights.size()) + " nodes of the built-in planet, level " + std::to_string(level),
      "m",
      "bytes a node before compression",
      {}};
  for (const Code& code : kCodes) {
    ErrorSum sum;
    for (std::size_t k = 0; k < heights.size(); ++k) {
      const float back = code.round_trip(static_cast<float>(heights[k]), static_cast<float>(*low),
                                         static_cast<float>(*high));
      sum.add(static_cast<double>(back) - heights[k], [&] {
        return "diamond " + std::to_string(nodes[k][0]) + ", node " + std::to_string(nodes[k][1]) + "," +
               std::to_string(nodes[k][2]);
      });
    }
    study.settings.push_back({code.name, sum.figure(), fixed(code.bytes), code.is_default});
  }
  return {study};
}

}  // namespace app::accuracy
