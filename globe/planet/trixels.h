#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "globe/htm/trixel.h"

namespace globe::planet {

/// The trixels that own many places given in degrees: those of htm::trixel_at(geo::normal_from_degrees(..)),
/// in vectors and on all threads of the TBB arena (see htm::trixels_at).
///
/// @param lat_deg  geodetic latitudes, [-90, 90]
/// @param lon_deg  longitudes of any size
/// @param level  0..htm::kMaxLevel
/// @param exact_calls  if given, grows by the number of tests that rounded arithmetic could not decide
/// REQUIRES: all three have the same size; coordinates are finite.
/// @returns how many places were too near a trixel's side for the fast way
std::size_t trixels_from_degrees(std::span<const double> lat_deg, std::span<const double> lon_deg, int level,
                                 std::span<htm::Trixel> result, std::uint64_t* exact_calls = nullptr);

}  // namespace globe::planet
