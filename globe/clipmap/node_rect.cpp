#include "globe/clipmap/node_rect.h"

#include <algorithm>

namespace globe::clipmap {

NodeRect intersect(const NodeRect& a, const NodeRect& b) {
  return {std::max(a.i0, b.i0), std::min(a.i1, b.i1), std::max(a.j0, b.j0), std::min(a.j1, b.j1)};
}

std::vector<NodeRect> difference(const NodeRect& wanted, const NodeRect& held) {
  if (wanted.empty()) return {};
  const NodeRect common = held.empty() ? NodeRect{} : intersect(wanted, held);
  if (common.empty()) return {wanted};
  std::vector<NodeRect> parts;
  const auto add = [&](const NodeRect& part) {
    if (!part.empty()) parts.push_back(part);
  };
  add({wanted.i0, wanted.i1, wanted.j0, common.j0 - 1});
  add({wanted.i0, wanted.i1, common.j1 + 1, wanted.j1});
  add({wanted.i0, common.i0 - 1, common.j0, common.j1});
  add({common.i1 + 1, wanted.i1, common.j0, common.j1});
  return parts;
}

std::vector<NodeRect> difference(std::vector<NodeRect> wanted, const std::vector<NodeRect>& held) {
  for (const NodeRect& hole : held) {
    std::vector<NodeRect> left;
    for (const NodeRect& rect : wanted) {
      for (const NodeRect& part : difference(rect, hole)) left.push_back(part);
    }
    wanted = std::move(left);
  }
  return wanted;
}

std::vector<NodeRect> intersect(const std::vector<NodeRect>& a, const std::vector<NodeRect>& b) {
  std::vector<NodeRect> common;
  for (const NodeRect& p : a) {
    for (const NodeRect& q : b) {
      const NodeRect both = intersect(p, q);
      if (!both.empty()) common.push_back(both);
    }
  }
  return common;
}

}  // namespace globe::clipmap
