#pragma once

#include <array>
#include <cstddef>

#include "converters/footprint.h"
#include "converters/strips.h"

namespace converters {

/// Lines of constant latitude across a range of rows: evenly spaced, symmetric about its middle, no farther
/// apart than rows, and at least eight.
struct EvenLines {
  double first, step;
  int count;

  EvenLines(double top, double bottom);
  double y(int line) const { return first + line * step; }
};

/// Cuts a footprint into strips along even lines.
class FootprintLines {
 public:
  static constexpr std::size_t kAtOnce = 8;  ///< lines: the widest vectors hold as many numbers

  FootprintLines(const MapGeometry& geometry, const Footprint& footprint);

  bool more() const { return begin_ < lines_.count; }

  /// The strips of the next lines, each weighing as its row does (row_weight). Columns count from the
  /// footprint's origin.
  struct Strips {
    std::array<Strip, kAtOnce * 3> strip;
    std::size_t count = 0;
  };
  Strips next();

  /// The sides of a footprint; unused ones are crossed by no line.
  static constexpr std::size_t kSides = 6;
  struct Sides {
    std::array<double, kSides> top{}, bottom{}, x{}, slope{};
    double left = 0, right = 0;  ///< bounds of all
  };
  /// The first and the last column where lines meet the sides, and how often they do.
  struct Crossings {
    std::array<double, kAtOnce> y, a, b, count;
  };

 private:
  void add_strips_of(double y, double weight, Strips& strips) const;

  const MapGeometry& geometry_;
  EvenLines lines_;
  Sides sides_;
  int begin_ = 0;
};

}  // namespace converters
