#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>

/// What a user might pick instead of HTM, each in a file of its own: their headers do not go together.
namespace peers {

using Ids = std::span<std::uint64_t>;

#ifdef GLOBE_HAVE_S2
/// S2CellId of level 30.
void s2_from_degrees(std::span<const double> lat_deg, std::span<const double> lon_deg, Ids ids);
void s2_from_vectors(std::span<const glm::dvec3> u, Ids ids);
/// Parents at `level` of leaf ids.
void s2_parents(int level, Ids ids);
/// Sum of the corners' coordinates and of the neighbours' ids, so that no work is left out.
double s2_corners(std::span<const std::uint64_t> ids);
std::uint64_t s2_neighbors(std::span<const std::uint64_t> ids);
#endif

#ifdef GLOBE_HAVE_HEALPIX
/// Nested HEALPix pixels, Nside = 2^20.
void healpix_from_degrees(std::span<const double> lat_deg, std::span<const double> lon_deg, Ids ids);
void healpix_from_vectors(std::span<const glm::dvec3> u, Ids ids);
#endif

}  // namespace peers
