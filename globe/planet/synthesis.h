#pragma once

#include <cstdint>

#include "globe/planet/builtin_planet.h"
#include "globe/planet/relief.h"
#include "globe/planet/surface.h"

namespace globe::planet {

/// Ground below the finest data. Every function is pointwise: what it writes at a node depends on the seed,
/// the node's key, the level and the predicted values there, so that every tile that holds a node computes
/// the same bits. A tile comes in with all values predicted from its parent; with `own_nodes_only` the guard
/// is left alone.
///
/// With D the data, R carved relief (relief.h) and B the butterfly, heights from the data level to the last
/// carved level are B(D - R) + R: exactly D at the data's own nodes, carved between them, and as smooth as B
/// and R. As B is linear it is enough to carry R beside the height (kCarved): a new node gets
/// B(h) - B(R) + R. Below the last carved level new nodes are displaced by their hash.
struct Synthesis {
  std::uint64_t seed = 1;
  double root_edge = 0;  ///< length of a level-0 edge, metres
  int data_level = 0;
  bool craters = false;  ///< carve craters, not valleys

  double edge_m(int level) const;
  double finest_wave_m() const;
  /// Finest level that is carved; the data level when the data are finer than what is carved.
  int carved_level() const;
  ReliefScale relief_scale() const;
  /// Whether tiles of a level have a channel that synthesis works on, from kRoughness on.
  bool has_channel(Channel channel, int level) const;
};

inline constexpr int kBuiltinLevel = 9;  ///< the built-in planet's own function ends here: cells of 20 km

/// The built-in planet down to kBuiltinLevel.
void synthesise_builtin(const BuiltinPlanet& planet, bool own_nodes_only, SurfaceTile& tile);

/// Ground finer than the data: tiles of levels below the data level.
void synthesise_detail(const Synthesis& synthesis, bool own_nodes_only, SurfaceTile& tile);

/// The colour fractal, for tiles of every level.
void synthesise_mottle(std::uint64_t seed, bool own_nodes_only, SurfaceTile& tile);

}  // namespace globe::planet
