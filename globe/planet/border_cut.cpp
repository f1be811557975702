#include "globe/planet/border_cut.h"

#include <bit>
#include <cstdint>
#include <glm/geometric.hpp>

namespace globe::planet {

dvec3 CutTrixel::center() const { return glm::normalize(corners[0] + corners[1] + corners[2]); }

std::array<CutTrixel, 4> CutTrixel::parts() const {
  const auto c = children_corners(corners);
  const double h0 = 0.5 * (heights[1] + heights[2]);
  const double h1 = 0.5 * (heights[2] + heights[0]);
  const double h2 = 0.5 * (heights[0] + heights[1]);
  return {{{c[0], {heights[0], h2, h1}},
           {c[1], {h2, heights[1], h0}},
           {c[2], {h1, h0, heights[2]}},
           {c[3], {h0, h1, h2}}}};
}

std::size_t BorderCutter::Hash::operator()(const dvec3& u) const {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.0); };  // -0 is 0
  std::uint64_t mixed = bits(u.x);
  for (const double x : {u.y, u.z}) mixed = (mixed ^ (mixed >> 29)) * 0xbf58476d1ce4e5b9U + bits(x);
  return static_cast<std::size_t>((mixed ^ (mixed >> 32)) * 0x94d049bb133111ebU);
}

bool BorderCutter::inside(const dvec3& corner) {
  const auto [found, is_new] = inside_.try_emplace(corner, false);
  if (is_new) found->second = region_.contains(corner);
  return found->second;
}

double BorderCutter::crossing(const dvec3& a, const dvec3& b, int halvings) {
  const bool from_inside = inside(a);
  const dvec3& in = from_inside ? a : b;
  const dvec3& out = from_inside ? b : a;
  const auto [found, is_new] = crossings_.try_emplace(in + 0.5 * out, 0.0);
  if (is_new) {
    double low = 0, high = 1;
    for (int k = 0; k < halvings; ++k) {
      const double middle = 0.5 * (low + high);
      (region_.contains(glm::normalize(in + middle * (out - in))) ? low : high) = middle;
    }
    // At an end of the side when it is next to it: a border often runs along sides.
    found->second = low == 0.0 ? 0.0 : high == 1.0 ? 1.0 : 0.5 * (low + high);
  }
  return from_inside ? found->second : 1.0 - found->second;
}

Piece BorderCutter::inner_piece(const CutTrixel& t, int halvings) {
  std::array<bool, 3> in{};
  for (std::size_t k = 0; k < 3; ++k) in[k] = inside(t.corners[k]);
  const int count = in[0] + in[1] + in[2];
  if (count == 0) return {};
  if (count == 3) return {1.0, t.mean()};
  // The corner that is alone on its side, and the triangle that the line cuts off with it.
  const std::size_t k = in[1] == in[2] ? 0 : in[2] == in[0] ? 1 : 2;
  const std::size_t next = (k + 1) % 3, last = (k + 2) % 3;
  const double to_next = crossing(t.corners[k], t.corners[next], halvings);
  const double to_last = crossing(t.corners[k], t.corners[last], halvings);
  const double share = to_next * to_last;
  const double mean =
      t.heights[k] +
      (to_next * (t.heights[next] - t.heights[k]) + to_last * (t.heights[last] - t.heights[k])) / 3.0;
  if (in[k]) return {share, mean};
  if (share == 1.0) return {};
  return {1.0 - share, (t.mean() - share * mean) / (1.0 - share)};
}

}  // namespace globe::planet
