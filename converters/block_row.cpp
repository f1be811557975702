#include "converters/block_row.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "converters/border_filter.h"
#include "converters/guarded_block.h"
#include "converters/level_file.h"
#include "converters/node_block.h"
#include "converters/srgb.h"
#include "globe/planet/layer_file.h"
#include "globe/planet/mean_height.h"
#include "globe/planet/planet_file.h"

namespace converters {
namespace {

using globe::planet::Node;
using globe::planet::nodes_per_side;

/// Columns sampled at a time: the memory of a job does not grow with the level.
constexpr int kColumns = 2048;

NodeRect columns_of(const NodeRect& row, int i0) {
  const int n = nodes_per_side(row.level);
  const int end = std::min(i0 + kColumns, n);
  return {row.d, row.level, i0, row.j0, end - i0 + (end == n ? 1 : 0), row.nj};
}

/// The nodes of the next coarser level that a block holds.
NodeRect coarser(const NodeRect& fine) {
  const auto first = [](int at) { return (at + 1) / 2; };
  const int i0 = first(fine.i0), j0 = first(fine.j0);
  return {fine.d, fine.level - 1, i0, j0, first(fine.i0 + fine.ni) - i0, first(fine.j0 + fine.nj) - j0};
}

/// Filtered value at a node of the next coarser level on a diamond's border: its neighbours are found by what
/// they are, since the filter takes them by the names of another diamond.
void filter_on_border(const GuardedBlock& block, int i, int j, float* out) {
  const NodeRect& rect = block.rect();
  struct Known {
    globe::planet::ivec3 key;
    const float* value;
  };
  std::array<Known, globe::planet::kLatticeSteps.size() + 1> known{};
  const auto know = [&](std::size_t k, int x, int y) {
    known[k] = {octahedral_key(globe::planet::fold({rect.d, rect.level, x, y})), block.at(x, y)};
  };
  know(0, i, j);
  for (std::size_t k = 0; k < globe::planet::kLatticeSteps.size(); ++k)
    know(k + 1, i + globe::planet::kLatticeSteps[k].x, j + globe::planet::kLatticeSteps[k].y);
  const auto value_at = [&](const Node& node) {
    const globe::planet::ivec3 key = octahedral_key(node);
    return std::find_if(known.begin(), known.end(), [&](const Known& k) { return k.key == key; })->value;
  };
  filter_border({rect.d, rect.level, i, j}, static_cast<std::size_t>(block.channels()), value_at, out);
}

void write_filtered(const GuardedBlock& block, const LevelFile& file) {
  const NodeRect to = coarser(block.rect());
  const int last = nodes_per_side(to.level);
  const std::ptrdiff_t channels = block.channels();
  std::vector<float> row(static_cast<std::size_t>(to.ni * block.channels()));
  for (int j = to.j0; j < to.j0 + to.nj; ++j) {
    for (int i = to.i0; i < to.i0 + to.ni; ++i) {
      float* out = row.data() + (i - to.i0) * channels;
      if (i == 0 || j == 0 || i == last || j == last) {
        filter_on_border(block, 2 * i, 2 * j, out);
      } else {
        filter_inside(block.at(2 * i, 2 * j), channels, block.stride() * channels, out);
      }
    }
    file.write(to.d, to.i0, j, to.ni, row.data());
  }
}

void write_subsampled(const GuardedBlock& block, const LevelFile& file) {
  const NodeRect to = coarser(block.rect());
  std::vector<float> row(static_cast<std::size_t>(to.ni));
  for (int j = to.j0; j < to.j0 + to.nj; ++j) {
    for (int i = 0; i < to.ni; ++i) row[static_cast<std::size_t>(i)] = *block.at(2 * (to.i0 + i), 2 * j);
    file.write(to.d, to.i0, j, to.ni, row.data());
  }
}

/// Range and means of the heights in each cell of the block level.
class CellSummaries {
 public:
  CellSummaries(const GuardedBlock& block, const globe::geo::Ellipsoid& ellipsoid)
      : block_(block),
        ellipsoid_(ellipsoid),
        level_(globe::planet::block_level(block.rect().level)),
        cells_(nodes_per_side(block.rect().level - level_)) {}

  /// `row` has one cell more than the block when the diamond ends with it: the last one again.
  void write(const LevelFile& ranges, const LevelFile& means) const {
    const NodeRect& rect = block_.rect();
    const int n = nodes_per_side(level_);
    const int i0 = rect.i0 / cells_, j0 = rect.j0 / cells_;
    const int last = nodes_per_side(rect.level);
    const int ni = std::min(rect.i0 + rect.ni, last) / cells_ - i0;
    const int nj = std::min(rect.j0 + rect.nj, last) / cells_ - j0;
    const bool ends_i = i0 + ni == n, ends_j = j0 + nj == n;
    std::vector<float> range(static_cast<std::size_t>(2 * (ni + 1)));
    std::vector<float> mean(range.size());
    const int side = std::min(nj, ni);
    for (int j = j0; j < j0 + nj; j += side) {
      std::vector<NodeBlock> corners;
      for (int i = i0; i < i0 + ni; i += side) corners.emplace_back(rect.d, level_, i, j, side);
      for (int y = j; y < j + side; ++y) {
        for (int x = 0; x < ni; ++x) {
          const std::size_t k = 2 * static_cast<std::size_t>(x);
          find_range(i0 + x, y, &range[k]);
          find_means(i0 + x, y, corners[static_cast<std::size_t>(x / side)], &mean[k]);
        }
        std::copy_n(range.end() - 4, 2, range.end() - 2);
        std::copy_n(mean.end() - 4, 2, mean.end() - 2);
        for (int copy = y; copy <= (ends_j && y + 1 == n ? n : y); ++copy) {
          ranges.write(rect.d, i0, copy, ni + (ends_i ? 1 : 0), range.data());
          means.write(rect.d, i0, copy, ni + (ends_i ? 1 : 0), mean.data());
        }
      }
    }
  }

 private:
  void find_range(int i, int j, float* low_high) const {
    low_high[0] = std::numeric_limits<float>::max();
    low_high[1] = std::numeric_limits<float>::lowest();
    for (int y = j * cells_; y <= (j + 1) * cells_; ++y) {
      const float* from = block_.at(i * cells_, y);
      const auto [low, high] = std::minmax_element(from, from + cells_ + 1);
      low_high[0] = std::min(low_high[0], *low);
      low_high[1] = std::max(low_high[1], *high);
    }
  }

  void find_means(int i, int j, const NodeBlock& corners, float* both) const {
    globe::planet::HeightBlock heights;
    heights.d = block_.rect().d;
    heights.height_level = block_.rect().level;
    heights.i0 = i * cells_;
    heights.j0 = j * cells_;
    for (int y = heights.j0; y <= heights.j0 + cells_; ++y) {
      const float* from = block_.at(heights.i0, y);
      std::copy_n(from, cells_ + 1, &heights.at(heights.i0, y));
    }
    const auto mean = [&](int half, const globe::htm::Corners& at) {
      const globe::planet::LatticeTrixel t = globe::planet::lattice_trixel(heights.d, level_, i, j, half);
      return static_cast<float>(globe::planet::mean_height(ellipsoid_, heights, t, at));
    };
    const auto& east = corners.at(i + 1, j);
    const auto& south = corners.at(i, j + 1);
    both[0] = mean(0, {corners.at(i, j), east, south});
    both[1] = mean(1, {corners.at(i + 1, j + 1), south, east});
  }

  const GuardedBlock& block_;
  const globe::geo::Ellipsoid& ellipsoid_;
  int level_;
  int cells_;  ///< of the heights' level in one of the block level
};

/// The tiles of a block row, as their columns come.
class TileWriter {
 public:
  TileWriter(const std::filesystem::path& path, const NodeRect& row, const globe::planet::TiffLevel& level)
      : row_(row), level_(level), file_(path, true) {
    level_.height = row.nj;
    file_.begin_level(level_);
  }

  void write(const globe::planet::SampleRect& rect, int i0) {
    for (int y = 0; y < rect.height; y += kTileSize) {
      for (int x = 0; x < rect.width; x += kTileSize) {
        cut_tile(rect, x, y, level_, tile_);
        file_.write_tile((i0 + x) / kTileSize, y / kTileSize, tile_);
      }
    }
  }

  void finish() {
    file_.end_level();
    file_.finish();
  }

 private:
  NodeRect row_;
  globe::planet::TiffLevel level_;
  globe::planet::TiffWriter file_;
  std::vector<std::byte> tile_;
};

Range range_of(const GuardedBlock& block) {
  Range range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  const NodeRect& rect = block.rect();
  for (int j = rect.j0; j < rect.j0 + rect.nj; ++j) {
    const auto [low, high] = std::minmax_element(block.at(rect.i0, j), block.at(rect.i0, j) + rect.ni);
    range.min = std::min(range.min, static_cast<double>(*low));
    range.max = std::max(range.max, static_cast<double>(*high));
  }
  return range;
}

/// Writes what a block of heights holds.
class HeightParts {
 public:
  HeightParts(const Job& job, const globe::geo::Ellipsoid& ellipsoid, const PartFiles& files)
      : ellipsoid_(ellipsoid),
        ranges_(files.level("height_range"), globe::planet::block_level(job.level), 2),
        means_(files.level("height_mean"), globe::planet::block_level(job.level), 2) {
    if (job.level == 0) return;
    heights_.emplace(files.level("height"), job.level - 1, 1);
    relief_.emplace(files.level("relief"), job.level - 1, 1);
  }

  void write(GuardedBlock& block, TileWriter& tiles) {
    const NodeRect& rect = block.rect();
    tiles.write({block.at(rect.i0, rect.j0), rect.ni, rect.nj, block.stride()}, rect.i0);
    CellSummaries(block, ellipsoid_).write(ranges_, means_);
    if (heights_) write_subsampled(block, *heights_);
    if (relief_) write_filtered(block, *relief_);
    const Range range = range_of(block);
    range_ = {std::min(range_.min, range.min), std::max(range_.max, range.max)};
  }

  void sync() const {
    ranges_.sync();
    means_.sync();
    if (heights_) heights_->sync();
    if (relief_) relief_->sync();
  }
  Range range() const { return range_; }

 private:
  const globe::geo::Ellipsoid& ellipsoid_;
  LevelFile ranges_;
  LevelFile means_;
  std::optional<LevelFile> heights_;
  std::optional<LevelFile> relief_;
  Range range_{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
};

/// The same for colors. Filtering starts from the bytes that are stored, in linear light.
class ColorParts {
 public:
  ColorParts(const Job& job, const PartFiles& files) {
    if (job.level > 0) next_.emplace(files.level("color"), job.level - 1, 3);
  }

  void write(GuardedBlock& block, TileWriter& tiles) {
    const NodeRect& rect = block.rect();
    std::vector<float>& values = block.values();
    bytes_.resize(values.size());
    const std::array<float, 256>& linear = linear_from_srgb_bytes();
    for (std::size_t k = 0; k < values.size(); ++k) {
      bytes_[k] = srgb_byte_from_linear(values[k]);
      values[k] = linear[bytes_[k]];
    }
    const std::uint8_t* first = bytes_.data() + (block.at(rect.i0, rect.j0) - values.data());
    tiles.write({first, rect.ni, rect.nj, block.stride()}, rect.i0);
    if (next_) write_filtered(block, *next_);
  }

  void sync() const {
    if (next_) next_->sync();
  }
  static Range range() { return {0.0, 1.0}; }

 private:
  std::optional<LevelFile> next_;
  std::vector<std::uint8_t> bytes_;
};

/// Marks of voids.
class VoidParts {
 public:
  VoidParts(const Job& job, const PartFiles& files) {
    if (job.level > 0) next_.emplace(files.level("void"), job.level - 1, 1);
  }

  void write(GuardedBlock& block, TileWriter& tiles) {
    const NodeRect& rect = block.rect();
    const std::vector<float>& values = block.values();
    bytes_.resize(values.size());
    std::transform(values.begin(), values.end(), bytes_.begin(), mark_byte);
    const std::uint8_t* first = bytes_.data() + (block.at(rect.i0, rect.j0) - values.data());
    tiles.write({first, rect.ni, rect.nj, block.stride()}, rect.i0);
    if (next_) write_subsampled(block, *next_);
  }

  void sync() const {
    if (next_) next_->sync();
  }
  static Range range() { return {0.0, 1.0}; }

 private:
  std::optional<LevelFile> next_;
  std::vector<std::uint8_t> bytes_;
};

template <typename Parts>
Range run(const Job& job, const NodeSource& nodes, int channels, const char* storage, const PartFiles& files,
          Parts parts, const std::function<void(double)>& progress) {
  const NodeRect row = nodes_of(job);
  const int n = nodes_per_side(job.level);
  const std::filesystem::path path = files.tiles(job);
  const std::filesystem::path temporary = path.string() + ".partial";
  TileWriter tiles(temporary, row, globe::planet::layer_level(job.level, channels, storage, kTileSize));
  for (int i = 0; i < n; i += kColumns) {
    GuardedBlock block(columns_of(row, i), channels, nodes);
    parts.write(block, tiles);
    progress(double(std::min(i + kColumns, n)) / n);
  }
  tiles.finish();
  if (files.outlast_power) {
    globe::planet::sync_to_disk(temporary);
    parts.sync();
  }
  std::filesystem::rename(temporary, path);
  return parts.range();
}

}  // namespace

std::filesystem::path PartFiles::tiles(const Job& job) const {
  std::string name = name_of(job);
  std::replace(name.begin(), name.end(), ' ', '_');
  return folder / (name + ".tif");
}

std::filesystem::path PartFiles::level(const std::string& layer) const { return folder / (layer + ".level"); }

Range run_job(const Job& job, const NodeSource& nodes, const globe::geo::Ellipsoid& ellipsoid,
              const PartFiles& files, const std::function<void(double)>& progress) {
  if (job.layer == JobLayer::kHeight)
    return run(job, nodes, 1, "float32", files, HeightParts(job, ellipsoid, files), progress);
  if (job.layer == JobLayer::kVoid)
    return run(job, nodes, 1, "uint8", files, VoidParts(job, files), progress);
  return run(job, nodes, 3, "uint8", files, ColorParts(job, files), progress);
}

}  // namespace converters
