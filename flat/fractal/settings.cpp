#include "flat/fractal/settings.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "globe/base/error.h"

namespace globe::flat::fractal {
namespace {

constexpr std::array<std::pair<Method, std::string_view>, 2> kNames{
    {{Method::kDiamondSquare, "diamond-square"}, {Method::kSquareSquare, "square-square"}}};

void refuse(const std::string& option, double value, const std::string& why, const std::string& range) {
  throw UsageError(option + " " + std::to_string(value), why, "give " + range);
}

}  // namespace

std::string_view name_of(Method method) {
  for (const auto& [known, name] : kNames) {
    if (known == method) return name;
  }
  return {};
}

std::optional<Method> method_by_name(std::string_view name) {
  for (const auto& [method, known] : kNames) {
    if (known == name) return method;
  }
  return std::nullopt;
}

double Settings::spacing_m() const { return std::ldexp(area_m, -iterations); }

void check(const Settings& settings) {
  const auto within = [](double value, double low, double high) { return value >= low && value <= high; };
  if (!within(settings.iterations, 1, 24))
    refuse("--iterations", settings.iterations, "an area is not cut so often", "a whole number from 1 to 24");
  if (!within(settings.roughness, 0, 1))
    refuse("--roughness", settings.roughness, "not an exponent H", "a number from 0 (jagged) to 1 (smooth)");
  if (!within(settings.relief_m, 0, 1e5))
    refuse("--relief", settings.relief_m, "no ground is so high", "metres from 0 to 100000");
  if (!within(settings.contrast, 0, 1))
    refuse("--contrast", settings.contrast, "not a share", "a number from 0 to 1");
  if (!within(settings.area_m, 1e-3, 1e9))
    refuse("--area", settings.area_m, "not the side of an area", "metres from 0.001 to 1e9");
  if (!within(settings.base_m, -1e5, 1e5))
    refuse("--base", settings.base_m, "no ground is so high", "metres from -100000 to 100000");
}

}  // namespace globe::flat::fractal
