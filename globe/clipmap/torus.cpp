#include "globe/clipmap/torus.h"

#include <algorithm>
#include <array>

namespace globe::clipmap {
namespace {

constexpr std::array<std::string_view, 2> kWindowsNames{"plain", "hexagon"};

int floor_divide(int x, int n) { return x >= 0 ? x / n : -((n - 1 - x) / n); }
int modulo(int x, int n) { return x - floor_divide(x, n) * n; }

/// How many multiples of n lie in [low, high].
int multiples(int low, int high, int n) { return floor_divide(high, n) - floor_divide(low - 1, n); }

/// Whether a node of `a` shares its texel with another node of `b`.
bool clash(const Torus& torus, const NodeRect& a, const NodeRect& b) {
  // wraps of rows that b's nodes are moved by to lie in a's rows
  const int first = -floor_divide(-(a.j0 - b.j1), torus.height);
  const int last = floor_divide(a.j1 - b.j0, torus.height);
  for (int wraps = first; wraps <= last; ++wraps) {
    const int by = wraps * torus.shift;
    const int low = a.i0 - b.i1 - by, high = a.i1 - b.i0 - by;
    // in rows of its own a node meets itself, which is no clash
    const int itself = wraps == 0 && low <= 0 && high >= 0 ? 1 : 0;
    if (multiples(low, high, torus.width) > itself) return true;
  }
  return false;
}

}  // namespace

std::optional<Windows> windows_by_name(std::string_view name) {
  for (std::size_t k = 0; k < kWindowsNames.size(); ++k) {
    if (kWindowsNames[k] == name) return static_cast<Windows>(k);
  }
  return std::nullopt;
}

std::string_view name_of(Windows windows) { return kWindowsNames[static_cast<std::size_t>(windows)]; }

glm::ivec2 Torus::texel(int i, int j) const {
  return {modulo(i - shift * floor_divide(j, height), width), modulo(j, height)};
}

std::vector<Torus::Piece> Torus::pieces(const NodeRect& nodes) const {
  if (shift == 0) return {{nodes, nodes.i0, nodes.j0}};
  std::vector<Piece> result;
  for (int j = nodes.j0; j <= nodes.j1;) {
    const int wraps = floor_divide(j, height);
    const int last = std::min(nodes.j1, (wraps + 1) * height - 1);
    result.push_back({{nodes.i0, nodes.i1, j, last}, nodes.i0 - wraps * shift, j});
    j = last + 1;
  }
  return result;
}

bool Torus::holds_both(const std::vector<NodeRect>& a, const std::vector<NodeRect>& b) const {
  const auto clashes = [&](const std::vector<NodeRect>& x, const std::vector<NodeRect>& y) {
    return std::any_of(x.begin(), x.end(), [&](const NodeRect& p) {
      return std::any_of(y.begin(), y.end(), [&](const NodeRect& q) { return clash(*this, p, q); });
    });
  };
  return !clashes(a, a) && !clashes(b, b) && !clashes(a, b);
}

}  // namespace globe::clipmap
