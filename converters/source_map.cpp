#include "converters/source_map.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>

#include "converters/srgb.h"
#include "globe/base/error.h"

namespace converters {
namespace {

constexpr float kVoid = std::numeric_limits<float>::quiet_NaN();
constexpr double kAbsurd = 1e30;  ///< no value of a map; the usual "no data" of float rasters lies beyond

/// Decodes one raw number: to metres or linear light, voids to NaN. `full` is the white of an integer
/// picture, 0 for pictures whose samples are linear.
float decode(const ValueRule& rule, double raw, double full) {
  if (!std::isfinite(raw) || std::abs(raw) > kAbsurd || (rule.nodata && raw == *rule.nodata)) return kVoid;
  if (rule.kind == MapKind::kHeights) return static_cast<float>(raw * rule.scale + rule.offset);
  return static_cast<float>(full == 0.0 ? raw : linear_from_srgb(raw / full));
}

/// Values of all raw numbers of an integer type, indexed by their bits.
std::vector<float> decode_table(const ValueRule& rule, SampleType type) {
  if (type == SampleType::kFloat) return {};
  std::vector<float> table(type == SampleType::kUint8 ? 256 : 65536);
  for (std::size_t bits = 0; bits < table.size(); ++bits) {
    const auto raw = type == SampleType::kInt16 ? static_cast<double>(static_cast<std::int16_t>(bits))
                                                : static_cast<double>(bits);
    const double full = type == SampleType::kUint8 ? 255.0 : type == SampleType::kUint16 ? 65535.0 : 32767.0;
    table[bits] = type == SampleType::kInt16 && raw == -32768.0 ? kVoid : decode(rule, raw, full);
  }
  return table;
}

std::size_t area(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

/// Averages blocks of factor x factor samples of whole rows of values; NaN counts for nothing.
void average_blocks(const float* rows, int width, int channels, int factor, float* out) {
  const auto n = static_cast<std::size_t>(channels);
  const auto f = static_cast<std::size_t>(factor);
  const auto w = static_cast<std::size_t>(width);
  for (std::size_t x = 0; x < w / f; ++x) {
    for (std::size_t c = 0; c < n; ++c) {
      double sum = 0;
      int count = 0;
      for (std::size_t b = 0; b < f; ++b) {
        for (std::size_t a = 0; a < f; ++a) {
          const float value = rows[(b * w + x * f + a) * n + c];
          if (std::isnan(value)) continue;
          sum += static_cast<double>(value);
          ++count;
        }
      }
      out[x * n + c] = count == 0 ? kVoid : static_cast<float>(sum / count);
    }
  }
}

/// Raw samples of one pixel run to values; pictures of one or two channels are grey.
template <typename Decode>
void decode_run(std::size_t count, int raw_channels, int channels, const Decode& value_at, float* out) {
  const auto raw = static_cast<std::size_t>(raw_channels);
  for (std::size_t k = 0; k < count; ++k) {
    for (int c = 0; c < channels; ++c)
      *out++ = value_at(k * raw + (raw < 3 ? 0U : static_cast<std::size_t>(c)));
  }
}

}  // namespace

SourceMap::SourceMap(RasterSource& raster, const MapGeometry& geometry, const ValueRule& rule, int factor,
                     MemoryBudget& budget, const std::function<void(double)>& progress)
    : geometry_(factor > 1 ? reduced(geometry, factor) : geometry),
      channels_(rule.channels()),
      stored_channels_(raster.info().channels),
      stored_(raster.info().type) {
  const RasterInfo& info = raster.info();
  const std::size_t raw_row = static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.channels);
  const bool as_values = info.type == SampleType::kFloat || factor > 1;
  decode_ = decode_table(rule, info.type);
  std::vector<std::byte> raw(raw_row * size_of(info.type) * static_cast<std::size_t>(factor));
  std::vector<float> rows(as_values ? area(info.width, factor) * static_cast<std::size_t>(channels_) : 0);
  const auto value_at = [&](std::size_t index) {
    switch (info.type) {
      case SampleType::kUint8:
        return decode_[std::to_integer<std::size_t>(raw[index])];
      case SampleType::kUint16:
      case SampleType::kInt16:
        return decode_[reinterpret_cast<const std::uint16_t*>(raw.data())[index]];
      case SampleType::kFloat:
        break;
    }
    return decode(rule, static_cast<double>(reinterpret_cast<const float*>(raw.data())[index]),
                  info.linear_light ? 0.0 : 1.0);
  };
  if (as_values) {
    stored_ = SampleType::kFloat;
    stored_channels_ = channels_;
  }
  const std::size_t row_bytes = static_cast<std::size_t>(geometry_.width) *
                                static_cast<std::size_t>(stored_channels_) * size_of(stored_);
  samples_ = Buffer(row_bytes * static_cast<std::size_t>(geometry_.height), budget);
  for (int y = 0; y < geometry_.height; ++y) {
    std::byte* to = samples_.data() + static_cast<std::size_t>(y) * row_bytes;
    if (as_values) {
      raster.read_rows(factor, raw.data());
      decode_run(area(info.width, factor), info.channels, channels_, value_at, rows.data());
      average_blocks(rows.data(), info.width, channels_, factor, reinterpret_cast<float*>(to));
    } else {
      raster.read_rows(1, to);
    }
    if (y % 64 == 63) {
      samples_.drop_pages();
      progress(double(y) / geometry_.height);
    }
  }
  if (as_values) decode_.clear();
  count_voids();
  if (void_share_ >= 1.0) throw globe::Error(info.name, "holds no valid sample", "check --nodata");
}

void SourceMap::read_run(int x, int y, int count, float* out) const {
  const std::size_t first = (static_cast<std::size_t>(y) * static_cast<std::size_t>(geometry_.width) +
                             static_cast<std::size_t>(x)) *
                            static_cast<std::size_t>(stored_channels_);
  const auto n = static_cast<std::size_t>(count);
  switch (stored_) {
    case SampleType::kUint8: {
      const auto* from = samples_.as<std::uint8_t>() + first;
      decode_run(
          n, stored_channels_, channels_, [&](std::size_t k) { return decode_[from[k]]; }, out);
      break;
    }
    case SampleType::kUint16:
    case SampleType::kInt16: {
      const auto* from = samples_.as<std::uint16_t>() + first;
      decode_run(
          n, stored_channels_, channels_, [&](std::size_t k) { return decode_[from[k]]; }, out);
      break;
    }
    case SampleType::kFloat:
      std::copy_n(samples_.as<float>() + first, n * static_cast<std::size_t>(channels_), out);
      break;
  }
}

void SourceMap::read(Window& window) const {
  window.stride = channels_ + (fill_ ? 1 : 0);
  window.values.resize(area(window.width, window.height) * static_cast<std::size_t>(window.stride));
  std::vector<float> run;
  for (int y = window.y0; y < window.y0 + window.height; ++y) {
    for (int done = 0; done < window.width;) {
      const SampleIndex from = fold(geometry_, window.x0 + done, y);
      const int count = std::min(window.width - done, geometry_.period - from.x);
      float* to = const_cast<float*>(window.at(window.x0 + done, y));
      done += count;
      if (!fill_) {
        read_run(from.x, from.y, count, to);
        continue;
      }
      run.resize(static_cast<std::size_t>(count) * static_cast<std::size_t>(channels_));
      read_run(from.x, from.y, count, run.data());
      for (std::size_t k = 0; k < run.size(); k += static_cast<std::size_t>(channels_)) {
        const bool is_void =
            std::any_of(run.data() + k, run.data() + k + channels_, [](float v) { return std::isnan(v); });
        for (int c = 0; c < channels_; ++c) *to++ = is_void ? 0.0F : run[k + static_cast<std::size_t>(c)];
        *to++ = is_void ? 0.0F : 1.0F;
      }
    }
  }
}

void SourceMap::count_voids() {
  // Integers of a type whose every number is valid have no voids: nothing to look for.
  if (stored_ != SampleType::kFloat &&
      std::none_of(decode_.begin(), decode_.end(), [](float v) { return std::isnan(v); }))
    return;
  VoidFill fill(geometry_, channels_);
  std::vector<float> row(static_cast<std::size_t>(geometry_.period) * static_cast<std::size_t>(channels_));
  double void_area = 0;
  double whole_area = 0;
  bool any_valid = false;
  for (int y = 0; y < geometry_.height; ++y) {
    read_run(0, y, geometry_.period, row.data());
    const double weight = std::cos(latitude_of(geometry_, y) * std::numbers::pi / 180.0);
    int voids = 0;
    for (int x = 0; x < geometry_.period; ++x) {
      const float* value = row.data() + static_cast<std::size_t>(x) * static_cast<std::size_t>(channels_);
      if (std::any_of(value, value + channels_, [](float v) { return std::isnan(v); })) {
        ++voids;
      } else {
        fill.add(x, y, value);
      }
    }
    void_area += weight * voids;
    whole_area += weight * geometry_.period;
    any_valid = any_valid || voids < geometry_.period;
    if (y % 64 == 63) samples_.drop_pages();
  }
  void_share_ = any_valid ? std::min(void_area / whole_area, std::nextafter(1.0, 0.0)) : 1.0;
  if (void_area == 0.0 && any_valid) return;
  fill.finish();
  fill_ = std::move(fill);
}

}  // namespace converters
