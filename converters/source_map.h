#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "converters/buffer.h"
#include "converters/map_geometry.h"
#include "converters/raster_source.h"
#include "converters/spool.h"
#include "converters/void_fill.h"

namespace converters {

enum class MapKind { kHeights, kColors };

/// How samples become values: heights in metres are raw * scale + offset, colors linear light.
struct ValueRule {
  MapKind kind = MapKind::kHeights;
  double scale = 1;
  double offset = 0;
  std::optional<double> nodata;

  int channels() const { return kind == MapKind::kHeights ? 1 : 3; }
};

/// A rectangle of map values as floats. Columns of a map that goes all around are counted on without
/// wrapping, rows beyond a pole are those of the opposite meridian. Where the map has voids or ends, a weight
/// follows the channels, 1 or 0, and void values are 0.
struct Window {
  int x0 = 0, y0 = 0, width = 0, height = 0;
  int stride = 1;  ///< floats a sample
  std::vector<float> values;

  /// Columns that may be read beyond the last one: of no meaning, but finite.
  static constexpr std::size_t kPadding = 8;

  const float* at(int x, int y) const {
    const auto index =
        static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x - x0);
    return values.data() + index * static_cast<std::size_t>(stride);
  }
};

/// A map of the planet or of a part of it, held in memory or scratch as it was stored and turned into values
/// when asked.
///
/// Voids are samples that are not finite, beyond +-1e30, equal to the nodata value, masked by the raster's
/// own mask, or -32768 in 16 bits.
class SourceMap {
 public:
  /// Reads the raster to its end. `factor` x factor samples are averaged into one on the way (period and
  /// height of a map of the whole planet must be multiples of it). `progress` hears of the share read. Throws
  /// globe::Error when the raster cannot be decoded or holds nothing but voids. What another has spooled is
  /// taken from there.
  SourceMap(RasterSource& raster, const MapGeometry& geometry, const ValueRule& rule, int factor,
            MemoryBudget& budget, const std::function<void(double)>& progress, const Spool& spool = {});

  const MapGeometry& geometry() const { return geometry_; }
  int channels() const { return channels_; }
  bool has_voids() const { return fill_.has_value(); }
  /// Share of the map's area that is void, 0 to 1.
  double void_share() const { return void_share_; }

  /// Fills window.values for the window's rectangle. Lets go of pages in memory now and then when the map
  /// lies in a file.
  void read(Window& window) const;

  /// Value for a place in a void, from the valid samples around it. Only when has_voids().
  void fill(const SamplePlace& place, float* out) const { fill_->value(place, out); }

 private:
  /// Samples beside one another of a window's row that lie so in the buffer too, or off the map.
  struct Run {
    SampleIndex from;
    int count;
    bool on_map;
  };
  Run run_at(int x, int y, int most) const;
  void read_run(int x, int y, int count, float* out) const;
  void let_go_of(const Window& window) const;
  /// False only when no sample of a row in the buffer is void.
  bool may_hold_voids(const std::byte* row) const;
  void count_voids(MemoryBudget& budget);
  /// False when there is nothing whole there.
  bool take(const Spool& spool, std::size_t bytes, MemoryBudget& budget);
  void leave(const Spool& spool) const;

  MapGeometry geometry_;
  int channels_;
  int stored_channels_;  ///< a sample in the buffer
  bool masked_;          ///< the last channel in the buffer is the raster's mask
  bool ends_;            ///< there are places off the map
  SampleType stored_;    ///< kUint8, kUint16 and kInt16 go through decode_, kFloat holds values (void: NaN)
  std::vector<float> decode_;
  std::vector<std::uint16_t> void_codes_;  ///< numbers of stored_ that decode_ turns into NaN
  Buffer samples_;
  mutable std::size_t touched_ = 0;  ///< bytes of it read since its pages were let go
  std::optional<VoidFill> fill_;
  double void_share_ = 0;
};

}  // namespace converters
