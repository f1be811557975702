#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string_view>
#include <vector>

#include "globe/clipmap/node_rect.h"

namespace globe::clipmap {

/// How the windows of vertices lie in their textures.
enum class Windows {
  kPlain,    ///< a square round each region
  kHexagon,  ///< what a hexagon fills of it
};

/// The words of --window: plain, hexagon; nothing for another.
std::optional<Windows> windows_by_name(std::string_view name);
std::string_view name_of(Windows windows);

/// A torus of texels: node (i, j) lies at ((i - shift · ⌊j / height⌋) mod width, j mod height).
///
/// Without a shift it is the plain one, which holds any square. With one its wraps are laid like bricks, and
/// so hexagons tile: the closed hexagon of side S, max(|i|, |j|, |i + j|) <= S, lies in (3S + 1)(S + 1)
/// texels wherever its centre is, its upper rows beside its lower ones.
struct Torus {
  int width = 0;
  int height = 0;
  int shift = 0;

  static Torus square(int side) { return {side, side, 0}; }
  static Torus hexagon(int side) { return {3 * side + 1, side + 1, side}; }

  glm::ivec2 texel(int i, int j) const;

  /// A rectangle of nodes that is one of texels of the plain torus of this size: texel (x mod width, y mod
  /// height) and on.
  struct Piece {
    NodeRect nodes;
    int x = 0, y = 0;  ///< of its first node
  };
  /// A rectangle cut where its rows leave one row of bricks for the next.
  std::vector<Piece> pieces(const NodeRect& nodes) const;

  /// Whether no two nodes out of both sets share a texel unless they are the same.
  bool holds_both(const std::vector<NodeRect>& a, const std::vector<NodeRect>& b) const;

  friend bool operator==(const Torus&, const Torus&) = default;
};

}  // namespace globe::clipmap
