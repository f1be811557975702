#pragma once

#include <vector>

namespace globe::scene {

/// A curve through values at increasing times, smooth in slope, which between two neighbours stays between
/// their values: no overshoot.
///
/// Cubic Hermite pieces with the slopes of Fritsch and Butland 1984, "A method for constructing local
/// monotone piecewise cubic interpolants": weighted harmonic means of both sides', 0 at a turn.
class MonotoneCubic {
 public:
  /// @param stops  where the slope is 0 in any case
  /// REQUIRES: two or more times, increasing, and as many values and stops
  MonotoneCubic(std::vector<double> times, std::vector<double> values, const std::vector<bool>& stops);

  /// The first or last value outside the times.
  double at(double time) const;

 private:
  std::vector<double> times_, values_, slopes_;
};

/// The piece of increasing times that a time falls into, from 0 to times.size() - 2.
std::size_t piece_at(const std::vector<double>& times, double time);

}  // namespace globe::scene
