#pragma once

#include <vector>

namespace globe::clipmap {

/// Inclusive range of nodes of one diamond.
struct NodeRect {
  int i0 = 0, i1 = -1, j0 = 0, j1 = -1;

  bool empty() const { return i1 < i0 || j1 < j0; }
  int width() const { return i1 - i0 + 1; }
  int height() const { return j1 - j0 + 1; }
  bool holds(int i, int j) const { return i >= i0 && i <= i1 && j >= j0 && j <= j1; }
  friend bool operator==(const NodeRect&, const NodeRect&) = default;
};

/// What two rectangles have in common; empty when nothing.
NodeRect intersect(const NodeRect& a, const NodeRect& b);

/// Parts of `wanted` outside `held`: at most four rectangles without overlap.
std::vector<NodeRect> difference(const NodeRect& wanted, const NodeRect& held);

/// The same of sets of rectangles without overlap.
std::vector<NodeRect> difference(std::vector<NodeRect> wanted, const std::vector<NodeRect>& held);

/// What sets of rectangles without overlap have in common.
std::vector<NodeRect> intersect(const std::vector<NodeRect>& a, const std::vector<NodeRect>& b);

}  // namespace globe::clipmap
