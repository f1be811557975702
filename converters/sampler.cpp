#include "converters/sampler.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "converters/block_sampler.h"

namespace converters {
namespace {

using globe::planet::nodes_per_side;

constexpr int kBlockSide = 64;
constexpr int kBlocksBetweenReports = 16;

/// Values and weights of some nodes of one block.
struct Samples {
  std::vector<float> values;
  std::vector<float> weights;

  Samples(const BlockPart& part, int channels)
      : values(part.size() * static_cast<std::size_t>(channels)), weights(part.size()) {}
};

/// Puts `below` under `above`: it makes up for the weights that are missing there.
void put_under(Samples& above, const Samples& below, std::size_t channels) {
  for (std::size_t k = 0; k < above.weights.size(); ++k) {
    const float share = std::min(below.weights[k], 1.0F - above.weights[k]);
    if (!(share > 0.0F)) continue;
    const float whole = above.weights[k] + share;
    float* value = above.values.data() + k * channels;
    const float* other = below.values.data() + k * channels;
    for (std::size_t c = 0; c < channels; ++c)
      value[c] = above.weights[k] == 0.0F ? other[c] : value[c] + (other[c] - value[c]) * (share / whole);
    above.weights[k] = whole;
  }
}

Samples sample_block(const MapStack& maps, const NodeBlock& nodes, const BlockPart& part, Gaps gaps) {
  const int channels = maps.channels();
  const auto& entries = maps.entries();
  Samples result(part, channels);
  const auto complete = [&] {
    return std::all_of(result.weights.begin(), result.weights.end(), [](float w) { return w >= 1.0F; });
  };
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
    BlockSampler sampler(*entry, nodes, part);
    if (entry == entries.rbegin()) {
      sampler.sample(result.values.data(), result.weights.data());
    } else {
      Samples below(part, channels);
      sampler.sample(below.values.data(), below.weights.data());
      put_under(result, below, static_cast<std::size_t>(channels));
    }
    if (complete()) return result;
  }
  if (gaps == Gaps::kZero) return result;
  std::vector<char> filled(part.size(), 0);
  for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
    if (!entry->map->has_voids()) continue;
    const BlockSampler sampler(*entry, nodes, part);
    for (int j = part.j0; j < part.j0 + part.nj; ++j) {
      for (int i = part.i0; i < part.i0 + part.ni; ++i) {
        const std::size_t k = part.index(i, j);
        if (result.weights[k] > 0.0F || filled[k] != 0 || !sampler.holds(i, j)) continue;
        sampler.fill(i, j, result.values.data() + k * static_cast<std::size_t>(channels));
        filled[k] = 1;
      }
    }
  }
  return result;
}

/// Blocks from the one that holds node `first` to that of node `last`; the last node of a diamond belongs to
/// the last block.
struct BlockRange {
  int first, count;
};
BlockRange blocks_of(int first, int last, int side, int n) {
  const int from = std::min(first / side, n / side - 1);
  return {from, std::min(last / side, n / side - 1) - from + 1};
}

/// The nodes of a block that lie in a range: `begin` and how many.
std::pair<int, int> nodes_of(int block, int side, int n, int first, int count) {
  const int end = (block + 1) * side == n ? n + 1 : (block + 1) * side;
  const int begin = std::max(first, block * side);
  return {begin, std::min(first + count, end) - begin};
}

}  // namespace

void sample_nodes(const MapStack& maps, const NodeRect& rect, Gaps gaps, const RowSink& sink,
                  const std::function<void(double)>& progress) {
  const int n = nodes_per_side(rect.level);
  const int side = std::min(kBlockSide, n);
  const BlockRange across = blocks_of(rect.i0, rect.i0 + rect.ni - 1, side, n);
  const BlockRange down = blocks_of(rect.j0, rect.j0 + rect.nj - 1, side, n);
  const auto channels = static_cast<std::size_t>(maps.channels());
  std::atomic<int> done = 0;
  // Along i first: rows of one diamond then cross the map from north to south, and what is read of it at a
  // time is a band.
  tbb::parallel_for(0, across.count * down.count, [&](int block) {
    const int block_i = across.first + block / down.count, block_j = down.first + block % down.count;
    const auto [i, ni] = nodes_of(block_i, side, n, rect.i0, rect.ni);
    const auto [j, nj] = nodes_of(block_j, side, n, rect.j0, rect.nj);
    const NodeBlock nodes(rect.d, rect.level, block_i * side, block_j * side, side);
    const BlockPart part{i, j, ni, nj};
    const Samples samples = sample_block(maps, nodes, part, gaps);
    for (int row = j; row < j + nj; ++row) {
      const std::size_t first = part.index(i, row);
      sink(i, row, ni, samples.values.data() + first * channels, samples.weights.data() + first);
    }
    const int now = ++done;
    if (now % kBlocksBetweenReports == 0) progress(double(now) / (across.count * down.count));
  });
}

void sample_rect(const MapStack& maps, const NodeRect& rect, Gaps gaps, float* values, float* weights) {
  const int channels = maps.channels();
  const auto sink = [&](int i, int j, int count, const float* from, const float* from_weights) {
    const auto first = static_cast<std::ptrdiff_t>(j - rect.j0) * rect.ni + (i - rect.i0);
    std::copy_n(from, count * channels, values + first * channels);
    std::copy_n(from_weights, count, weights + first);
  };
  sample_nodes(maps, rect, gaps, sink, [](double) {});
}

}  // namespace converters
