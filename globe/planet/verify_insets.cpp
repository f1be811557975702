#include "globe/planet/verify_insets.h"

#include <algorithm>
#include <set>

#include "globe/base/error.h"
#include "globe/planet/grid.h"

namespace globe::planet {
namespace {

class InsetVerifier {
 public:
  InsetVerifier(const Dataset& data, std::size_t number, std::set<std::string>& damage)
      : data_(data), number_(number), info_(data.info().insets[number]), damage_(damage) {}

  std::uint64_t run() {
    std::uint64_t nodes = 0;
    for (const InsetBlock& finest : info_.blocks) {
      for (int level = info_.level; level >= 0; --level) {
        const InsetBlock block = finest.coarser(info_.level - level);
        constexpr int kRows = 64;
        for (int j = block.j0; j <= block.j1 && !block.empty(); j += kRows) {
          const int rows = std::min(kRows, block.j1 - j + 1);
          try {
            check({block.d, block.i0, block.i1, j, j + rows - 1}, level);
          } catch (const Error& error) {
            damage_.insert(error.what());
          }
          nodes += static_cast<std::uint64_t>(rows) * static_cast<std::uint64_t>(block.i1 - block.i0 + 1);
        }
      }
    }
    return nodes;
  }

 private:
  bool has_heights() const { return info_.layer == "height"; }
  std::size_t channels() const { return has_heights() ? 1 : 3; }

  void add(int level, const std::string& what) {
    damage_.insert("inset " + info_.name + ", " + info_.layer + ", level " + std::to_string(level) + ": " +
                   what);
  }

  std::vector<float> read(const std::string& what, std::size_t channels, const InsetBlock& rows,
                          int level) const {
    const int ni = rows.i1 - rows.i0 + 1, nj = rows.j1 - rows.j0 + 1;
    std::vector<float> samples(static_cast<std::size_t>(ni) * static_cast<std::size_t>(nj) * channels);
    data_.read_inset(number_, what, rows.d, level, rows.i0, rows.j0, ni, nj, samples.data());
    return samples;
  }

  void check(const InsetBlock& rows, int level) {
    const std::vector<float> weights = read("weight", 1, rows, level);
    const std::vector<float> values = read(info_.layer, channels(), rows, level);
    if (has_heights() && level < info_.level) read("relief", 1, rows, level);
    const int n = nodes_per_side(level);
    std::size_t at = 0;
    for (int j = rows.j0; j <= rows.j1; ++j) {
      for (int i = rows.i0; i <= rows.i1; ++i, ++at) {
        const float w = weights[at];
        const float* value = &values[at * channels()];
        if (!(w >= 0.0f && w <= 1.0f)) add(level, "weights are not between 0 and 1");
        const double height = static_cast<double>(value[0]);
        if (has_heights() && w > 0.0f && !(height >= info_.min && height <= info_.max))
          add(level, "heights are not in the range that planet.json says");
        if (i == 0 || j == 0 || i == n || j == n) check_border({rows.d, level, i, j}, w, value);
      }
    }
    if (level < info_.level) check_against_finer(rows, level, weights, values);
  }

  void check_border(const Node& node, float w, const float* value) {
    const Names all = names(node);
    for (int k = 1; k < all.count; ++k) {
      const Node& other = all.node[static_cast<std::size_t>(k)];
      const InsetBlock one{other.d, other.i, other.i, other.j, other.j};
      const std::vector<float> values = read(info_.layer, channels(), one, other.level);
      if (read("weight", 1, one, other.level)[0] != w ||
          (w > 0.0f && !std::equal(values.begin(), values.end(), value)))
        add(node.level, "nodes on a border are not the same in both diamonds");
    }
  }

  void check_against_finer(const InsetBlock& rows, int level, const std::vector<float>& weights,
                           const std::vector<float>& values) {
    const InsetBlock finer{rows.d, 2 * rows.i0, 2 * rows.i1, 2 * rows.j0, 2 * rows.j1};
    const std::vector<float> fine_weights = read("weight", 1, finer, level + 1);
    const std::vector<float> fine_values = read(info_.layer, channels(), finer, level + 1);
    const auto across = static_cast<std::size_t>(rows.i1 - rows.i0 + 1);
    const std::size_t fine_across = 2 * across - 1;
    for (std::size_t at = 0; at < weights.size(); ++at) {
      const std::size_t fine = 2 * (at / across) * fine_across + 2 * (at % across);
      if (weights[at] != fine_weights[fine] || (has_heights() && values[at] != fine_values[fine]))
        add(level, "samples are not those of the finer level");
    }
  }

  const Dataset& data_;
  std::size_t number_;
  const InsetInfo& info_;
  std::set<std::string>& damage_;
};

}  // namespace

std::vector<std::string> inset_damage(const Dataset& data, std::uint64_t& nodes) {
  std::set<std::string> damage;
  for (std::size_t k = 0; k < data.info().insets.size(); ++k) nodes += InsetVerifier(data, k, damage).run();
  return {damage.begin(), damage.end()};
}

}  // namespace globe::planet
