#pragma once

#include <array>

#include "globe/geo/ellipsoid.h"

namespace globe::geo {

/// Area (m²) of the part of an ellipsoid's surface whose normals lie in a spherical triangle.
///
/// The sides are great circles of the sphere of normals, as HTM's are, not geodesics of the ellipsoid.
/// Method: the surface has the element b² / (1 - e² u_z²)² a unit of solid angle of its normal u; it is
/// integrated over the flat triangle under the spherical one (element det(u0, u1, u2) / |x|³) by a
/// Gauss-Legendre rule of 6 x 6 points, the triangle cut in four where the rule and its four quarters differ
/// by more than 1e-13; below sides of 0.9 degrees (trixels from level 7 on) by a rule of 7 points.
/// @param corners  unit normals, counter-clockwise seen from outside; sides below 180 degrees
/// @param tolerance  error allowed, of the result: seven points do on sides up to 5 degrees for 1e-9, 17 for
///     1e-6; one point on sides up to twice the root of the tolerance
/// Error: the tolerance; at the least, 1e-13 of the result for the corners given (area_test: a level's
/// trixels sum to the ellipsoid's area within 1e-13). The corners' own rounding adds 1e-16 / side: 3e-8 of
/// the area at level 28.
double surface_area(const Ellipsoid& ellipsoid, const std::array<dvec3, 3>& corners,
                    double tolerance = 1e-13);

}  // namespace globe::geo
