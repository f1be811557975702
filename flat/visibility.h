#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "flat/terrain.h"

namespace globe::flat {

/// What can be seen from where in a region: its potentially visible sets, computed once (Wagner 2003).
///
/// Cells are patches times 32 layers, from the lowest ground up to three times the ground's range; from each
/// cell it is known of every patch whether anything of it can be seen. A patch that is seen from a place is
/// seen from every place above, so for each pair of patches the lowest such layer says it all: a byte a pair,
/// where a bit a cell and patch would take four.
///
/// No patch that can be seen is left out: one counts as hidden only where posts that are joined by edges of
/// the mesh make a wall across all that lies between, everywhere higher than any line of sight there. That is
/// of level 0; coarser meshes lower a wall by no more than the error they are drawn with.
class Visibility {
 public:
  static constexpr int kLayers = 32;

  /// On all threads. `progress` hears of the share done.
  static Visibility compute(const Terrain& terrain, const std::function<void(double)>& progress = {});
  /// What write() wrote. Throws globe::Error where the file is none, or is of another region.
  static Visibility read(const std::filesystem::path& file, const Terrain& terrain);
  /// Whole or not at all. Throws globe::Error.
  void write(const std::filesystem::path& file, bool overwrite) const;

  /// Whether a patch may be seen from a place of the frame; true where the place is outside the cells.
  bool may_see(const dvec3& eye, std::size_t patch) const;
  /// Share of the pairs of cells and patches that are hidden.
  double hidden_share() const;
  std::size_t bytes() const { return first_seen_.size(); }

 private:
  /// Everything seen from everywhere.
  explicit Visibility(const Terrain& terrain);
  std::size_t patch_at(double x_m, double y_m) const;

  std::uint64_t ground_ = 0;  ///< hash of the region's posts
  int east_ = 0, north_ = 0;
  double west_m_ = 0, south_m_ = 0, patch_m_ = 0;
  double low_m_ = 0, layer_m_ = 0;
  std::vector<std::uint8_t> first_seen_;  ///< layer, by cell's patch and patch seen; kLayers: from none
};

}  // namespace globe::flat
