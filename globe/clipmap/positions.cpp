#include "globe/clipmap/positions.h"

#include <array>

namespace globe::clipmap {
namespace {

constexpr std::array<std::string_view, 4> kPositionsNames{"exact", "quadratic", "chord", "float32"};

}  // namespace

std::optional<Positions> positions_by_name(std::string_view name) {
  for (std::size_t k = 0; k < kPositionsNames.size(); ++k) {
    if (kPositionsNames[k] == name) return static_cast<Positions>(k);
  }
  return std::nullopt;
}

std::string_view name_of(Positions positions) { return kPositionsNames[static_cast<std::size_t>(positions)]; }

}  // namespace globe::clipmap
