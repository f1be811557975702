#include "converters/source_map.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include "converters/srgb.h"
#include "globe/base/error.h"
#include "globe/base/file_lock.h"
#include "globe/base/pending_file.h"

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

/// The brightest number of a picture.
double white_of(const RasterInfo& info) {
  if (info.white > 0.0) return info.white;
  switch (info.type) {
    case SampleType::kUint8:
      return 255.0;
    case SampleType::kUint16:
      return 65535.0;
    case SampleType::kInt16:
      return 32767.0;
    case SampleType::kFloat:
      break;
  }
  return 1.0;
}

/// Values of all raw numbers of an integer type, indexed by their bits.
std::vector<float> decode_table(const ValueRule& rule, const RasterInfo& info) {
  if (info.type == SampleType::kFloat) return {};
  std::vector<float> table(info.type == SampleType::kUint8 ? 256 : 65536);
  const double white = white_of(info);
  for (std::size_t bits = 0; bits < table.size(); ++bits) {
    const auto raw = info.type == SampleType::kInt16 ? static_cast<double>(static_cast<std::int16_t>(bits))
                                                     : static_cast<double>(bits);
    table[bits] = info.type == SampleType::kInt16 && raw == -32768.0 ? kVoid : decode(rule, raw, white);
  }
  return table;
}

std::size_t area(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

/// Averages blocks of factor x factor samples of whole rows of values, fewer at the end of a row; NaN counts
/// for nothing.
void average_blocks(const float* rows, int width, int row_count, int channels, int factor, float* out) {
  const auto n = static_cast<std::size_t>(channels);
  for (int x = 0; x < width; x += factor) {
    const int end = std::min(x + factor, width);
    for (std::size_t c = 0; c < n; ++c) {
      double sum = 0;
      int count = 0;
      for (int b = 0; b < row_count; ++b) {
        for (int a = x; a < end; ++a) {
          const float value = rows[(area(b, width) + static_cast<std::size_t>(a)) * n + c];
          if (std::isnan(value)) continue;
          sum += static_cast<double>(value);
          ++count;
        }
      }
      *out++ = count == 0 ? kVoid : static_cast<float>(sum / count);
    }
  }
}

/// Raw samples of one pixel run to values; pictures of one or two channels are grey. `raw_channels` counts
/// the mask, when there is one; is_hidden(its index) tells what it says.
template <typename Decode, typename Hidden>
void decode_run(std::size_t count, int raw_channels, bool masked, int channels, const Decode& value_at,
                const Hidden& is_hidden, float* out) {
  const auto raw = static_cast<std::size_t>(raw_channels);
  const bool grey = raw_channels - (masked ? 1 : 0) < 3;
  for (std::size_t k = 0; k < count; ++k) {
    const bool hidden = masked && is_hidden(k * raw + raw - 1);
    for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c)
      *out++ = hidden ? kVoid : value_at(k * raw + (grey ? 0U : c));
  }
}

}  // namespace

SourceMap::SourceMap(RasterSource& raster, const MapGeometry& geometry, const ValueRule& rule, int factor,
                     MemoryBudget& budget, const std::function<void(double)>& progress, const Spool& spool)
    : geometry_(factor > 1 ? reduced(geometry, factor) : geometry),
      channels_(rule.channels()),
      stored_channels_(raster.info().channels),
      masked_(raster.info().has_mask),
      ends_(!geometry.is_whole_planet()),
      stored_(raster.info().type) {
  const RasterInfo& info = raster.info();
  const std::size_t raw_row = static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.channels);
  const bool as_values = info.type == SampleType::kFloat || factor > 1;
  decode_ = decode_table(rule, info);
  for (std::size_t code = 0; code < decode_.size(); ++code)
    if (std::isnan(decode_[code])) void_codes_.push_back(static_cast<std::uint16_t>(code));
  std::vector<std::byte> raw(raw_row * size_of(info.type) * static_cast<std::size_t>(factor));
  std::vector<float> rows(as_values ? area(info.width, factor) * static_cast<std::size_t>(channels_) : 0);
  const double white = info.linear_light ? 0.0 : white_of(info);
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
    return decode(rule, static_cast<double>(reinterpret_cast<const float*>(raw.data())[index]), white);
  };
  const auto is_hidden = [&](std::size_t index) {
    switch (info.type) {
      case SampleType::kUint8:
        return raw[index] == std::byte{0};
      case SampleType::kUint16:
      case SampleType::kInt16:
        return reinterpret_cast<const std::uint16_t*>(raw.data())[index] == 0;
      case SampleType::kFloat:
        break;
    }
    return reinterpret_cast<const float*>(raw.data())[index] == 0.0F;
  };
  if (as_values) {
    stored_ = SampleType::kFloat;
    stored_channels_ = channels_;
    masked_ = false;
  }
  const std::size_t row_bytes = static_cast<std::size_t>(geometry_.width) *
                                static_cast<std::size_t>(stored_channels_) * size_of(stored_);
  const std::size_t bytes = row_bytes * static_cast<std::size_t>(geometry_.height);
  const bool spooled = !spool.file.empty() && (spool.always || bytes > budget.bytes_left);
  std::optional<globe::FileLock> lock;  // one decodes, the others wait for it
  if (spooled) {
    lock.emplace(spool.lock());
    if (take(spool, bytes, budget)) {
      if (as_values) decode_.clear();
      return;
    }
  }
  samples_ = spooled ? Buffer::in_new_file(spool.temporary(), bytes) : Buffer(bytes, budget);
  bool voids = false;
  for (int y = 0; y < geometry_.height; ++y) {
    std::byte* to = samples_.data() + static_cast<std::size_t>(y) * row_bytes;
    if (as_values) {
      const int row_count = std::min(factor, info.height - y * factor);
      raster.read_rows(row_count, raw.data());
      decode_run(area(info.width, row_count), info.channels, info.has_mask, channels_, value_at, is_hidden,
                 rows.data());
      average_blocks(rows.data(), info.width, row_count, channels_, factor, reinterpret_cast<float*>(to));
    } else {
      raster.read_rows(1, to);
    }
    voids = voids || may_hold_voids(to);
    if (y % 64 == 63) {
      samples_.drop_pages();
      progress(double(y) / geometry_.height);
    }
  }
  if (as_values) decode_.clear();
  if (voids) count_voids(budget);
  if (void_share_ >= 1.0) throw globe::Error(info.name, "holds no valid sample", "check --nodata");
  if (spooled) leave(spool);
}

bool SourceMap::take(const Spool& spool, std::size_t bytes, MemoryBudget& budget) {
  if (!std::filesystem::exists(spool.file)) return false;
  std::ifstream voids(spool.voids(), std::ios::binary);
  char filled = 0;
  voids.read(reinterpret_cast<char*>(&void_share_), sizeof void_share_);
  voids.get(filled);
  if (filled != 0) {
    fill_.emplace(geometry_, channels_);
    fill_->load(voids, budget);
  }
  if (!voids) {
    fill_.reset();
    return false;
  }
  samples_ = Buffer(spool.file, bytes);
  return true;
}

void SourceMap::leave(const Spool& spool) const {
  std::ofstream voids(spool.voids(), std::ios::binary);
  voids.write(reinterpret_cast<const char*>(&void_share_), sizeof void_share_);
  voids.put(fill_ ? 1 : 0);
  if (fill_) fill_->save(voids);
  voids.close();
  if (!voids || !globe::flush_to_disk(spool.voids()) || !globe::flush_to_disk(spool.temporary())) {
    throw globe::Error(spool.file.string(), "cannot be written",
                       "free some disk, then the same command goes on");
  }
  std::filesystem::rename(spool.temporary(), spool.file);
}

void SourceMap::read_run(int x, int y, int count, float* out) const {
  const std::size_t first = (static_cast<std::size_t>(y) * static_cast<std::size_t>(geometry_.width) +
                             static_cast<std::size_t>(x)) *
                            static_cast<std::size_t>(stored_channels_);
  const auto n = static_cast<std::size_t>(count);
  const auto decode_from = [&](const auto* from) {
    decode_run(
        n, stored_channels_, masked_, channels_, [&](std::size_t k) { return decode_[from[k]]; },
        [&](std::size_t k) { return from[k] == 0; }, out);
  };
  switch (stored_) {
    case SampleType::kUint8:
      decode_from(samples_.as<std::uint8_t>() + first);
      break;
    case SampleType::kUint16:
    case SampleType::kInt16:
      decode_from(samples_.as<std::uint16_t>() + first);
      break;
    case SampleType::kFloat:
      std::copy_n(samples_.as<float>() + first, n * static_cast<std::size_t>(channels_), out);
      break;
  }
}

SourceMap::Run SourceMap::run_at(int x, int y, int most) const {
  if (!has_row(geometry_, y)) return {{0, 0}, most, false};
  if (geometry_.period > 0) {
    const SampleIndex from = fold(geometry_, x, y);
    return {from, std::min(most, geometry_.period - from.x), true};
  }
  if (x < 0) return {{0, 0}, std::min(most, -x), false};
  if (x >= geometry_.width) return {{0, 0}, most, false};
  return {{x, y}, std::min(most, geometry_.width - x), true};
}

void SourceMap::read(Window& window) const {
  const bool weighted = fill_ || ends_;
  window.stride = channels_ + (weighted ? 1 : 0);
  window.values.resize((area(window.width, window.height) + Window::kPadding) *
                       static_cast<std::size_t>(window.stride));
  std::vector<float> values;
  for (int y = window.y0; y < window.y0 + window.height; ++y) {
    for (int done = 0; done < window.width;) {
      const Run run = run_at(window.x0 + done, y, window.width - done);
      float* to = const_cast<float*>(window.at(window.x0 + done, y));
      done += run.count;
      if (!weighted) {
        read_run(run.from.x, run.from.y, run.count, to);
        continue;
      }
      values.assign(static_cast<std::size_t>(run.count) * static_cast<std::size_t>(channels_), kVoid);
      if (run.on_map) read_run(run.from.x, run.from.y, run.count, values.data());
      for (std::size_t k = 0; k < values.size(); k += static_cast<std::size_t>(channels_)) {
        const bool is_void = std::any_of(values.data() + k, values.data() + k + channels_,
                                         [](float v) { return std::isnan(v); });
        for (int c = 0; c < channels_; ++c) *to++ = is_void ? 0.0F : values[k + static_cast<std::size_t>(c)];
        *to++ = is_void ? 0.0F : 1.0F;
      }
    }
  }
  let_go_of(window);
}

/// What a window reads of a row brings in the pages around it: the kernel maps 64 KiB at a fault when the
/// file is in its cache.
void SourceMap::let_go_of(const Window& window) const {
  constexpr std::size_t kAround = 65536, kMost = std::size_t{32} << 20;
  const std::size_t row =
      static_cast<std::size_t>(window.width) * static_cast<std::size_t>(stored_channels_) * size_of(stored_);
  const std::size_t bytes = static_cast<std::size_t>(window.height) * (row + kAround);
  const std::atomic_ref<std::size_t> touched(touched_);
  if (touched.fetch_add(bytes) + bytes < kMost) return;
  touched = 0;
  samples_.drop_pages();
}

bool SourceMap::may_hold_voids(const std::byte* row) const {
  constexpr std::size_t kMostCodes = 4;
  if (masked_ || void_codes_.size() > kMostCodes) return true;
  const std::size_t n = area(geometry_.width, stored_channels_);
  const auto any = [n](const auto* first, const auto& is_void) {  // without a way out: vector code
    bool found = false;
    for (std::size_t k = 0; k < n; ++k) found |= is_void(first[k]);
    return found;
  };
  if (stored_ == SampleType::kFloat)
    return any(reinterpret_cast<const float*>(row), [](float v) { return v != v; });
  return std::any_of(void_codes_.begin(), void_codes_.end(), [&](std::uint16_t code) {
    if (stored_ == SampleType::kUint8)
      return any(reinterpret_cast<const std::uint8_t*>(row), [code](std::uint8_t v) { return v == code; });
    return any(reinterpret_cast<const std::uint16_t*>(row), [code](std::uint16_t v) { return v == code; });
  });
}

void SourceMap::count_voids(MemoryBudget& budget) {
  VoidFill fill(geometry_, channels_);
  std::vector<float> row(static_cast<std::size_t>(geometry_.columns()) * static_cast<std::size_t>(channels_));
  double void_area = 0;
  double whole_area = 0;
  bool any_valid = false;
  for (int y = 0; y < geometry_.height; ++y) {
    read_run(0, y, geometry_.columns(), row.data());
    const double weight = row_weight(geometry_, y);
    int voids = 0;
    for (int x = 0; x < geometry_.columns(); ++x) {
      const float* value = row.data() + static_cast<std::size_t>(x) * static_cast<std::size_t>(channels_);
      if (std::any_of(value, value + channels_, [](float v) { return std::isnan(v); })) {
        ++voids;
      } else {
        fill.add(x, y, value);
      }
    }
    void_area += weight * voids;
    whole_area += weight * geometry_.columns();
    any_valid = any_valid || voids < geometry_.columns();
    if (y % 64 == 63) samples_.drop_pages();
  }
  void_share_ = any_valid ? std::min(void_area / whole_area, std::nextafter(1.0, 0.0)) : 1.0;
  if (void_area == 0.0 && any_valid) return;
  fill.finish(budget);
  fill_ = std::move(fill);
}

}  // namespace converters
