#include "globe/htm/box_tree.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <numeric>

namespace globe::htm {

Box trixel_box(const Corners& t) {
  constexpr double kMargin = 1e-15;  // more than the rounding of the faces
  const dvec3 a = t[1] - t[0], b = t[2] - t[1], c = t[0] - t[2];
  const double side2 = std::max({glm::dot(a, a), glm::dot(b, b), glm::dot(c, c)});
  // A trixel rises above its flat triangle by less: by r²/2 (1 + r²/4 ...), r² <= side²/3; 0.21 side² in an
  // octant.
  return box_around(t, 0.25 * side2 + kMargin);
}

BoxTree::BoxTree(std::span<const Box> boxes) : items_(boxes.size()) {
  std::iota(items_.begin(), items_.end(), 0U);
  nodes_.reserve(boxes.size());
  if (!boxes.empty()) build(boxes, 0, boxes.size());
  item_boxes_.reserve(boxes.size());
  for (const std::uint32_t item : items_) item_boxes_.push_back(boxes[item]);
}

void BoxTree::build(std::span<const Box> boxes, std::size_t first, std::size_t count) {
  const auto begin = items_.begin() + static_cast<std::ptrdiff_t>(first);
  Node node;
  node.box = boxes[*begin];
  Box centers{node.box.low + node.box.high, node.box.low + node.box.high};
  for (auto item = begin; item != begin + static_cast<std::ptrdiff_t>(count); ++item) {
    const Box& box = boxes[*item];
    node.box = {glm::min(node.box.low, box.low), glm::max(node.box.high, box.high)};
    centers = {glm::min(centers.low, box.low + box.high), glm::max(centers.high, box.low + box.high)};
  }
  const std::size_t at = nodes_.size();
  if (count <= kLeafSize) {
    node.first = static_cast<std::uint32_t>(first);
    node.count = static_cast<std::uint32_t>(count);
    nodes_.push_back(node);
    return;
  }
  nodes_.push_back(node);
  const dvec3 size = centers.high - centers.low;
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const std::size_t half = count / 2;
  std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(half),
                   begin + static_cast<std::ptrdiff_t>(count), [&](std::uint32_t p, std::uint32_t q) {
                     const double x = boxes[p].low[axis] + boxes[p].high[axis];
                     const double y = boxes[q].low[axis] + boxes[q].high[axis];
                     return x != y ? x < y : p < q;
                   });
  build(boxes, first, half);
  nodes_[at].first = static_cast<std::uint32_t>(nodes_.size());
  build(boxes, first + half, count - half);
}

}  // namespace globe::htm
