#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "globe/planet/noise.h"

namespace globe::planet {

using glm::dvec3;

/// Metres, up and down, that the built-in planet's ground stays within at every level.
inline constexpr double kBuiltinRelief_m = 9000.0;

/// The built-in planet from continents down to some 20 km: a function of the direction alone.
///
/// Continents are cut from a warped fractal field by a hypsometric curve, so that 62 % of the planet is sea
/// with shelves, and land has broad lowlands and a few plateaus. Mountain chains follow the zero lines of a
/// second field, where a third one lets them rise; a chain off the coast becomes an arc of islands.
class BuiltinPlanet {
 public:
  explicit BuiltinPlanet(std::uint64_t seed);

  struct Point {
    double height_m;
    float moisture;  ///< 0 desert, 1 rain forest
  };
  Point at(const dvec3& u) const;
  /// The same at many places, kLanes of them for little more than one costs.
  std::vector<Point> at(std::span<const dvec3> u) const;

 private:
  using Points = std::array<Point, kLanes>;
  /// Where directions lie between the deep sea (< 0), the coast (0) and the heart of a continent (1 and
  /// more).
  struct Continent {
    LanePlaces warped;
    LaneFloats inland;
  };
  Continent continent_at(const LanePlaces& u) const;
  Points points_at(const LanePlaces& u) const;
  LaneFloats mountains_at(const LanePlaces& u, const Continent& continent) const;

  std::uint32_t seed_;
  float coast_ = 0.0f;  ///< value of the continental field that 62 % of the planet lies below
};

}  // namespace globe::planet
