#include "globe/planet/verify.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <tuple>

#include "globe/base/error.h"
#include "globe/planet/dataset.h"
#include "globe/planet/grid.h"
#include "globe/planet/mean_height.h"
#include "globe/planet/planet_file.h"
#include "globe/planet/verify_insets.h"

namespace globe::planet {
namespace {

constexpr int kBlockSide = 128;  ///< cells

/// Findings of one kind in one level of one diamond are told in one line.
class Findings {
 public:
  void add(const std::string& layer, int d, int level, const std::string& what, int i, int j) {
    const std::lock_guard lock(mutex_);
    Place& place = places_[{layer, -level, d, what}];
    ++place.count;
    place.first = std::min(place.first, {j, i});
  }
  void add(const std::string& line) {
    const std::lock_guard lock(mutex_);
    lines_.push_back(line);
  }

  std::vector<std::string> lines() {
    std::sort(lines_.begin(), lines_.end());
    std::vector<std::string> all = lines_;
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (const auto& [key, place] : places_) {
      const auto& [layer, minus_level, d, what] = key;
      std::string line = layer;
      line += ", level " + std::to_string(-minus_level) + ", diamond " + std::to_string(d);
      line += ": " + std::to_string(place.count) + " ";
      line += what;
      line += ", the first at " + std::to_string(place.first.second);
      line += ", " + std::to_string(place.first.first);
      all.push_back(line);
    }
    return all;
  }

 private:
  struct Place {
    std::uint64_t count = 0;
    std::pair<int, int> first{1 << 30, 1 << 30};  ///< row, column
  };
  std::map<std::tuple<std::string, int, int, std::string>, Place> places_;
  std::vector<std::string> lines_;
  std::mutex mutex_;
};

/// "FILE: WHY" of an error's "FOLDER/FILE: WHY; WHAT TO DO".
std::string without_folder(const std::string& error) {
  const std::string told = error.substr(0, error.rfind("; "));
  const std::size_t folder = told.rfind('/', told.find(": "));
  return folder == std::string::npos ? told : told.substr(folder + 1);
}

/// Values of a rectangle of nodes of one layer.
struct Values {
  int i0, j0, ni, channels;
  std::vector<float> samples;

  float at(int i, int j, int c = 0) const {
    return samples[static_cast<std::size_t>(((j - j0) * ni + (i - i0)) * channels + c)];
  }
};

/// The lowest and highest of all.
struct Span {
  float low = HUGE_VALF, high = -HUGE_VALF;
  std::mutex mutex;

  void include(float a, float b) {
    const std::lock_guard lock(mutex);
    low = std::min(low, a);
    high = std::max(high, b);
  }
};

class Verifier {
 public:
  Verifier(const Dataset& data, Findings& findings,
           const std::function<void(const std::string&, double)>& progress)
      : data_(data), findings_(findings), progress_(progress) {}

  std::uint64_t run() {
    for (const LayerInfo& layer : data_.info().layers) {
      if (layer.name == "height") {
        check_heights(layer);
      } else if (layer.name == "height_range") {
        check_cells(layer, &Verifier::check_ranges);
      } else if (layer.name == "height_mean") {
        check_cells(layer, &Verifier::check_means);
      } else {
        check_values(layer);
      }
    }
    return nodes_;
  }

 private:
  struct Block {
    int d, level, i0, j0, cells;
  };

  /// Nothing when a tile cannot be decoded, which is then a finding.
  std::optional<Values> read(const LayerInfo& layer, int d, int level, int i0, int j0, int ni, int nj) const {
    Values values{i0, j0, ni, layer.channels, {}};
    values.samples.resize(static_cast<std::size_t>(ni * nj * layer.channels));
    try {
      data_.read(layer.name, d, level, i0, j0, ni, nj, values.samples.data());
    } catch (const Error& error) {
      findings_.add(without_folder(error.what()));
      return std::nullopt;
    }
    return values;
  }

  /// Runs body(block) for all blocks of all levels of a layer, in parallel.
  template <typename Body>
  void for_each_block(const LayerInfo& layer, const Body& body) {
    std::vector<Block> blocks;
    for (int level = layer.level; level >= 0; --level) {
      const int cells = std::min(kBlockSide, nodes_per_side(level));
      for (int d = 0; d < kDiamonds; ++d) {
        for (int j = 0; j < nodes_per_side(level); j += cells) {
          for (int i = 0; i < nodes_per_side(level); i += cells) blocks.push_back({d, level, i, j, cells});
        }
      }
    }
    std::atomic<std::size_t> done = 0;
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t k) {
      body(blocks[k]);
      nodes_ += static_cast<std::uint64_t>(blocks[k].cells) * static_cast<std::uint64_t>(blocks[k].cells);
      const std::size_t now = ++done;
      const std::lock_guard lock(progress_mutex_);
      progress_("checking " + layer.name, double(now) / double(blocks.size()));
    });
  }

  void check_finite(const LayerInfo& layer, const Block& block, const Values& values) const {
    for (int j = block.j0; j <= block.j0 + block.cells; ++j) {
      for (int i = block.i0; i <= block.i0 + block.cells; ++i) {
        for (int c = 0; c < values.channels; ++c) {
          if (!std::isfinite(values.at(i, j, c)))
            findings_.add(layer.name, block.d, block.level, "values are not finite", i, j);
        }
      }
    }
  }

  /// Nodes of the block on the borders with the next diamond: (0, t) is (t, 0) there, (t, n) is (n, t).
  void check_edges(const LayerInfo& layer, const Block& block, const Values& values) const {
    const int n = nodes_per_side(block.level);
    const int next = (block.d + 1) % kDiamonds;
    const auto compare = [&](bool first_column) {
      const int t0 = first_column ? block.j0 : block.i0;
      const auto other = read(layer, next, block.level, first_column ? t0 : n, first_column ? 0 : t0,
                              first_column ? block.cells + 1 : 1, first_column ? 1 : block.cells + 1);
      if (!other) return;
      for (int t = t0; t <= t0 + block.cells; ++t) {
        for (int c = 0; c < values.channels; ++c) {
          const float here = first_column ? values.at(0, t, c) : values.at(t, n, c);
          const float there = first_column ? other->at(t, 0, c) : other->at(n, t, c);
          if (here != there && !(std::isnan(here) && std::isnan(there))) {
            findings_.add(layer.name, block.d, block.level,
                          "nodes on the border have other values in diamond " + std::to_string(next),
                          first_column ? 0 : t, first_column ? t : n);
          }
        }
      }
    };
    if (block.i0 == 0) compare(true);
    if (block.j0 + block.cells == n) compare(false);
  }

  std::optional<Values> checked_block(const LayerInfo& layer, const Block& block) const {
    auto values = read(layer, block.d, block.level, block.i0, block.j0, block.cells + 1, block.cells + 1);
    if (!values) return values;
    check_finite(layer, block, *values);
    check_edges(layer, block, *values);
    return values;
  }

  void check_values(const LayerInfo& layer) {
    for_each_block(layer, [&](const Block& block) { checked_block(layer, block); });
  }

  void check_heights(const LayerInfo& layer) {
    Span all;
    for_each_block(layer, [&](const Block& block) {
      const auto values = checked_block(layer, block);
      if (!values) return;
      if (block.level == layer.level) {
        const auto [low, high] = std::minmax_element(values->samples.begin(), values->samples.end());
        all.include(*low, *high);
        check_range_of_heights(block, *values);
      }
      check_subsampling(layer, block, *values);
    });
    if (all.low != static_cast<float>(layer.min) || all.high != static_cast<float>(layer.max)) {
      findings_.add(layer.name + ": its heights span " + std::to_string(all.low) + " to " +
                    std::to_string(all.high) + " m, planet.json says " + std::to_string(layer.min) + " to " +
                    std::to_string(layer.max));
    }
  }

  void check_subsampling(const LayerInfo& layer, const Block& block, const Values& fine) const {
    if (block.level == 0 || block.cells < 2) return;
    const int half = block.cells / 2;
    const auto coarse = read(layer, block.d, block.level - 1, block.i0 / 2, block.j0 / 2, half + 1, half + 1);
    if (!coarse) return;
    for (int j = coarse->j0; j <= coarse->j0 + half; ++j) {
      for (int i = coarse->i0; i <= coarse->i0 + half; ++i) {
        if (coarse->at(i, j) != fine.at(2 * i, 2 * j) && !std::isnan(fine.at(2 * i, 2 * j)))
          findings_.add(layer.name, block.d, block.level - 1, "heights are not those of the finer level", i,
                        j);
      }
    }
  }

  /// That every cell of the ranges' finest level holds the heights of its nodes.
  void check_range_of_heights(const Block& block, const Values& heights) const {
    const LayerInfo* layer = data_.layer("height_range");
    if (layer == nullptr || layer->level > block.level) return;
    const int shift = block.level - layer->level;
    const int side = 1 << shift;
    const int across = std::max(1, block.cells >> shift);
    const auto ranges =
        read(*layer, block.d, layer->level, block.i0 >> shift, block.j0 >> shift, across, across);
    if (!ranges) return;
    for (int cj = ranges->j0; cj < ranges->j0 + across; ++cj) {
      for (int ci = ranges->i0; ci < ranges->i0 + across; ++ci) {
        float low = HUGE_VALF, high = -HUGE_VALF;
        for (int j = cj * side; j <= (cj + 1) * side; ++j) {
          for (int i = ci * side; i <= (ci + 1) * side; ++i) {
            low = std::min(low, heights.at(i, j));
            high = std::max(high, heights.at(i, j));
          }
        }
        if (!(ranges->at(ci, cj, 0) <= low && ranges->at(ci, cj, 1) >= high))
          findings_.add(layer->name, block.d, layer->level, "cells do not hold their heights", ci, cj);
      }
    }
  }

  void check_cells(const LayerInfo& layer,
                   void (Verifier::*check)(const LayerInfo&, const Block&, const Values&) const) {
    for_each_block(layer, [&](const Block& block) {
      const auto values =
          read(layer, block.d, block.level, block.i0, block.j0, block.cells + 1, block.cells + 1);
      if (!values) return;
      check_finite(layer, block, *values);
      (this->*check)(layer, block, *values);
    });
  }

  /// That every coarse cell holds its four finer ones.
  void check_ranges(const LayerInfo& layer, const Block& block, const Values& fine) const {
    if (block.level == 0) return;
    const int half = block.cells / 2;
    const auto coarse = read(layer, block.d, block.level - 1, block.i0 / 2, block.j0 / 2, half, half);
    if (!coarse) return;
    for (int j = block.j0; j < block.j0 + block.cells; ++j) {
      for (int i = block.i0; i < block.i0 + block.cells; ++i) {
        if (!(coarse->at(i / 2, j / 2, 0) <= fine.at(i, j, 0) &&
              coarse->at(i / 2, j / 2, 1) >= fine.at(i, j, 1)))
          findings_.add(layer.name, block.d, block.level - 1, "cells do not hold their finer ones", i / 2,
                        j / 2);
      }
    }
  }

  /// That the means of both trixels lie in the range of their cell.
  void check_means(const LayerInfo& layer, const Block& block, const Values& means) const {
    const LayerInfo* range_layer = data_.layer("height_range");
    if (range_layer == nullptr || range_layer->level < block.level) return;
    const auto ranges =
        read(*range_layer, block.d, block.level, block.i0, block.j0, block.cells, block.cells);
    if (!ranges) return;
    for (int j = block.j0; j < block.j0 + block.cells; ++j) {
      for (int i = block.i0; i < block.i0 + block.cells; ++i) {
        // A mean in double, rounded to float, may pass the end of its range by a rounding.
        const float low = std::nextafter(ranges->at(i, j, 0), -HUGE_VALF);
        const float high = std::nextafter(ranges->at(i, j, 1), HUGE_VALF);
        for (int half = 0; half < 2; ++half) {
          if (!(means.at(i, j, half) >= low && means.at(i, j, half) <= high))
            findings_.add(layer.name, block.d, block.level, "means lie outside their cell's range", i, j);
        }
      }
    }
  }

  const Dataset& data_;
  Findings& findings_;
  const std::function<void(const std::string&, double)>& progress_;
  std::mutex progress_mutex_;
  std::atomic<std::uint64_t> nodes_ = 0;
};

}  // namespace

Verification verify_planet(const std::filesystem::path& folder, std::size_t cache_bytes,
                           const std::function<void(const std::string& stage, double fraction)>& progress) {
  Verification result;
  progress("checksums", 0.0);
  result.damage = find_damage(folder);
  const PlanetFile planet = read_planet_file(folder);
  for (const StoredLayer& layer : planet.layers) result.files += layer.files.size();
  for (const StoredInset& inset : planet.insets) {
    for (const std::vector<StoredFile>& block : inset.files) result.files += block.size();
  }
  ++result.files;  // planet.json itself
  const Dataset data = Dataset::open(folder, cache_bytes);
  Findings findings;
  result.nodes = Verifier(data, findings, progress).run();
  for (std::string& line : findings.lines()) result.damage.push_back(std::move(line));
  progress("insets", 0.0);
  for (std::string& line : inset_damage(data, result.nodes)) result.damage.push_back(std::move(line));
  return result;
}

}  // namespace globe::planet
