#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "globe/planet/tiff_level.h"

namespace globe::planet {

/// Level k of a diamond as it lies in its file.
TiffLevel layer_level(int level, int channels, const std::string& storage, int tile_size);

/// Writes the pyramid of one layer and one diamond: a tiled TIFF (planet/tiff_level.h) whose sub-images are
/// the levels, finest first. The same samples give the same bytes: no date, host or thread count gets in.
class LayerFileWriter {
 public:
  /// `storage` as in LayerInfo. Throws globe::Error when the file cannot be made.
  LayerFileWriter(const std::filesystem::path& path, int level, int channels, const std::string& storage,
                  int tile_size);

  /// The next coarser level, (2^level + 1)^2 nodes, row j major, channels interleaved, of the storage type.
  /// `written` hears of each band of `rows` rows that is done.
  void write_level(const void* samples, const std::function<void(int rows)>& written = {});

  /// The next coarser level from files that hold its rows of tiles one after the other, as TiffWriter wrote
  /// them: the same bytes as write_level gives, at the cost of copying.
  void write_level(const std::vector<std::filesystem::path>& parts,
                   const std::function<void(int rows)>& written = {});

  /// Ends the file after level 0; sync_to_disk (planet/planet_file.h) brings it to the disk.
  void finish();

 private:
  TiffLevel next_level();

  int level_;  ///< of the next call
  int channels_;
  std::string storage_;
  int tile_size_;
  TiffWriter file_;
};

}  // namespace globe::planet
