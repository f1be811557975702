#include "flat/fractal/culling.h"

namespace globe::flat::fractal {

View view_of(const glm::dmat4& m) {
  const auto row = [&](int k) { return std::array<double, 4>{m[0][k], m[1][k], m[2][k], m[3][k]}; };
  const std::array<double, 4> x = row(0), y = row(1), w = row(3);
  // Inside is -w <= x <= w, -w <= y <= w, w >= 0.
  const auto plane = [&](double of_x, double of_y, double of_w) {
    const auto part = [&](std::size_t k) { return of_x * x[k] + of_y * y[k] + of_w * w[k]; };
    return Plane<double>{part(0), part(1), part(2), part(3)};
  };
  return {plane(-1, 0, -1), plane(1, 0, -1), plane(0, -1, -1), plane(0, 1, -1), plane(0, 0, -1)};
}

HeightTree::HeightTree(int log2_side) : log2_side_(log2_side) {
  nodes_.resize(((std::size_t{1} << (2 * log2_side + 2)) - 1) / 3);
}

struct HeightTree::Query {
  const View& view;
  const std::array<double, 3>& origin;
  double block;
  std::vector<int>& visible;
  Counts counts;
};

void HeightTree::descend(Query& query, std::size_t node, int column, int row, int size,
                         unsigned planes) const {
  if (planes != 0) {
    const Range& range = nodes_[node];
    const double west = query.origin[0] + column * query.block;
    const double south = query.origin[1] + row * query.block;
    const double side = size * query.block;
    const Box<double> box{{west, south, query.origin[2] + static_cast<double>(range.low)},
                          {west + side, south + side, query.origin[2] + static_cast<double>(range.high)}};
    ++query.counts.boxes;
    for (unsigned k = 0; k < query.view.size(); ++k) {
      if ((planes >> k & 1u) == 0) continue;
      ++query.counts.planes;
      const Side side_of_plane = side_of(query.view[k], box);
      if (side_of_plane == Side::kOutside) return;
      if (side_of_plane == Side::kInside) planes &= ~(1u << k);
    }
  }
  if (size == 1) {
    query.visible.push_back(row * side() + column);
    return;
  }
  const int half = size / 2;
  const int east =
      query.origin[0] + (column + half) * query.block < 0.0 ? 1 : 0;  // where the eye is from here
  const int north = query.origin[1] + (row + half) * query.block < 0.0 ? 2 : 0;
  for (int step = 0; step < 4; ++step) {
    const int k = step ^ (east | north);
    descend(query, 4 * node + 1 + static_cast<std::size_t>(k), column + half * (k & 1), row + half * (k >> 1),
            half, planes);
  }
}

HeightTree::Counts HeightTree::visible(const View& view, const std::array<double, 3>& origin, double block,
                                       std::vector<int>& visible) const {
  visible.clear();
  Query query{view, origin, block, visible, {}};
  descend(query, 0, 0, 0, side(), (1u << view.size()) - 1);
  return query.counts;
}

}  // namespace globe::flat::fractal
