#include "converters/inset_shape.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace converters {
namespace {

using globe::planet::InsetBlock;
using globe::planet::Node;

enum class State : std::uint8_t { kOutside, kData, kVoid, kSeen };

/// The nodes beside a node that differ from it, by their first names; around an octahedron corner some come
/// twice.
std::array<Node, 6> neighbours(const Node& node) {
  const int n = globe::planet::nodes_per_side(node.level);
  std::array<Node, 6> found;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Node beside{node.d, node.level, node.i + globe::planet::kLatticeSteps[k].x,
                      node.j + globe::planet::kLatticeSteps[k].y};
    const bool inside = beside.i > 0 && beside.j > 0 && beside.i < n && beside.j < n;
    found[k] = inside ? beside : first_name(globe::planet::fold(beside));
  }
  return found;
}

class Shaper {
 public:
  Shaper(std::vector<InsetGrid<float>> values, const ShapeRule& rule, ShapeReport& report)
      : values_(std::move(values)),
        rule_(rule),
        report_(report),
        level_(values_.front().level()),
        state_(level_, values_.front().bounds(), State::kOutside) {}

  InsetSamples run() {
    mark_data();
    mark_outside();
    settle_voids();
    InsetSamples samples{{}, weights()};
    carry_on(samples.weight);
    samples.values = std::move(values_);
    return samples;
  }

 private:
  void mark_data() {
    for_each_vertex(values_.front(), [&](const Node& node) {
      const bool known = !std::isnan(values_.front().get(node));
      state_.set_all_names(node, known ? State::kData : State::kVoid);
      if (known) ++report_.data;
    });
  }

  /// Voids that reach the outside belong to it.
  void mark_outside() {
    std::vector<Node> open;
    for_each_vertex(values_.front(), [&](const Node& node) {
      if (state_.get(node) != State::kVoid) return;
      for (const Node& beside : neighbours(node)) {
        if (!values_.front().has(beside)) {
          state_.set_all_names(node, State::kOutside);
          open.push_back(node);
          return;
        }
      }
    });
    while (!open.empty()) {
      const Node node = open.back();
      open.pop_back();
      for (const Node& beside : neighbours(node)) {
        if (state_.get(beside) != State::kVoid) continue;
        state_.set_all_names(beside, State::kOutside);
        open.push_back(beside);
      }
    }
  }

  /// Fills narrow voids; the others count as outside.
  void settle_voids() {
    std::vector<Node> voids;
    for_each_vertex(values_.front(), [&](const Node& node) {
      if (state_.get(node) == State::kVoid) voids.push_back(node);
    });
    for (const Node& node : voids) {
      if (state_.get(node) != State::kVoid) continue;
      const std::vector<Node> one = connected_void(node);
      const std::vector<std::vector<Node>> layers = layers_of(one);
      if (2.0 * static_cast<double>(layers.size()) <= rule_.widest_gap) {
        fill(layers);
        report_.filled += one.size();
        for (const Node& filled : one) state_.set_all_names(filled, State::kData);
      } else {
        report_.open += one.size();
        for (const Node& left : one) state_.set_all_names(left, State::kOutside);
      }
    }
  }

  std::vector<Node> connected_void(const Node& from) {
    std::vector<Node> nodes{from};
    state_.set_all_names(from, State::kSeen);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      for (const Node& beside : neighbours(nodes[k])) {
        if (state_.get(beside) != State::kVoid) continue;
        state_.set_all_names(beside, State::kSeen);
        nodes.push_back(beside);
      }
    }
    return nodes;
  }

  /// The nodes of a void by their distance from data, nearest first; they become kVoid again.
  std::vector<std::vector<Node>> layers_of(const std::vector<Node>& nodes) {
    std::vector<std::vector<Node>> layers(1);
    for (const Node& node : nodes) {
      const auto around = neighbours(node);
      if (std::any_of(around.begin(), around.end(),
                      [&](const Node& beside) { return state_.get(beside) == State::kData; }))
        layers[0].push_back(node);
    }
    for (const Node& node : layers[0]) state_.set_all_names(node, State::kVoid);
    while (!layers.back().empty()) {
      std::vector<Node> next;
      for (const Node& node : layers.back()) {
        for (const Node& beside : neighbours(node)) {
          if (state_.get(beside) != State::kSeen) continue;
          state_.set_all_names(beside, State::kVoid);
          next.push_back(beside);
        }
      }
      layers.push_back(std::move(next));
    }
    layers.pop_back();
    return layers;
  }

  /// From the borders inwards, then drawn tight.
  void fill(const std::vector<std::vector<Node>>& layers) {
    for (const std::vector<Node>& layer : layers) grow(layer);
    const std::size_t rounds = std::min<std::size_t>(8 * layers.size(), 400);
    for (std::size_t round = 0; round < rounds; ++round) {
      for (const std::vector<Node>& layer : layers) {
        for (const Node& node : layer) {
          for (InsetGrid<float>& grid : values_) {
            double sum = 0.0;
            for (const Node& beside : neighbours(node)) sum += static_cast<double>(grid.get(beside));
            grid.set_all_names(node, static_cast<float>(sum / 6.0));
          }
        }
      }
    }
  }

  /// Gives nodes that touch known ones the mean of these.
  void grow(const std::vector<Node>& layer) {
    for (InsetGrid<float>& grid : values_) {
      std::vector<float> means;
      for (const Node& node : layer) {
        double sum = 0.0;
        int count = 0;
        for (const Node& beside : neighbours(node)) {
          const float value = grid.get(beside);
          if (std::isnan(value)) continue;
          sum += static_cast<double>(value);
          ++count;
        }
        means.push_back(static_cast<float>(sum / count));
      }
      for (std::size_t k = 0; k < layer.size(); ++k) grid.set_all_names(layer[k], means[k]);
    }
  }

  /// Data nodes by their distance from where data end, up to `farthest`: layers[0] touches the outside.
  std::vector<std::vector<Node>> rim_layers(int farthest) {
    std::vector<std::vector<Node>> layers(1);
    for_each_vertex(values_.front(), [&](const Node& node) {
      if (state_.get(node) != State::kData) return;
      const auto around = neighbours(node);
      if (std::any_of(around.begin(), around.end(),
                      [&](const Node& beside) { return state_.get(beside) == State::kOutside; }))
        layers[0].push_back(node);
    });
    for (const Node& node : layers[0]) state_.set_all_names(node, State::kSeen);
    while (!layers.back().empty() && layers.size() < static_cast<std::size_t>(farthest)) {
      std::vector<Node> next;
      for (const Node& node : layers.back()) {
        for (const Node& beside : neighbours(node)) {
          if (state_.get(beside) != State::kData) continue;
          state_.set_all_names(beside, State::kSeen);
          next.push_back(beside);
        }
      }
      layers.push_back(std::move(next));
    }
    if (layers.back().empty()) layers.pop_back();
    return layers;
  }

  InsetGrid<float> weights() {
    InsetGrid<float> weight(level_, values_.front().bounds(), 0.0F);
    const std::vector<std::vector<Node>> layers = rim_layers(rule_.rim);
    const int rim = std::max(static_cast<int>(layers.size()), 4);
    report_.rim = rim;
    const int rounds = std::clamp(rim / 4, 1, 8);
    for_each_vertex(values_.front(), [&](const Node& node) {
      if (state_.get(node) == State::kData) weight.set_all_names(node, 1.0F);
    });
    for (std::size_t k = 0; k < layers.size(); ++k) {
      const double t = std::clamp((static_cast<double>(k + 1) - rounds) / (rim - 2.0 * rounds), 0.0, 1.0);
      for (const Node& node : layers[k])
        weight.set_all_names(node, static_cast<float>(t * t * (3.0 - 2.0 * t)));
    }
    std::vector<float> smooth;
    for (int round = 0; round < rounds; ++round) {
      smooth.clear();
      for (const std::vector<Node>& layer : layers) {
        for (const Node& node : layer) {
          double sum = 2.0 * static_cast<double>(weight.get(node));
          for (const Node& beside : neighbours(node)) sum += static_cast<double>(weight.get(beside));
          smooth.push_back(static_cast<float>(sum / 8.0));
        }
      }
      std::size_t at = 0;
      for (const std::vector<Node>& layer : layers)
        for (const Node& node : layer) weight.set_all_names(node, smooth[at++]);
    }
    return weight;
  }

  /// Carries values on beyond the data.
  void carry_on(const InsetGrid<float>& weight) {
    std::vector<Node> last;
    for_each_vertex(weight, [&](const Node& node) {
      if (weight.get(node) > 0.0F && weight.get(node) < 1.0F) last.push_back(node);
    });
    for (int step = 0; step < globe::planet::kInsetMargin; ++step) {
      std::vector<Node> next;
      for (const Node& node : last) {
        for (const Node& beside : neighbours(node)) {
          if (!std::isnan(values_.front().get(beside)) || state_.get(beside) == State::kVoid) continue;
          if (!values_.front().has(beside)) continue;
          state_.set_all_names(beside, State::kVoid);
          next.push_back(beside);
        }
      }
      grow(next);
      last = std::move(next);
    }
  }

  std::vector<InsetGrid<float>> values_;
  ShapeRule rule_;
  ShapeReport& report_;
  int level_;
  InsetGrid<State> state_;
};

}  // namespace

InsetSamples shape_inset(std::vector<InsetGrid<float>> values, const ShapeRule& rule, ShapeReport& report) {
  return Shaper(std::move(values), rule, report).run();
}

}  // namespace converters
