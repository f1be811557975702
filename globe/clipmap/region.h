#pragma once

#include <array>
#include <compare>
#include <optional>
#include <vector>

#include "globe/clipmap/nadir.h"
#include "globe/clipmap/node_rect.h"
#include "globe/clipmap/settings.h"

namespace globe::clipmap {

/// A trixel of the lattice of some number of cells: nodes (i, j), (i+1, j), (i, j+1) when half is 0, and
/// (i+1, j+1), (i, j+1), (i+1, j) when it is 1, in units of that lattice.
struct LatticeTrixel {
  int d = 0;
  int i = 0;
  int j = 0;
  int half = 0;

  friend auto operator<=>(const LatticeTrixel&, const LatticeTrixel&) = default;

  std::array<ivec2, 3> corners() const {
    if (half == 0) return {ivec2{i, j}, ivec2{i + 1, j}, ivec2{i, j + 1}};
    return {ivec2{i + 1, j + 1}, ivec2{i, j + 1}, ivec2{i + 1, j}};
  }
};

/// The trixel of the lattice twice as coarse that holds t.
LatticeTrixel coarser(const LatticeTrixel& t);
/// The four trixels of the lattice twice as fine inside t.
std::array<LatticeTrixel, 4> finer(const LatticeTrixel& t);
/// The trixels across the three edges of t: opposite to corner 0, 1, 2. The lattice has n units a side.
std::array<LatticeTrixel, 3> across(const LatticeTrixel& t, int n);

/// Region A_l: the trixels of 2m cells whose three corners lie within s of the level's centre.
struct Region {
  int level = 0;
  Node centre;  ///< node of the 2m lattice nearest to the nadir; unused at the base level
  std::vector<LatticeTrixel> units;  ///< sorted, of 2m cells; at the base level all of them
  std::array<NodeRect, planet::kDiamonds>
      nodes;  ///< what the region needs of each diamond, cells of the level

  bool holds(const LatticeTrixel& unit) const;
};

/// Region of a level for a camera above `u`. At the base level the whole sphere.
Region make_region(const Settings& settings, const GridPoint& nadir_of_level);

/// A patch to draw: a trixel of m cells, which of its edges (opposite to corner 0, 1, 2: bits 0, 1, 2) lie on
/// the outer rim of its region, and which corners (0, 1, 2: bits 0, 1, 2) touch the rim though none of the
/// patch's own rim edges ends there.
struct Patch {
  LatticeTrixel trixel;
  int rim = 0;
  int rim_corners = 0;
};

/// Ring l: A_l without A_(l+1), in whole patches. `finer` is null for the finest level.
std::vector<Patch> make_ring(const Settings& settings, const Region& region, const Region* finer_region);

}  // namespace globe::clipmap
