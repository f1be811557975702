#include "globe/clipmap/positions.h"

#include <array>

namespace globe::clipmap {
namespace {

constexpr std::array<std::string_view, 4> kNames{"exact", "quadratic", "chord", "float32"};

}  // namespace

std::optional<Positions> positions_by_name(std::string_view name) {
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    if (kNames[k] == name) return static_cast<Positions>(k);
  }
  return std::nullopt;
}

std::string_view name_of(Positions positions) { return kNames[static_cast<std::size_t>(positions)]; }

}  // namespace globe::clipmap
