#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <utility>

#include "app/accuracy/mesh_probe.h"
#include "app/accuracy/study.h"

namespace app::accuracy {

/// A level, and a node's key on the octahedron: the same from every diamond.
using NodeName = std::array<int, 4>;
NodeName name_of(const globe::planet::Node& node);

/// Whether a node is none of the coarser level's.
inline bool is_odd(const globe::planet::Node& node) { return ((node.i | node.j) & 1) != 0; }

/// Camera-relative places of the nodes that a frame draws, but for those on rims.
std::map<NodeName, std::pair<globe::planet::Node, dvec3>> places(const MeshProbe& probe, const Camera& camera,
                                                                 float fade);

/// How far a movement of something so far away goes on a screen of 1280x720, 60 degrees high, at most;
/// pixels.
double on_screen(const dvec3& movement, const dvec3& relative);

/// Adds how far each vertex of a level leaps from a frame just above the height at which the level is
/// admitted to one just below it, pixels: from its own place there, or from the middle of the edge that it
/// halves. Returns how many vertices there are.
///
/// @param fade  of the frame below
std::size_t add_pops(const Surface& surface, MeshProbe& probe, const globe::geo::Geodetic& place, int level,
                     float fade, ErrorSum& sum);

}  // namespace app::accuracy
