#pragma once

#include "globe/geo/ellipsoid.h"

namespace converters {

/// Where Bhattacharjee's thesis (2010, 5.2.2) takes the ground from that it draws at a direction.
///
/// The thesis makes each row of the map an anti-diagonal of the diamonds: latitude is linear in i + j, and
/// longitude along the anti-diagonal. It draws the samples at HTM's vertices, which lie elsewhere: up to
/// kThesisShift_deg too near the pole (at weights 1/4, 1/4, 1/2: 54.7 degrees instead of 45). Right on the
/// four meridians between diamonds, the equator and the poles.
/// @param u  geodetic normal; vertices of HTM go exactly where the thesis' rows have them, what is between
///           them linearly
globe::geo::dvec3 thesis_direction(const globe::geo::dvec3& u);

/// Largest angle between a direction and its thesis_direction: atan(sqrt 2) - 45 degrees.
inline constexpr double kThesisShift_deg = 9.735610317245346;

}  // namespace converters
