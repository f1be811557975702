// H6: HTM's vertices against quadruple precision, and the same bits from both sides of every edge.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "globe/geo/ellipsoid.h"
#include "globe/htm/midpoint.h"
#include "globe/htm/trixel.h"
#include "tests/hard/quad.h"
#include "tests/hard/table.h"

namespace {

using globe::htm::Corners;
using globe::htm::kMaxLevel;
using globe::htm::Trixel;
using hard::cases;
using hard::kNanometre;
using hard::quad;
using hard::square_root;

constexpr double kVertexError = 10 * kNanometre;

template <typename T>
T square_root(T x) {
  return std::sqrt(x);
}

template <typename T>
using Vector = std::array<T, 3>;

template <typename T>
Vector<T> midpoint(const Vector<T>& a, const Vector<T>& b) {
  const Vector<T> sum{a[0] + b[0], a[1] + b[1], a[2] + b[2]};
  const T length = square_root(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
  return {sum[0] / length, sum[1] / length, sum[2] / length};
}

/// The corners by the published recursion in another arithmetic.
template <typename T>
std::array<Vector<T>, 3> corners(Trixel t) {
  const int level = globe::htm::level(t);
  std::array<Vector<T>, 3> v;
  const Corners root = globe::htm::corners({t.id >> (2 * level)});
  for (std::size_t k = 0; k < 3; ++k)
    v[k] = {static_cast<T>(root[k].x), static_cast<T>(root[k].y), static_cast<T>(root[k].z)};
  for (int below = level - 1; below >= 0; --below) {
    const Vector<T> w0 = midpoint(v[1], v[2]), w1 = midpoint(v[0], v[2]), w2 = midpoint(v[0], v[1]);
    switch (t.id >> (2 * below) & 3) {
      case 0:
        v = {v[0], w2, w1};
        break;
      case 1:
        v = {v[1], w0, w2};
        break;
      case 2:
        v = {v[2], w1, w0};
        break;
      default:
        v = {w0, w1, w2};
    }
  }
  return v;
}

/// Metres on the Earth between a vertex and its quadruple value.
template <typename T>
double error_m(const Vector<T>& seen, const Vector<quad>& truth) {
  quad sum = 0;
  for (std::size_t k = 0; k < 3; ++k) sum += (seen[k] - truth[k]) * (seen[k] - truth[k]);
  return globe::geo::kWgs84.a * std::sqrt(static_cast<double>(sum));
}

Trixel random_trixel(std::mt19937_64& random, int level) {
  return {(8ULL << (2 * level)) + random() % (8ULL << (2 * level))};
}

TEST(H6, DeepVerticesAreWithin10Nanometres) {
  std::mt19937_64 random(60);
  double worst = 0, worst_float = 0;
  const std::size_t count = cases(180'000);
  for (std::size_t k = 0; k < count; ++k) {
    const Trixel t = random_trixel(random, 20 + static_cast<int>(k % 9));
    const auto truth = corners<quad>(t);
    const Corners seen = globe::htm::corners(t);
    const auto in_float = corners<float>(t);
    for (std::size_t c = 0; c < 3; ++c) {
      worst = std::max(worst, error_m(Vector<double>{seen[c].x, seen[c].y, seen[c].z}, truth[c]));
      worst_float = std::max(worst_float, error_m(in_float[c], truth[c]));
    }
  }
  hard::report("H6", "vertices of levels 20-28 against __float128, " + std::to_string(3 * count), "10 nm",
               hard::figure(worst / kNanometre) + " nm");
  hard::report("H6", "negative control: the same in float", "> 10 nm", hard::figure(worst_float) + " m");
  EXPECT_LE(worst, kVertexError);
  EXPECT_GT(worst_float, kVertexError);
}

/// Edges of t whose midpoint differs by a bit when computed from the trixel across.
int differing_edges(Trixel t) {
  int count = 0;
  const Corners own = globe::htm::corners(t);
  const auto across = globe::htm::neighbors(t);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto mid = globe::htm::midpoint(own[(k + 1) % 3], own[(k + 2) % 3]);
    const Corners theirs = globe::htm::corners(across[k]);
    const bool shared = globe::htm::midpoint(theirs[0], theirs[1]) == mid ||
                        globe::htm::midpoint(theirs[1], theirs[2]) == mid ||
                        globe::htm::midpoint(theirs[2], theirs[0]) == mid;
    count += !shared;
  }
  return count;
}

TEST(H6, MidpointsAreTheSameBitsFromBothSides) {
  std::size_t different = 0, edges = 0;
  for (int level = 0; level <= 8; ++level)
    for (std::uint64_t id = 8ULL << (2 * level); id < 16ULL << (2 * level); ++id, edges += 3)
      different += static_cast<std::size_t>(differing_edges({id}));
  std::mt19937_64 random(61);
  const std::size_t deeper = cases(1'000'000) / 3;
  for (std::size_t k = 0; k < deeper; ++k, edges += 3)
    different +=
        static_cast<std::size_t>(differing_edges(random_trixel(random, 9 + static_cast<int>(k % 19))));
  hard::report("H6",
               "edges whose midpoint differs between its sides: all to level 8, random deeper, " +
                   std::to_string(edges),
               "0", std::to_string(different));
  EXPECT_EQ(different, 0u);
}

}  // namespace
