#pragma once

#include <optional>

#include "globe/geo/ellipsoid.h"

namespace app::accuracy {

/// Vincenty's inverse problem, metres: a yardstick that the program itself does not use, for it fails between
/// places nearly opposite. Nothing when 100 rounds do not settle it. Source: Vincenty 1975, Direct and
/// inverse solutions of geodesics on the ellipsoid, Survey Review 23 (176).
std::optional<double> vincenty(const globe::geo::Ellipsoid& ellipsoid, const globe::geo::Geodetic& p,
                               const globe::geo::Geodetic& q);

}  // namespace app::accuracy
