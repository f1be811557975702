#pragma once

#include "globe/clipmap/positions.h"
#include "globe/clipmap/torus.h"

namespace globe::clipmap {

/// Sizes that follow from the detail asked for (DESIGN section 5).
struct Settings {
  int s = 64;              ///< side of the hexagon in cells, a multiple of 2m
  int m = 8;               ///< cells a side of a patch, the largest power of two <= s / 8
  int base_level = 6;      ///< l0, the largest level with 2^l0 <= s: covers the whole sphere, always resident
  int shading_levels = 2;  ///< slopes and colours are this many levels finer than the triangles they cover
  Positions positions = Positions::kExact;
  bool morph = true;                  ///< false: levels change at once, to see what morphing is for
  Windows windows = Windows::kPlain;  ///< kHexagon only where positions are not interpolated

  /// Settings for a hexagon of at least `detail` cells (16 .. 1024), rounded up to a multiple of 2m.
  /// Throws UsageError outside that range.
  static Settings for_detail(int detail, int shading_levels = 2);

  int unit() const { return 2 * m; }  ///< regions are made of trixels of this many cells
  /// Cells between the knots that positions are interpolated from; 1 where they are not.
  int knot_step() const {
    return positions == Positions::kChord ? m : positions == Positions::kQuadratic ? m / 2 : 1;
  }
  /// Nodes a side of a level's torus: one step ahead, one guard node, and whole steps between knots.
  int window() const { return (2 * s + 2 * m + 2 + knot_step()) / knot_step() * knot_step(); }
  /// Rows of the strips that a region's hexagon is stored in.
  int strip_rows() const { return m / 2; }
  /// How vertices lie in their textures. A hexagon of side s, one step of m on either side ahead, and what
  /// strips have too much.
  Torus vertex_torus() const {
    return windows == Windows::kHexagon ? Torus::hexagon(s + m + strip_rows() - 1) : Torus::square(window());
  }
  /// The base level has a whole sphere's room in its torus: it is shaded one level finer still.
  int shading_levels_at(int level) const { return shading_levels + (level == base_level ? 1 : 0); }
  int shading_window() const { return window() << shading_levels; }
};

}  // namespace globe::clipmap
