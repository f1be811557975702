#pragma once

#include <memory>

#include "globe/planet/surface.h"

namespace converters {

/// Values at the nodes of one level of a planet, from wherever the planet has them. Safe to read from any
/// thread.
class NodeValues {
 public:
  NodeValues(int level, int channels) : level_(level), channels_(channels) {}
  virtual ~NodeValues() = default;
  NodeValues(const NodeValues&) = delete;
  NodeValues& operator=(const NodeValues&) = delete;

  int level() const { return level_; }
  int channels() const { return channels_; }

  /// Nodes i0 .. i0+side, j0 .. j0+side of diamond d, both ends included: out[(j * (side + 1) + i) *
  /// channels + c], row by row.
  /// REQUIRES: side is a power of two, at most kTileCells and 2^level; i0 and j0 are multiples of it.
  virtual void read(int d, int i0, int j0, int side, float* out) const = 0;

 private:
  int level_;
  int channels_;
};

/// Which heights of a level.
enum class HeightKind {
  kData,         ///< nothing made up: where the level is finer than the data, linear in their trixels
  kFiltered,     ///< averaged to the level, where the planet has such (the layer "relief")
  kSynthesised,  ///< with made-up detail where the level is finer than the data
};

/// Metres above the vertical datum, insets included. The built-in planet is all synthesised.
/// REQUIRES: surface.has_heights().
std::unique_ptr<NodeValues> node_heights(std::shared_ptr<const globe::planet::Surface> surface, int level,
                                         HeightKind kind);

/// Three channels of linear light: the color map's, insets included, averaged to the level or, where the
/// level is finer, smooth between its nodes; of the built-in planet, the color that the ground is drawn in.
std::unique_ptr<NodeValues> node_colors(std::shared_ptr<const globe::planet::Surface> surface, int level);

}  // namespace converters
