#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <random>

namespace hard {

using glm::dvec3;

/// Uniform on the sphere.
inline dvec3 random_direction(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(dvec3{normal(random), normal(random), normal(random)});
}

/// x moved by a number of units in the last place.
inline double moved(double x, int ulps) {
  const double towards =
      ulps > 0 ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity();
  for (int k = 0; k < std::abs(ulps); ++k) x = std::nextafter(x, towards);
  return x;
}

}  // namespace hard
