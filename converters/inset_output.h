#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "converters/inset_grid.h"
#include "globe/planet/planet_file.h"

namespace converters {

/// What an inset lays over a layer, at its own level; nodes that diamonds share have the same in each.
struct InsetSamples {
  /// Heights in metres: one grid; colors in linear light: three. NaN where nothing is known, which must be
  /// far (InsetInfo, kInsetMargin) from where the weight is above 0.
  std::vector<InsetGrid<float>> values;
  InsetGrid<float> weight;  ///< 0 to 1
};

/// An inset ready to be listed in planet.json: its files are in the folder.
struct InsetOutput {
  globe::planet::StoredInset stored;
  std::vector<std::filesystem::path> made;  ///< files that were not there before
};

/// Writes the files of an inset into the planet's folder: to disk under a temporary name each, then to a name
/// made of their content. A file of that name that is there already is the same and stays. Throws
/// globe::Error when the disk is full or the weight is 0 everywhere; what was made is then removed.
InsetOutput write_inset(const std::filesystem::path& folder, const std::string& name,
                        const std::string& layer, const InsetSamples& samples, int tile_size);

/// A planet being changed: holds off other programs that would change it too, and clears away what a killed
/// one has left.
class PlanetLock {
 public:
  /// Throws globe::Error when another program holds it.
  explicit PlanetLock(const std::filesystem::path& folder);
  ~PlanetLock();
  PlanetLock(const PlanetLock&) = delete;
  PlanetLock& operator=(const PlanetLock&) = delete;

 private:
  int lock_ = -1;
};

}  // namespace converters
