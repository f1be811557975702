#pragma once

#include <array>
#include <vector>

#include "globe/clipmap/morph.h"
#include "globe/clipmap/settings.h"
#include "globe/clipmap/stream.h"

namespace globe::clipmap {

/// A plane, and the ball in which it is of interest; ECEF metres.
struct CuttingPlane {
  dvec3 centre;
  dvec3 normal;  ///< unit
  double radius;
};

/// The stretches in which a plane meets the triangles that are drawn, morphed as they are, within a ball and
/// somewhat beyond; in no order. Two triangles with a common edge give it the same point. ECEF metres.
///
/// @param shown  levels of the state above it are left out
///
/// Made of the positions that the state holds, so it costs a few microseconds for each patch that is cut.
std::vector<std::array<dvec3, 2>> cut(const Settings& settings, const ClipmapState& state,
                                      const FinestLevel& shown, const CuttingPlane& plane);

}  // namespace globe::clipmap
