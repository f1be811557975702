#include "converters/inset_output.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <optional>

#include "converters/srgb.h"
#include "globe/base/error.h"
#include "globe/planet/tiff_level.h"

namespace converters {
namespace {

namespace fs = std::filesystem;
using globe::planet::InsetBlock;
using globe::planet::InsetFile;
using globe::planet::Node;
using globe::planet::StoredFile;

constexpr const char* kUnfinished = ".inset-partial.tif";

/// The nodes that have values, in a rectangle a diamond.
std::vector<InsetBlock> blocks_of(const InsetGrid<float>& values) {
  std::vector<InsetBlock> blocks;
  for (const auto& tile : values.tiles()) {
    for (int j = tile.j0; j <= tile.j1; ++j) {
      for (int i = tile.i0; i <= tile.i1; ++i) {
        if (std::isnan(values.get(tile.d, i, j))) continue;
        if (blocks.empty() || blocks.back().d != tile.d) blocks.push_back({tile.d, i, i, j, j});
        InsetBlock& block = blocks.back();
        block = {tile.d, std::min(block.i0, i), std::max(block.i1, i), std::min(block.j0, j),
                 std::max(block.j1, j)};
      }
    }
  }
  // A block of one node in a row would have no coarser level.
  for (InsetBlock& block : blocks) {
    const int n = globe::planet::nodes_per_side(values.level());
    block.i0 &= ~1;
    block.j0 &= ~1;
    block.i1 = std::min(block.i1 | 1, n);
    block.j1 = std::min(block.j1 | 1, n);
  }
  return blocks;
}

/// Values of the next coarser level, filtered: a quarter of the node itself and an eighth of each neighbour,
/// by weight. 0 where the weight is 0 all round.
InsetGrid<float> filtered(const InsetGrid<float>& fine, const InsetGrid<float>& weight, int coarser,
                          const std::vector<InsetBlock>& bounds) {
  InsetGrid<float> coarse(fine.level() - 1, bounds, 0.0F);
  for (const InsetBlock& block : bounds) {
    for (int j = block.j0; j <= block.j1; ++j) {
      for (int i = block.i0; i <= block.i1; ++i) {
        const Node node{block.d, coarse.level(), i, j};
        if (!is_first_name(node) || weight.get(node.d, i << (coarser + 1), j << (coarser + 1)) <= 0.0F)
          continue;
        double sum = 0, share = 0;
        const auto add = [&](int x, int y, double part) {
          const Node at = globe::planet::fold({block.d, fine.level(), x, y});
          const double w = part * static_cast<double>(weight.get(at.d, at.i << coarser, at.j << coarser));
          if (w > 0.0) {
            sum += w * static_cast<double>(fine.get(at));
            share += w;
          }
        };
        add(2 * i, 2 * j, 2.0);
        for (const auto& step : globe::planet::kLatticeSteps) add(2 * i + step.x, 2 * j + step.y, 1.0);
        coarse.set_all_names(node, static_cast<float>(sum / share));
      }
    }
  }
  return coarse;
}

/// Writes levels of one block into one file of an inset.
class BlockFile {
 public:
  BlockFile(const fs::path& path, const InsetBlock& finest, const InsetFile& file, int tile_size)
      : path_(path),
        file_(file),
        tile_size_(tile_size),
        writer_(path, static_cast<double>(finest.i1 - finest.i0 + 1) * (finest.j1 - finest.j0 + 1) *
                              file.channels * (file.storage == "uint8" ? 1 : 4) >
                          2.5e9) {}

  const fs::path& path() const { return path_; }

  /// `sample(i, j, to)` stores the channels of a node.
  void write(const InsetBlock& nodes, const std::function<void(int i, int j, std::byte* to)>& sample) {
    const globe::planet::TiffLevel level{nodes.i1 - nodes.i0 + 1, nodes.j1 - nodes.j0 + 1, file_.channels,
                                         file_.storage, tile_size_};
    const std::size_t bytes = level.sample_bytes();
    writer_.begin_level(level);
    std::vector<std::byte> tile(level.tile_bytes());
    for (int tj = 0; tj < level.tiles_down(); ++tj) {
      for (int ti = 0; ti < level.tiles_across(); ++ti) {
        tile.resize(level.tile_bytes());
        std::byte* to = tile.data();
        for (int y = tj * tile_size_; y < (tj + 1) * tile_size_; ++y) {
          for (int x = ti * tile_size_; x < (ti + 1) * tile_size_; ++x, to += bytes)
            sample(std::min(nodes.i0 + x, nodes.i1), std::min(nodes.j0 + y, nodes.j1), to);
        }
        writer_.write_tile(ti, tj, tile);
      }
    }
    writer_.end_level();
  }

  void finish() {
    writer_.finish();
    globe::planet::sync_to_disk(path_);
  }

 private:
  fs::path path_;
  InsetFile file_;
  int tile_size_;
  globe::planet::TiffWriter writer_;
};

void store(float value, std::byte* to) {
  const float known = std::isnan(value) ? 0.0F : value;
  std::memcpy(to, &known, sizeof known);
}

/// The levels of all files of an inset, one level of all blocks after the other.
class InsetWriter {
 public:
  InsetWriter(const fs::path& folder, const std::string& layer, const InsetSamples& samples, int tile_size)
      : samples_(samples),
        blocks_(blocks_of(samples.values.front())),
        kinds_(globe::planet::inset_files(layer)) {
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
      for (std::size_t f = 0; f < kinds_.size(); ++f) {
        const fs::path path = folder / ("." + std::to_string(b) + std::to_string(f) + kUnfinished);
        files_.push_back(std::make_unique<BlockFile>(path, blocks_[b].coarser(kinds_[f].levels_coarser),
                                                     kinds_[f], tile_size));
      }
    }
  }

  const std::vector<InsetBlock>& blocks() const { return blocks_; }
  const std::vector<InsetFile>& kinds() const { return kinds_; }
  const std::vector<std::unique_ptr<BlockFile>>& files() const { return files_; }

  void write() {
    const int finest = samples_.weight.level();
    std::vector<InsetGrid<float>> filtered_values;
    for (int coarser = 0; coarser <= finest; ++coarser) {
      std::vector<InsetBlock> held;
      for (const InsetBlock& block : blocks_) held.push_back(block.coarser(coarser));
      std::erase_if(held, [](const InsetBlock& block) { return block.empty(); });
      if (coarser > 0) {
        std::vector<InsetGrid<float>> next;
        for (std::size_t c = 0; c < samples_.values.size(); ++c) {
          const InsetGrid<float>& finer = coarser == 1 ? samples_.values[c] : filtered_values[c];
          next.push_back(filtered(finer, samples_.weight, coarser - 1, held));
        }
        filtered_values = std::move(next);
      }
      for (std::size_t k = 0; k < files_.size(); ++k) {
        const InsetBlock nodes = blocks_[k / kinds_.size()].coarser(coarser);
        if (!nodes.empty())
          write_level(*files_[k], kinds_[k % kinds_.size()], nodes, coarser, filtered_values);
      }
    }
    for (const auto& file : files_) file->finish();
  }

 private:
  void write_level(BlockFile& file, const InsetFile& kind, const InsetBlock& nodes, int coarser,
                   const std::vector<InsetGrid<float>>& filtered_values) const {
    if (coarser < kind.levels_coarser) return;
    if (kind.what == "weight" || kind.what == "height") {
      const InsetGrid<float>& grid = kind.what == "weight" ? samples_.weight : samples_.values.front();
      file.write(nodes, [&](int i, int j, std::byte* to) {
        store(grid.get(nodes.d, i << coarser, j << coarser), to);
      });
    } else if (kind.what == "relief") {
      file.write(nodes,
                 [&](int i, int j, std::byte* to) { store(filtered_values.front().get(nodes.d, i, j), to); });
    } else {
      const std::vector<InsetGrid<float>>& grids = coarser == 0 ? samples_.values : filtered_values;
      file.write(nodes, [&](int i, int j, std::byte* to) {
        for (std::size_t c = 0; c < grids.size(); ++c)
          to[c] = static_cast<std::byte>(srgb_byte_from_linear(grids[c].get(nodes.d, i, j)));
      });
    }
  }

  const InsetSamples& samples_;
  std::vector<InsetBlock> blocks_;
  std::vector<InsetFile> kinds_;
  std::vector<std::unique_ptr<BlockFile>> files_;  ///< block by block
};

/// Range of the values that have a weight; nothing when none has.
std::optional<std::pair<double, double>> range_of(const InsetSamples& samples) {
  std::optional<std::pair<double, double>> range;
  for (const auto& tile : samples.weight.tiles()) {
    for (int j = tile.j0; j <= tile.j1; ++j) {
      for (int i = tile.i0; i <= tile.i1; ++i) {
        if (samples.weight.get(tile.d, i, j) <= 0.0F) continue;
        for (const InsetGrid<float>& grid : samples.values) {
          const double value = static_cast<double>(grid.get(tile.d, i, j));
          if (!range) range.emplace(value, value);
          range->first = std::min(range->first, value);
          range->second = std::max(range->second, value);
        }
      }
    }
  }
  return range;
}

void remove_files(const std::vector<fs::path>& files) {
  std::error_code ignored;
  for (const fs::path& file : files) fs::remove(file, ignored);
}

}  // namespace

InsetOutput write_inset(const fs::path& folder, const std::string& name, const std::string& layer,
                        const InsetSamples& samples, int tile_size) {
  InsetOutput output;
  std::vector<fs::path> unfinished;
  try {
    const auto range = range_of(samples);
    if (!range) throw globe::Error(name, "nothing of it has a weight", "give data wider than their rim");
    InsetWriter writer(folder, layer, samples, tile_size);
    for (const auto& file : writer.files()) unfinished.push_back(file->path());
    writer.write();
    output.stored.info = {name, layer, samples.weight.level(), range->first, range->second, writer.blocks()};
    for (std::size_t b = 0; b < writer.blocks().size(); ++b) {
      std::vector<StoredFile> files;
      for (std::size_t f = 0; f < writer.kinds().size(); ++f) {
        const fs::path from = writer.files()[b * writer.kinds().size() + f]->path();
        StoredFile file = globe::planet::describe_file(from);
        char hash[17];
        std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(file.hash));
        file.name = "inset_" + name + "_" + layer + "_" + writer.kinds()[f].what + "_" +
                    std::to_string(writer.blocks()[b].d) + "_" + hash + ".tif";
        if (!fs::exists(folder / file.name)) output.made.push_back(folder / file.name);
        fs::rename(from, folder / file.name);
        files.push_back(std::move(file));
      }
      output.stored.files.push_back(std::move(files));
    }
    return output;
  } catch (...) {
    remove_files(unfinished);
    remove_files(output.made);
    throw;
  }
}

PlanetLock::PlanetLock(const fs::path& folder) {
  lock_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0 || ::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
    if (lock_ >= 0) ::close(lock_);
    throw globe::Error(folder.string(), "another program is changing this planet", "wait until it is done");
  }
  std::vector<fs::path> stale;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (entry.path().string().ends_with(kUnfinished)) stale.push_back(entry.path());
  remove_files(stale);
}

PlanetLock::~PlanetLock() { ::close(lock_); }

}  // namespace converters
