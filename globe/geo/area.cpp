#include "globe/geo/area.h"

#include <algorithm>
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

/// |x|^-3 (1 - e² x_z² / |x|²)^-2
double element(const dvec3& x, double e2) {
  const double xx = glm::dot(x, x);
  const double squeezed = xx - e2 * x.z * x.z;
  return std::sqrt(xx) / (squeezed * squeezed);
}

/// The integral of the element over a flat triangle, in units of the parallelogram s, t: the triangle is a
/// square with one side shrunk to the corner.
double rule(const Flat& f, double e2) {
  double sum = 0;
  for (const Node& along : kGauss) {
    for (const Node& across : kGauss) {
      const dvec3 x = f.corner + along.x * ((1.0 - across.x) * f.s + across.x * f.t);
      sum += along.weight * across.weight * along.x * element(x, e2);
    }
  }
  return sum;
}

/// Square of the longest side.
double longest_squared(const Flat& f) {
  const dvec3 third = f.t - f.s;
  return std::max({glm::dot(f.s, f.s), glm::dot(f.t, f.t), glm::dot(third, third)});
}

/// Whether seven points do: on sides up to kSmallSide they err by 2e-14 of the result for |f| <= 0.1, and 64
/// times more on sides twice as long.
bool seven_points_do(double squared, double tolerance) {
  constexpr double kSmallSide = 0.0155, kError = 2e-14;
  const double ratio = squared / (kSmallSide * kSmallSide);
  return ratio <= 1.0 || kError * ratio * ratio * ratio <= tolerance;
}

bool one_point_does(double squared, double tolerance) { return squared <= 4.0 * tolerance; }

/// The same by Radon's rule of degree 5 (Abramowitz and Stegun 1964, 25.4.63).
double small_rule(const Flat& f, double e2) {
  constexpr double kRoot15 = 3.8729833462074168852;
  double sum = 0.225 * element(f.corner + (1.0 / 3.0) * (f.s + f.t), e2);
  for (const double root : {-kRoot15, kRoot15}) {
    const double two = (6.0 + root) / 21.0, one = 1.0 - 2.0 * two;  // weights of the corners in the point
    sum += (155.0 + root) / 1200.0 *
           (element(f.corner + two * (f.s + f.t), e2) + element(f.corner + two * f.s + one * f.t, e2) +
            element(f.corner + one * f.s + two * f.t, e2));
  }
  return 0.5 * sum;
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

double surface_area(const Ellipsoid& ellipsoid, const std::array<dvec3, 3>& corners, double tolerance) {
  const Flat f{corners[0], corners[1] - corners[0], corners[2] - corners[0]};
  const double e2 = ellipsoid.f * (2.0 - ellipsoid.f);
  const double b = ellipsoid.b();
  const double longest = longest_squared(f);
  const double elements = one_point_does(longest, tolerance)
                              ? 0.5 * element(f.corner + (1.0 / 3.0) * (f.s + f.t), e2)
                          : seven_points_do(longest, tolerance) ? small_rule(f, e2)
                                                                : integral(f, e2, rule(f, e2), 0);
  return b * b * glm::dot(f.corner, glm::cross(f.s, f.t)) * elements;
}

}  // namespace globe::geo
