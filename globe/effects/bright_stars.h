#pragma once

#include <span>

namespace globe::effects {

/// A star as catalogues have it, ICRS at J2000.
struct BrightStar {
  int hipparcos = 0;
  double right_ascension_deg = 0;
  double declination_deg = 0;
  float magnitude = 0;  ///< apparent, visual
  float b_minus_v = 0;  ///< color index
};

/// The stars up to magnitude 5, by Hipparcos number.
std::span<const BrightStar> bright_stars();

}  // namespace globe::effects
