#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

namespace globe::planet {

/// Writes the pyramid of one layer and one diamond: a tiled, deflated TIFF whose sub-images are the levels,
/// finest first. The same samples give the same bytes: no date, host or thread count gets in.
class LayerFileWriter {
 public:
  /// `storage` as in LayerInfo. Throws globe::Error when the file cannot be made.
  LayerFileWriter(const std::filesystem::path& path, int level, int channels, const std::string& storage,
                  int tile_size);
  ~LayerFileWriter();
  LayerFileWriter(const LayerFileWriter&) = delete;
  LayerFileWriter& operator=(const LayerFileWriter&) = delete;

  /// The next coarser level, (2^level + 1)^2 nodes, row j major, channels interleaved, of the storage type.
  /// `written` hears of each band of `rows` rows that is done.
  void write_level(const void* samples, const std::function<void(int rows)>& written = {});

  /// Ends the file after level 0 and syncs it to disk.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace globe::planet
