#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace globe::flat::fractal {

/// How the posts between coarser posts are made.
///
/// Where the two leave marks: how much the ground bends (mean square of the second difference, posts 4 apart,
/// H = 0.85, contrast 0) at the columns of posts six levels up, over that at all columns; and the mean square
/// difference along the axes over that along slants of the same length, 50 posts:
///
///                      bends there   axes / slants
///     diamond-square      1.84           1.02        lines and peaks at posts of coarse levels
///     square-square       0.78           0.99        none (1.00 at neighbouring posts)
///
/// Tried too: diamond-square with every post moved again at every level (Saupe 1988, successive random
/// additions). It does nothing against creases (2.10), for a third more random numbers, and was left out.
enum class Method {
  /// As Christopoulos has it (after Fournier, Fussell and Carpenter 1982): a cell's middle is the mean of its
  /// four corners, then the middle of an edge the mean of the four posts around it, each moved at random;
  /// posts
  /// once made stay.
  kDiamondSquare,
  /// Four posts within each cell, in the shares 9:3:3:1 of its corners, every one moved: a biquadratic
  /// surface
  /// at each level. (Miller 1986, "The definition and rendering of terrain maps")
  kSquareSquare,
};

std::string_view name_of(Method method);
/// By the words of `--method`; nothing for others.
std::optional<Method> method_by_name(std::string_view name);

/// Endless fractal ground. It is cut into square areas, whose corners are at random heights; each iteration
/// halves the cells, 2^iterations of them along an area's side in the end. The same seed with more iterations
/// is the same ground, finer.
struct Settings {
  std::uint64_t seed = 1;
  Method method = Method::kSquareSquare;
  int iterations = 10;      ///< 1 to 24
  double roughness = 0.85;  ///< H, 0 (jagged) to 1 (smooth): deviations shrink by 2^-H an iteration
  double relief_m = 2000;   ///< deviation of the areas' corners, and of iteration 1 times 2^H; metres, >= 0
  /// How much smoother valleys are than peaks, 0 (alike everywhere) to 1: deviations are multiplied by
  /// 1 - contrast two deviations below the base, by 1 + contrast two above, in proportion between.
  /// (Musgrave's heterogeneous terrain, "Texturing and Modeling", chapter 16)
  double contrast = 0.9;
  double area_m = 16000;  ///< side of an area, metres, > 0
  double base_m = 0;      ///< added to every height, metres

  /// Metres between neighbouring posts.
  double spacing_m() const;
};

/// Throws UsageError, naming the option, for values outside their ranges.
void check(const Settings& settings);

}  // namespace globe::flat::fractal
