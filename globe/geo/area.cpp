#include "globe/geo/area.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace globe::geo {
namespace {

struct Node {
  double x, weight;
};

/// Gauss-Legendre nodes of order 6 on [0, 1] (Abramowitz and Stegun 1964, table 25.4, halved and shifted).
constexpr std::array<Node, 6> kGauss{{{0.5 - 0.4662347571015760, 0.0856622461895852},
                                      {0.5 - 0.3306046932331323, 0.1803807865240693},
                                      {0.5 - 0.1193095930415985, 0.2339569672863455},
                                      {0.5 + 0.1193095930415985, 0.2339569672863455},
                                      {0.5 + 0.3306046932331323, 0.1803807865240693},
                                      {0.5 + 0.4662347571015760, 0.0856622461895852}}};

/// A flat triangle: a corner and the two sides from it.
struct Flat {
  dvec3 corner, s, t;
};

/// The integral of |x|^-3 (1 - e² x_z² / |x|²)^-2 over a flat triangle, in units of the parallelogram s, t:
/// the triangle is a square with one side shrunk to the corner.
double rule(const Flat& f, double e2) {
  double sum = 0;
  for (const Node& along : kGauss) {
    for (const Node& across : kGauss) {
      const dvec3 x = f.corner + along.x * ((1.0 - across.x) * f.s + across.x * f.t);
      const double xx = glm::dot(x, x);
      const double squeezed = xx - e2 * x.z * x.z;
      sum += along.weight * across.weight * along.x * std::sqrt(xx) / (squeezed * squeezed);
    }
  }
  return sum;
}

double integral(const Flat& f, double e2, double estimate, int depth) {
  constexpr double kTolerance = 1e-13;
  constexpr int kDeepest = 20;
  const dvec3 s = 0.5 * f.s;
  const dvec3 t = 0.5 * f.t;
  const std::array<Flat, 4> quarters{Flat{f.corner, s, t}, Flat{f.corner + s, s, t}, Flat{f.corner + t, s, t},
                                     Flat{f.corner + s + t, -s, -t}};
  std::array<double, 4> part{};
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += part[k] = 0.25 * rule(quarters[k], e2);
  if (std::abs(sum - estimate) <= kTolerance * sum || depth == kDeepest) return sum;
  sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += 0.25 * integral(quarters[k], e2, 4.0 * part[k], depth + 1);
  return sum;
}

}  // namespace

double surface_area(const Ellipsoid& ellipsoid, const std::array<dvec3, 3>& corners) {
  const Flat f{corners[0], corners[1] - corners[0], corners[2] - corners[0]};
  const double e2 = ellipsoid.f * (2.0 - ellipsoid.f);
  const double b = ellipsoid.b();
  return b * b * glm::dot(f.corner, glm::cross(f.s, f.t)) * integral(f, e2, rule(f, e2), 0);
}

}  // namespace globe::geo
