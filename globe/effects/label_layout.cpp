#include "globe/effects/label_layout.h"

#include <algorithm>
#include <glm/common.hpp>

namespace globe::effects {
namespace {

/// Of a label before it is shown at all. One that has as much hides what it overlaps wholly.
constexpr double kLeast = 0.3;

/// Along the axis on which two boxes are farther apart, pixels; below 0 they overlap.
double gap(const LabelBox& a, const LabelBox& b) {
  const glm::dvec2 apart = glm::max(a.low - b.high, b.low - a.high);
  return std::max(apart.x, apart.y);
}

}  // namespace

std::vector<double> label_shares(std::span<const LabelBox> boxes,
                                 const std::function<double(std::size_t)>& seen) {
  std::vector<double> shares(boxes.size(), 0.0);
  std::vector<std::size_t> standing;
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    double share = boxes[k].wish;
    for (std::size_t other = 0; other < standing.size() && share > 0.0; ++other) {
      const std::size_t before = standing[other];
      const double free = glm::smoothstep(0.0, kLabelGap, gap(boxes[k], boxes[before]));
      share *= 1.0 - std::min(shares[before] / kLeast, 1.0) * (1.0 - free);
    }
    if (share > 0.0 && seen) share *= seen(k);
    if (share <= 0.0) continue;
    shares[k] = share;
    standing.push_back(k);
  }
  for (double& share : shares) share = glm::smoothstep(kLeast, 0.9, share);
  return shares;
}

}  // namespace globe::effects
