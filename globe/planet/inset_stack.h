#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "globe/planet/dataset.h"
#include "globe/planet/surface.h"
#include "globe/planet/synthesis.h"

namespace globe::planet {

/// What an inset has at the nodes of a tile: the samples themselves down to its level, below it what is made
/// of them as a planet's ground is of its data. Weights below it are smoothly in between.
struct InsetTile {
  std::size_t inset = 0;     ///< its number in PlanetInfo::insets
  TileValues<float> weight;  ///< [0, 1]
  SurfaceTile ground;        ///< heights, or colors; the others have no values
};

/// What a tile that insets touch is put together from; each goes on into the tile's children on its own.
struct TileParts {
  /// The ground below all insets. Without heights, and channels that go with them, where they do not show in
  /// the tile nor in any finer one.
  std::shared_ptr<const SurfaceTile> base;
  std::vector<InsetTile> insets;  ///< from the lowest to the topmost

  std::size_t bytes() const;
};

/// Ground of a height with another one over it, of the weight w in [0, 1].
inline double laid_over(double below, double above, double w) {
  if (w <= 0.0) return below;
  return w >= 1.0 ? above : below + w * (above - below);
}

/// The insets of a planet. Every value is a function of the node alone.
///
/// Where a tile's base and insets are B, (w1, I1), (w2, I2) ..., its ground is B with I1 laid over by w1, I2
/// over that by w2 and so on, at every node of every level. So where a weight is 1 nothing below has a say,
/// where it is 0 it is as though there were no inset, bit for bit, and between them the ground is as smooth
/// as its parts.
class InsetStack {
 public:
  /// @param dataset  null for the built-in planet, which has no insets
  /// @param below  what is synthesised below the planet's data; each inset takes its own level instead
  InsetStack(std::shared_ptr<const Dataset> dataset, const Synthesis& below);

  bool empty() const { return insets_.empty(); }
  int finest_level() const { return finest_level_; }  ///< of heights; -1 without

  /// The insets that show in a tile or may show in a finer one. `parent` are the parent's, null without.
  std::vector<InsetTile> tiles(const TileId& id, const TileParts* parent) const;
  /// True when a base's heights do not show in this tile nor in any finer one.
  bool hide_base(const std::vector<InsetTile>& tiles) const;
  SurfaceTile put_together(const SurfaceTile& base, const std::vector<InsetTile>& tiles) const;

  /// Height of a node of any level by the data alone: an inset coarser than the node is linear in its
  /// trixels.
  /// @param below  height of the node without insets
  double data_height(const Node& node, double below) const;

  /// The same for a rectangle of nodes, row by row, in place.
  void lay_data_heights(int d, int level, int i0, int j0, int ni, int nj, double* heights) const;

  /// The data around a place, of one layer: "height" or "color".
  struct DataAt {
    int level = -1;                    ///< finest level of what shows; -1 where no inset does
    std::optional<std::size_t> inset;  ///< the topmost that shows
    bool alone = false;                ///< nothing below the insets shows
  };
  DataAt data_at(const dvec3& u, std::string_view layer) const;

  /// Highest of all heights; nothing without.
  std::optional<double> highest() const;
  /// Highest of the insets that touch a cell (i, j) of a level; nothing where none does.
  std::optional<double> highest(int d, int level, int i, int j) const;

 private:
  struct Inset {
    InsetInfo info;
    Synthesis synthesis;
    bool has_heights;
  };

  bool touches(const Inset& inset, const TileId& id) const;
  std::vector<float> read(std::size_t inset, const char* what, std::size_t channels, const TileId& id,
                          int guard) const;
  float read(std::size_t inset, const char* what, const Node& node) const;
  double data_height(std::size_t inset, const Node& node, double below) const;
  InsetTile read_tile(std::size_t inset, const TileId& id) const;
  InsetTile child(const InsetTile& parent, const TileId& id) const;
  bool hides_all_below(const InsetTile& tile) const;

  std::shared_ptr<const Dataset> dataset_;
  std::vector<Inset> insets_;
  int finest_level_ = -1;
};

}  // namespace globe::planet
