#pragma once

#include <optional>

#include "globe/planet/surface.h"

namespace globe::planet {

struct SightSettings {
  int level = 0;  ///< of the ground, 0..htm::kMaxLevel
  double refraction =
      0;  ///< K in [0, 1]: the ray bends downward with K / R; 0 in a vacuum, light in air 0.13
  /// The ground by the data alone, at their finest wherever that is, which must be no finer than `level`:
  /// trixels of `level` where insets are, of the planet's own data elsewhere. Nothing is synthesised.
  bool by_data = false;
};

/// A place on the ray between two eyes.
struct SightPlace {
  geo::Geodetic ray;       ///< of the ray; h_m above the ellipsoid
  double clearance_m = 0;  ///< of the ray above the ground, along the normal; negative below it
};

struct Sight {
  bool visible = false;
  double range_m = 0;                    ///< between the eyes, straight
  SightPlace lowest;                     ///< where the ray is nearest to the ground, or deepest below it
  std::optional<SightPlace> blocked_at;  ///< where the ray from A first meets the ground; none if visible
};

/// Whether two eyes see each other over the ground of a planet.
///
/// The ground stands on the ellipsoid at the heights of the level's nodes, linear within each trixel, the sea
/// at 0: that of `height_at`, kLinear, as drawn, but for the depth of the flat triangles under the curved
/// ellipsoid (2 m at level 10). Where the ray only touches the ground, 50 nm deep on the Earth, it passes.
///
/// The ray is straight in ECEF. With refraction it is raised above the straight line, s metres from one of
/// eyes S metres apart, by K s (S - s) / 2R along the normal, R the ellipsoid's mean radius: the arc of
/// curvature K / R to second order, which lets the horizon recede by 1 / sqrt(1 - K), as over a planet of
/// radius R / (1 - K). K = 0.13 is Gauss's value for light near the ground (Torge and Müller 2012, Geodesy,
/// on refraction).
///
/// Nothing is sampled at a fixed step. The ray is halved until an interval is known to be clear: its height
/// has a lower bound (it is convex, with a curvature of at most 1 / (rho + h), rho the least radius of
/// curvature), and the ground an upper one, that of the smallest trixel around both ends (a trixel is
/// convex; the pyramid "height_range" and the tiles below the data know its highest node). Within one trixel
/// of the level both are smooth and the bound is that of the parabola through the ends. The worst is looked
/// at first. Cost: 0.4 ms a look from Everest to any place at level 10, on average.
/// Both eyes get the same answer, bit for bit: `visible`, `lowest` and `range_m`.
/// Error: of the clearance 20 nm on the Earth. A trixel may be passed over that the ray crosses for less than
/// a millimetre or, off the sphere, beside whose side it runs for kilometres, less than 13 mm inside.
/// @param a, b  latitude, longitude, height above the ellipsoid, -a / 10 to 1e9 m
Sight sight(const Surface& surface, const geo::Geodetic& a, const geo::Geodetic& b,
            const SightSettings& settings);

/// Height of the ground that `sight` looks over.
double sight_ground(const Surface& surface, const geo::Geodetic& place, const SightSettings& settings);

}  // namespace globe::planet
