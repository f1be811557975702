// H23: the height of the drawn surface, against quadruple precision and every trixel near the place.

#include "globe/planet/drawn_ground.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "globe/htm/trixel.h"
#include "globe/planet/cell.h"
#include "tests/hard/directions.h"
#include "tests/hard/quad.h"
#include "tests/hard/table.h"
#include "tests/node_planet.h"
#include "tests/temporary_folder.h"

namespace {

using globe::geo::Ellipsoid;
using globe::htm::Trixel;
using globe::planet::Node;
using globe::planet::Surface;
using hard::dvec3;
using hard::quad;
using hard::QuadVector;

constexpr double kDrawnError_m = 1e-8;

QuadVector in_quad(const dvec3& u) { return {u.x, u.y, u.z}; }

QuadVector scaled(const QuadVector& a, quad s) { return {a.x * s, a.y * s, a.z * s}; }

/// E(u) + h u.
QuadVector position(const Ellipsoid& e, const dvec3& normal, quad h) {
  const QuadVector u = in_quad(normal);
  const quad a2 = static_cast<quad>(e.a) * e.a;
  const quad b = static_cast<quad>(e.a) * (1 - static_cast<quad>(e.f)), b2 = b * b;
  const quad length = hard::square_root(a2 * (u.x * u.x + u.y * u.y) + b2 * u.z * u.z);
  return QuadVector{a2 * u.x / length, a2 * u.y / length, b2 * u.z / length} + scaled(u, h);
}

std::array<Node, 3> nodes_of(Trixel t) {
  const auto c = globe::planet::cell_from_trixel(t);
  if (c.half == 1)
    return {Node{c.d, c.level, c.i + 1, c.j + 1}, Node{c.d, c.level, c.i, c.j + 1},
            Node{c.d, c.level, c.i + 1, c.j}};
  return {Node{c.d, c.level, c.i, c.j}, Node{c.d, c.level, c.i + 1, c.j}, Node{c.d, c.level, c.i, c.j + 1}};
}

/// Where the normal meets the trixel's plane, and the least barycentric weight there.
struct Meeting {
  quad height, least_weight;
};

Meeting meet(const Surface& surface, const dvec3& u, Trixel t) {
  const QuadVector normal = in_quad(u);
  const QuadVector foot = position(surface.ellipsoid(), u, 0);
  std::array<QuadVector, 3> corner;
  const std::array<Node, 3> nodes = nodes_of(t);
  for (std::size_t k = 0; k < 3; ++k) {
    corner[k] = position(surface.ellipsoid(), globe::planet::node_direction(nodes[k]),
                         surface.drawn_height(surface.height(nodes[k]))) +
                scaled(foot, -1);
  }
  const auto triple = [](const QuadVector& a, const QuadVector& b, const QuadVector& c) {
    return hard::dot(a, hard::cross(b, c));
  };
  std::array<quad, 3> weight;
  quad sum = 0;
  for (std::size_t k = 0; k < 3; ++k)
    sum += weight[k] = triple(normal, corner[(k + 1) % 3], corner[(k + 2) % 3]);
  if (sum <= 0) return {0, -1e30};  // seen from behind, on the other side of the planet
  return {triple(corner[0], corner[1], corner[2]) / sum,
          *std::min_element(weight.begin(), weight.end()) / sum};
}

/// Height on the trixel, of all within three edges of the place, that the normal meets best.
quad true_height(const Surface& surface, const dvec3& u, int level) {
  std::set<Trixel> near{globe::htm::trixel_at(u, level)};
  for (int step = 0; step < 3; ++step) {
    const std::set<Trixel> before = near;
    for (const Trixel t : before)
      for (const Trixel beside : globe::htm::neighbors(t)) near.insert(beside);
  }
  Meeting best{0, -1e30};
  for (const Trixel t : near) {
    const Meeting meeting = meet(surface, u, t);
    if (meeting.least_weight > best.least_weight) best = meeting;
  }
  return best.height;
}

dvec3 place(std::mt19937_64& random, std::size_t k, int level) {
  std::uniform_real_distribution<double> unit(0, 1);
  const auto corners = globe::htm::corners(globe::htm::trixel_at(hard::random_direction(random), level));
  switch (k % 6) {
    case 0:
      return corners[k % 3];
    case 1: {
      const double share = unit(random);
      return glm::normalize(share * corners[0] + (1 - share) * corners[1]);
    }
    case 2: {
      dvec3 axis{0, 0, 0};
      axis[static_cast<int>(random() % 3)] = random() % 2 == 0 ? 1 : -1;
      const double off = std::ldexp(1.0, -static_cast<int>(random() % 52));
      return glm::normalize(axis + off * hard::random_direction(random));
    }
    case 3:
      return globe::geo::normal_from_degrees(180 * unit(random) - 90,
                                             90.0 * static_cast<double>(random() % 4));
    default:
      return hard::random_direction(random);
  }
}

TEST(HardDrawnGround, IsWithinTenNanometresOfQuadruplePrecision) {
  std::mt19937_64 random(23);
  const tests::TemporaryFolder folder;
  for (const Ellipsoid& ellipsoid : {globe::geo::kWgs84, Ellipsoid{6.4e6, 0.1}, globe::geo::kMoon}) {
    const auto path = folder / std::to_string(ellipsoid.f);
    tests::write_node_planet(path, 6, ellipsoid, tests::hashed_heights(7, -9000, 9000));
    const auto surface = tests::open_surface(path);
    double worst = 0;
    const std::size_t count = hard::cases(20'000);
    for (std::size_t k = 0; k < count; ++k) {
      const int level = static_cast<int>(k / 6 % 10);
      const dvec3 u = place(random, k, level);
      const quad truth = true_height(*surface, u, level);
      const double seen = globe::planet::drawn_ground(*surface, u, level).height_m;
      worst = std::max(worst, std::abs(static_cast<double>(truth - seen)));
    }
    EXPECT_LE(worst, kDrawnError_m) << ellipsoid.f;
    hard::report("H23", "height of the drawn surface, f = " + hard::figure(ellipsoid.f) + ", nm", "10",
                 hard::figure(worst * 1e9));
  }
}

}  // namespace
