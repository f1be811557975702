#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace converters {

/// Type of the samples as read_rows gives them.
enum class SampleType { kUint8, kUint16, kInt16, kFloat };
std::size_t size_of(SampleType type);

/// What the edges of a map's extent are: the outer edges of samples, or the outermost samples themselves.
enum class Registration { kArea, kPoint };

/// Longitudes and latitudes that a map spans, degrees.
struct Extent {
  double west = -180, south = -90, east = 180, north = 90;

  friend bool operator==(const Extent&, const Extent&) = default;
};

struct RasterInfo {
  std::string name;  ///< of the file, without its folder
  int width = 0;
  int height = 0;
  int channels = 0;
  SampleType type = SampleType::kFloat;
  std::optional<Extent> extent;  ///< when the file itself says so
  std::optional<double> nodata;  ///< likewise
  bool linear_light = false;     ///< of a picture: samples are linear, not sRGB
  double white = 0;              ///< of a picture: the brightest number; 0: of the type
  bool has_mask = false;         ///< the last channel is 0 where the others are void
  double scale = 1;              ///< of heights: raw * scale + offset are what the file means, in `unit`
  double offset = 0;
  std::string unit;            ///< as the file spells it; "" when it does not say
  std::string vertical_datum;  ///< likewise
  std::string description;     ///< what the file says of itself
};

/// Nothing this large a side is a map of a planet, and a crafted header must not make us ask for the memory.
inline constexpr int kMaxSide = 1 << 20;

/// A raster that is read once, from its first row to its last.
class RasterSource {
 public:
  virtual ~RasterSource() = default;
  virtual const RasterInfo& info() const = 0;

  /// The next `count` rows, channels interleaved, as info().type. Throws globe::Error when they cannot be
  /// decoded.
  virtual void read_rows(int count, void* out) = 0;
};

/// A picture file of any kind OpenImageIO reads, decoded by `threads` threads. Throws globe::Error when it is
/// missing, unreadable or claims an absurd size.
std::unique_ptr<RasterSource> open_image(const std::filesystem::path& path, int threads);

}  // namespace converters
