#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace globe::htm {

using glm::dvec3;

inline constexpr int kMaxLevel = 28;
inline constexpr std::uint64_t kFirstRoot = 8;  ///< S0; the eight roots are S0..S3, N0..N3 = 8..15
inline constexpr int kRoots = 8;

/// A trixel of the Hierarchical Triangular Mesh (Szalay et al. 2005): a spherical triangle, by its id.
///
///     id = 1 h rr cc cc ... cc    (binary)
///          | | |  one pair a level: child 0, 1, 2 keeps corner 0, 1, 2 of its parent, child 3 is the middle
///          one | | root's digit | 0 south, 1 north marks the length, so that the level can be read from the
///          id
///
/// Level 0 is an octant, level L has 8 * 4^L trixels. All descendants of t at k levels below it are the one
/// range [t.id << 2k, (t.id + 1) << 2k). Corners run counter-clockwise seen from outside. A Trixel made by
/// the functions here is valid; ids from outside go through `trixel_from_id`.
struct Trixel {
  std::uint64_t id = kFirstRoot;

  friend auto operator<=>(const Trixel&, const Trixel&) = default;
};

/// nullopt unless the id is that of a trixel of level 0..kMaxLevel.
std::optional<Trixel> trixel_from_id(std::uint64_t id);

/// From a name such as N012 (level 2): N or S, the root's digit, one digit a level. Lower case is accepted;
/// nullopt for anything that is not a name of level 0..kMaxLevel.
std::optional<Trixel> trixel_from_name(std::string_view name);

std::string name(Trixel trixel);

int level(Trixel trixel);

/// REQUIRES: level(trixel) > 0.
Trixel parent(Trixel trixel);

/// REQUIRES: 0 <= k <= 3, level(trixel) < kMaxLevel.
Trixel child(Trixel trixel, int k);

/// The three trixels across the edges: number k lies across the edge opposite corner k. Integers alone; the
/// octahedron's edges are edges like any other.
std::array<Trixel, 3> neighbors(Trixel trixel);

using Corners = std::array<dvec3, 3>;

/// The three corners, each made by htm::midpoint alone: bit for bit the same from every trixel that has it.
Corners corners(Trixel trixel);

/// Corners of child k of a trixel with the given corners.
Corners child_corners(const Corners& corners, int k);

/// Corners of all four children, in half the time.
std::array<Corners, 4> children_corners(const Corners& corners);

/// Unit vector to the sum of the corners.
dvec3 center(Trixel trixel);

/// The one root that owns a direction, by the signs of its components, as SkyServer, sphgeom and libtinyhtm
/// have it: the equator to the north, longitude 90k to the octant east of it, the poles to N3 and S0. (The
/// JHU C++ library takes the first of S0..S3, N0..N3 within an epsilon, which gives the equator to the
/// south.)
Trixel root_at(const dvec3& u);

/// The one trixel that owns a direction, by its definition: a walk from `root_at` by exact signs on the
/// rounded corners.
///
/// At each step the first of child 0, 1, 2 whose inner edge has u on its own side, or on the edge itself;
/// else the middle. So trixel_at(u, L - 1) = parent(trixel_at(u, L)), on every machine.
/// @param u  direction, finite and not 0; of any length, the signs do not depend on it
/// @param level  0..kMaxLevel
/// @param exact_calls  if given, grows by the number of tests that rounded arithmetic could not decide
Trixel trixel_by_walk(const dvec3& u, int level, std::uint64_t* exact_calls = nullptr);

/// The same trixel, six times as fast: found without corners, and proven to be the walk's by an error bound
/// (htm/descent.h); a direction too near a side for that takes the walk (level 20: one in 1400).
Trixel trixel_at(const dvec3& u, int level, std::uint64_t* exact_calls = nullptr);

/// Directions as three arrays of the same size.
struct DirectionArrays {
  std::span<const double> x, y, z;
};

/// `trixel_at` of many directions, in vectors as wide as the processor has: the same trixels, in a thirtieth
/// of the walk's time (level 20, AVX-512). More than 16384 directions are spread over the threads of the TBB
/// arena that this is called in; the result does not depend on them.
/// REQUIRES: result.size() is that of the directions.
/// @returns how many directions took the walk
std::size_t trixels_at(const DirectionArrays& directions, int level, std::span<Trixel> result,
                       std::uint64_t* exact_calls = nullptr);
std::size_t trixels_at(std::span<const dvec3> directions, int level, std::span<Trixel> result,
                       std::uint64_t* exact_calls = nullptr);

}  // namespace globe::htm

template <>
struct std::hash<globe::htm::Trixel> {
  std::size_t operator()(const globe::htm::Trixel& t) const noexcept {
    return std::hash<std::uint64_t>{}(t.id);
  }
};
