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

/// Metres above the vertical datum: the data's, or synthesised where the level is finer than they are.
/// `filtered` takes those averaged to the level, where the planet has them (the layer "relief").
/// REQUIRES: surface.has_heights().
std::unique_ptr<NodeValues> node_heights(std::shared_ptr<const globe::planet::Surface> surface, int level,
                                         bool filtered);

/// Three channels of linear light: the color map's, averaged to the level; where the planet has none, or the
/// level is finer than it, the color that the ground is drawn in.
std::unique_ptr<NodeValues> node_colors(std::shared_ptr<const globe::planet::Surface> surface, int level);

}  // namespace converters
