#include "globe/clipmap/region.h"

#include <algorithm>

namespace globe::clipmap {
namespace {

using planet::kDiamonds;
using planet::nodes_per_side;

int wrap_diamond(int d) { return (d + kDiamonds) % kDiamonds; }

NodeRect unite(const NodeRect& rect, ivec2 p) {
  if (rect.empty()) return {p.x, p.x, p.y, p.y};
  return {std::min(rect.i0, p.x), std::max(rect.i1, p.x), std::min(rect.j0, p.y), std::max(rect.j1, p.y)};
}

void add_unit(Region& region, const LatticeTrixel& unit, int cells) {
  region.units.push_back(unit);
  NodeRect& rect = region.nodes[static_cast<std::size_t>(unit.d)];
  for (const ivec2& corner : unit.corners()) rect = unite(rect, corner * cells);
}

}  // namespace

LatticeTrixel coarser(const LatticeTrixel& t) {
  const int x = t.i & 1;
  const int y = t.j & 1;
  // In the coarse cell's square the anti-diagonal splits the four fine cells: (0,0) lies below it, (1,1)
  // above, and the other two are split by it like their own halves.
  const int half = x + y == 0 ? 0 : x + y == 2 ? 1 : t.half;
  return {t.d, t.i >> 1, t.j >> 1, half};
}

std::array<LatticeTrixel, 4> finer(const LatticeTrixel& t) {
  const int i = 2 * t.i;
  const int j = 2 * t.j;
  if (t.half == 0) {
    return {LatticeTrixel{t.d, i, j, 0}, LatticeTrixel{t.d, i + 1, j, 0}, LatticeTrixel{t.d, i, j + 1, 0},
            LatticeTrixel{t.d, i, j, 1}};
  }
  return {LatticeTrixel{t.d, i + 1, j + 1, 1}, LatticeTrixel{t.d, i, j + 1, 1},
          LatticeTrixel{t.d, i + 1, j, 1}, LatticeTrixel{t.d, i + 1, j + 1, 0}};
}

std::array<LatticeTrixel, 3> across(const LatticeTrixel& t, int n) {
  const auto [d, i, j, half] = t;
  if (half == 0) {
    return {LatticeTrixel{d, i, j, 1},
            i > 0 ? LatticeTrixel{d, i - 1, j, 1} : LatticeTrixel{wrap_diamond(d + 1), j, 0, 0},
            j > 0 ? LatticeTrixel{d, i, j - 1, 1} : LatticeTrixel{wrap_diamond(d - 1), 0, i, 0}};
  }
  return {LatticeTrixel{d, i, j, 0},
          i + 1 < n ? LatticeTrixel{d, i + 1, j, 0} : LatticeTrixel{wrap_diamond(d - 1), j, n - 1, 1},
          j + 1 < n ? LatticeTrixel{d, i, j + 1, 0} : LatticeTrixel{wrap_diamond(d + 1), n - 1, i, 1}};
}

bool Region::holds(const LatticeTrixel& unit) const {
  return std::binary_search(units.begin(), units.end(), unit);
}

Region make_region(const Settings& settings, const GridPoint& nadir_of_level) {
  const int level = nadir_of_level.level;
  const int cells = std::min(settings.unit(), nodes_per_side(level));
  const int n = nodes_per_side(level) / cells;
  Region region;
  region.level = level;
  if (level <= settings.base_level) {
    for (int d = 0; d < kDiamonds; ++d) {
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          for (int half = 0; half < 2; ++half) add_unit(region, {d, i, j, half}, cells);
        }
      }
    }
    return region;
  }
  region.centre = nearest_lattice_node(nadir_of_level, cells);
  const GridPoint centre = grid_point(region.centre);
  const std::int64_t reach = std::int64_t{settings.s} * kSubcell;
  for (int d = 0; d < kDiamonds; ++d) {
    const std::vector<LatticePoint> seen = images(centre, d);
    NodeRect box;
    for (const LatticePoint& image : seen) {
      const auto lower = [&](std::int64_t x) {
        return static_cast<int>(std::clamp<std::int64_t>((x - reach) / (cells * kSubcell) - 1, 0, n - 1));
      };
      const auto upper = [&](std::int64_t x) {
        return static_cast<int>(std::clamp<std::int64_t>((x + reach) / (cells * kSubcell) + 1, 0, n - 1));
      };
      if (image.i + reach < 0 || image.j + reach < 0 || image.i - reach > n * cells * kSubcell ||
          image.j - reach > n * cells * kSubcell)
        continue;
      box = unite(unite(box, {lower(image.i), lower(image.j)}), {upper(image.i), upper(image.j)});
    }
    const auto near = [&](const ivec2& corner) {
      return hex_distance(seen, {corner.x * cells * kSubcell, corner.y * cells * kSubcell}) <= reach;
    };
    for (int i = box.i0; i <= box.i1; ++i) {
      for (int j = box.j0; j <= box.j1; ++j) {
        for (int half = 0; half < 2; ++half) {
          const LatticeTrixel unit{d, i, j, half};
          const auto corners = unit.corners();
          if (std::all_of(corners.begin(), corners.end(), near)) add_unit(region, unit, cells);
        }
      }
    }
  }
  std::sort(region.units.begin(), region.units.end());
  return region;
}

namespace {

/// Corner of a patch as a vertex, the same from every diamond.
std::array<int, 3> vertex_of(const Region& region, const LatticeTrixel& trixel, std::size_t corner, int m) {
  const ivec2 node = trixel.corners()[corner] * m;
  const auto key = planet::octahedral_key({trixel.d, region.level, node.x, node.y});
  return {key.x, key.y, key.z};
}

bool ends_rim_edge(const Patch& patch, std::size_t corner) { return (patch.rim & ~(1 << corner)) != 0; }

/// A vertex on the rim is the coarser level's for every patch around it, not only for those with an edge
/// there.
void mark_rim_corners(const Region& region, int m, std::vector<Patch>& ring) {
  std::vector<std::array<int, 3>> rim;
  for (const Patch& patch : ring) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (ends_rim_edge(patch, corner)) rim.push_back(vertex_of(region, patch.trixel, corner, m));
    }
  }
  std::sort(rim.begin(), rim.end());
  for (Patch& patch : ring) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (!ends_rim_edge(patch, corner) &&
          std::binary_search(rim.begin(), rim.end(), vertex_of(region, patch.trixel, corner, m))) {
        patch.rim_corners |= 1 << corner;
      }
    }
  }
}

}  // namespace

std::vector<Patch> make_ring(const Settings& settings, const Region& region, const Region* finer_region) {
  std::vector<Patch> ring;
  const int n = nodes_per_side(region.level) / settings.m;
  const bool has_rim = region.level > settings.base_level;
  for (const LatticeTrixel& unit : region.units) {
    for (const LatticeTrixel& trixel : finer(unit)) {
      // A patch of m cells is a trixel of 2m cells of the next level: the very unit that region is made of.
      if (finer_region != nullptr && finer_region->holds(trixel)) continue;
      Patch patch{trixel};
      if (has_rim) {
        const auto neighbours = across(trixel, n);
        for (std::size_t edge = 0; edge < 3; ++edge) {
          if (!region.holds(coarser(neighbours[edge]))) patch.rim |= 1 << edge;
        }
      }
      ring.push_back(patch);
    }
  }
  if (has_rim) mark_rim_corners(region, settings.m, ring);
  return ring;
}

}  // namespace globe::clipmap
