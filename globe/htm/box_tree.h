#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "globe/htm/trixel.h"

namespace globe::htm {

/// An axis-aligned box, its faces included.
struct Box {
  dvec3 low{0.0}, high{0.0};

  bool meets(const Box& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y &&
           low.z <= other.high.z && other.low.z <= high.z;
  }
};

/// The smallest box around some points, grown by `margin` on all sides.
inline Box box_around(std::span<const dvec3> points, double margin) {
  Box box{points[0], points[0]};
  for (const dvec3& p : points) {
    box.low = glm::min(box.low, p);
    box.high = glm::max(box.high, p);
  }
  return {box.low - dvec3(margin), box.high + dvec3(margin)};
}

/// A box that holds a whole trixel.
Box trixel_box(const Corners& trixel);

/// Boxes in a balanced binary tree, so that the few that a query meets are found among many.
///
/// Halved at the median of the longer side of their centres: depth log2(n / kLeafSize), never more than
/// kDeepest.
class BoxTree {
 public:
  explicit BoxTree(std::span<const Box> boxes);

  /// Whether `visit` answers true for any box that meets the query: asks it index by index, until the first
  /// true. `meets(box)` is asked of boxes of the tree, and of boxes around several of them.
  template <typename Meets, typename Visit>
  bool any(const Meets& meets, const Visit& visit) const;

 private:
  struct Node {
    Box box;
    std::uint32_t first = 0;  ///< leaf: into items_; else the second child (the first follows the node)
    std::uint32_t count = 0;  ///< 0: not a leaf
  };
  static constexpr std::size_t kLeafSize = 4;
  static constexpr std::size_t kDeepest = 40;

  void build(std::span<const Box> boxes, std::size_t first, std::size_t count);

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> items_;
  std::vector<Box> item_boxes_;  ///< in the order of items_
};

template <typename Meets, typename Visit>
bool BoxTree::any(const Meets& meets, const Visit& visit) const {
  if (nodes_.empty()) return false;
  std::array<std::uint32_t, kDeepest> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t at = stack[--depth];
    const Node& node = nodes_[at];
    if (!meets(node.box)) continue;
    if (node.count == 0) {
      stack[depth++] = node.first;
      stack[depth++] = at + 1;
      continue;
    }
    for (std::uint32_t k = node.first; k < node.first + node.count; ++k)
      if (meets(item_boxes_[k]) && visit(items_[k])) return true;
  }
  return false;
}

}  // namespace globe::htm
