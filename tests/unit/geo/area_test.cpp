#include "globe/geo/area.h"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "globe/htm/trixel.h"

namespace globe::geo {
namespace {

double total_area(const Ellipsoid& ellipsoid, int level) {
  double sum = 0, lost = 0;  // Kahan: the sum of many must not hide the error of each
  for (std::uint64_t id = htm::kFirstRoot << (2 * level); id < 16ULL << (2 * level); ++id) {
    const double term = surface_area(ellipsoid, htm::corners({id})) - lost;
    const double next = sum + term;
    lost = (next - sum) - term;
    sum = next;
  }
  return sum;
}

TEST(SurfaceArea, OfALevelSumsToThatOfTheEllipsoid) {
  for (const Ellipsoid& e : {kWgs84, kMars, kMoon, Ellipsoid{1.0, 0.1}, Ellipsoid{1.0, -0.1}}) {
    const double expected = GeographicLib::Geodesic(e.a, e.f).EllipsoidArea();
    for (const int level : {0, 1, 2, 4, 6}) {
      EXPECT_NEAR(total_area(e, level) / expected, 1.0, 1e-13) << "f " << e.f << " level " << level;
    }
  }
}

TEST(SurfaceArea, OfSmallTrianglesIsThatOfLargeOnesCutUp) {
  // From level 7 on another rule takes over; a trixel of level 6 is cut into both kinds.
  std::mt19937_64 random(43);
  for (const Ellipsoid& e : {kWgs84, kMoon, Ellipsoid{1.0, 0.1}, Ellipsoid{1.0, -0.1}}) {
    for (int trial = 0; trial < 200; ++trial) {
      const htm::Trixel t{(htm::kFirstRoot << 12) + random() % (8ULL << 12)};
      for (const int below : {1, 2}) {
        double sum = 0;
        for (std::uint64_t k = 0; k < 1ULL << (2 * below); ++k)
          sum += surface_area(e, htm::corners({(t.id << (2 * below)) + k}));
        EXPECT_NEAR(sum / surface_area(e, htm::corners(t)), 1.0, 1e-13) << htm::name(t) << " f " << e.f;
      }
    }
  }
}

TEST(SurfaceArea, ErrsByLessThanTheToleranceThatIsAllowed) {
  std::mt19937_64 random(47);
  int coarser = 0;
  for (const Ellipsoid& e : {kWgs84, kMoon, Ellipsoid{1.0, 0.1}}) {
    for (int trial = 0; trial < 2000; ++trial) {
      const int level = trial % 12;
      const htm::Trixel t{(htm::kFirstRoot << (2 * level)) + random() % (8ULL << (2 * level))};
      const double exact = surface_area(e, htm::corners(t));
      for (const double tolerance : {1e-3, 2e-5, 1e-8}) {
        const double area = surface_area(e, htm::corners(t), tolerance);
        EXPECT_NEAR(area / exact, 1.0, tolerance) << htm::name(t) << " f " << e.f;
        coarser += area != exact;
      }
    }
  }
  EXPECT_GT(coarser, 1000) << "the tolerance is made use of";
}

TEST(SurfaceArea, OfTheFourChildrenIsThatOfTheParent) {
  std::mt19937_64 random(41);
  for (int level = 0; level < 12; ++level) {
    const htm::Trixel t{(htm::kFirstRoot << (2 * level)) + random() % (8ULL << (2 * level))};
    double sum = 0;
    for (int k = 0; k < 4; ++k) sum += surface_area(kWgs84, htm::corners(htm::child(t, k)));
    // Each rounded corner moves a side by up to 1e-16 of the radius, which is 2^level / 1e16 of the side.
    const double tolerance = 1e-13 + 1e-15 * std::ldexp(1.0, level);
    EXPECT_NEAR(sum / surface_area(kWgs84, htm::corners(t)), 1.0, tolerance) << htm::name(t);
  }
}

TEST(SurfaceArea, OnTheSphereIsTheSolidAngle) {
  // Spherical excess by L'Huilier's theorem in the form of Eriksson 1990.
  std::mt19937_64 random(42);
  std::normal_distribution<double> normal;
  const auto direction = [&] {
    return glm::normalize(dvec3{normal(random), normal(random), normal(random)});
  };
  for (int trial = 0; trial < 1000; ++trial) {
    const std::array<dvec3, 3> c{direction(), direction(), direction()};
    const double det = glm::dot(c[0], glm::cross(c[1], c[2]));
    const double denominator = 1 + glm::dot(c[0], c[1]) + glm::dot(c[1], c[2]) + glm::dot(c[2], c[0]);
    if (std::abs(det) < 0.05 || denominator < 0.2) continue;
    EXPECT_NEAR(surface_area({2.0, 0.0}, c), 4.0 * 2.0 * std::atan2(det, denominator), 1e-12);
  }
}

TEST(SurfaceArea, AtThePoleOfAnOblateEllipsoidIsLargerThanAtTheEquator) {
  // 1 / (1 - e² sin² lat)² is the ratio for small triangles.
  const auto small = [](const dvec3& u) { return htm::corners(htm::trixel_at(u, 20)); };
  const auto ratio = [&](const dvec3& u) {
    return surface_area(kWgs84, small(u)) / surface_area({kWgs84.b(), 0.0}, small(u));
  };
  const double e2 = kWgs84.f * (2 - kWgs84.f);
  EXPECT_NEAR(ratio(normal_from_degrees(89.999, 10)), 1 / ((1 - e2) * (1 - e2)), 1e-8);
  EXPECT_NEAR(ratio(normal_from_degrees(0.001, 10)), 1.0, 1e-8);
}

}  // namespace
}  // namespace globe::geo
