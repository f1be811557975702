#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace globe::effects {

/// Where a label would stand in a picture, pixels.
struct LabelBox {
  glm::dvec2 low{0.0}, high{0.0};
  double wish = 1.0;  ///< how far it would be seen were it alone, 0 to 1
};

/// How much of each label is shown, 0 to 1, earlier ones before later ones.
///
/// A function of the boxes alone, and continuous in them: as a label comes nearer than kLabelGap to one that
/// matters more it fades, so that none jumps in a film. Two that overlap are never shown both.
/// @param seen  further factor of a label, asked only where it makes a difference
std::vector<double> label_shares(std::span<const LabelBox> boxes,
                                 const std::function<double(std::size_t)>& seen = {});

inline constexpr double kLabelGap = 6.0;  ///< pixels

}  // namespace globe::effects
