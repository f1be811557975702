#include "converters/map_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "converters/node_block.h"
#include "globe/geo/normals.h"
#include "globe/htm/trixel.h"
#include "globe/planet/cell.h"
#include "globe/planet/lattice_spline.h"

namespace converters {
namespace {

using globe::planet::Cell;
using globe::planet::dvec3;
using globe::planet::Node;
using globe::planet::nodes_per_side;

constexpr int kLargeBlock = 64;
constexpr int kSmallBlock = 8;
/// Where pixels are this many cells apart a block of nodes serves hardly more than one of them.
constexpr double kScattered = 8.0;
constexpr std::size_t kSlots = 128;          ///< blocks a thread holds: 15 MB
constexpr std::size_t kPlacesAtOnce = 4096;  ///< few enough that the index stays on this thread
constexpr std::size_t kMapChannels = 3;

/// Cells of a level along a step of a map at the equator.
double cells_along(double step_deg, int level) { return step_deg / 90.0 * nodes_per_side(level); }

double determinant(const dvec3& a, const dvec3& b, const dvec3& p) {
  return glm::dot(glm::cross(a - p, b - p), p);
}

/// Weights of a trixel's corners where the ray of a direction meets it: not negative, sum 1.
std::array<double, 3> weights_in(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& u) {
  const double w0 = std::max(determinant(b, c, u), 0.0);
  const double w1 = std::max(determinant(c, a, u), 0.0);
  const double w2 = std::max(determinant(a, b, u), 0.0);
  const double scale = 1.0 / (w0 + w1 + w2);
  return {w0 * scale, w1 * scale, w2 * scale};
}

}  // namespace

/// Blocks of nodes with their directions and values, read when asked for; a new one takes the slot of an
/// older.
class MapSampler::Blocks {
 public:
  Blocks(const NodeValues& values, int side)
      : values_(values), side_(side), slots_(kSlots), latest_(slots_.data()) {}

  struct Block {
    int d, i0, j0, side;
    NodeBlock directions;
    std::vector<float> values;
    int channels;

    const float* at(int i, int j) const {
      return values.data() + static_cast<std::size_t>(((j - j0) * (side + 1) + (i - i0)) * channels);
    }
  };

  /// The block of a cell, or of a node that is the first of one or lies on the diamond's far border. Valid
  /// until the next call.
  const Block& holding(int d, int i, int j) {
    const int last = nodes_per_side(values_.level()) / side_ - 1;
    const int bi = std::min(i / side_, last);
    const int bj = std::min(j / side_, last);
    const auto is_it = [&](const std::optional<Block>* slot) {
      return *slot && (*slot)->d == d && (*slot)->i0 == bi * side_ && (*slot)->j0 == bj * side_;
    };
    if (is_it(latest_)) return **latest_;
    latest_ = &slots_[globe::planet::vertex_hash(0, {d, bi, bj}) % kSlots];
    if (!is_it(latest_)) load(d, bi, bj, *latest_);
    return **latest_;
  }

 private:
  void load(int d, int bi, int bj, std::optional<Block>& slot) const {
    const int i0 = bi * side_, j0 = bj * side_;
    std::vector<float> read(static_cast<std::size_t>((side_ + 1) * (side_ + 1) * values_.channels()));
    values_.read(d, i0, j0, side_, read.data());
    slot.reset();
    slot.emplace(Block{d, i0, j0, side_, NodeBlock(d, values_.level(), i0, j0, side_), std::move(read),
                       values_.channels()});
  }

  const NodeValues& values_;
  int side_;
  std::vector<std::optional<Block>> slots_;
  std::optional<Block>* latest_;
};

MapSampler::~MapSampler() = default;

MapSampler::MapSampler(const NodeValues& values, Sampling sampling, const MapWindow& window)
    : values_(values), sampling_(sampling), window_(window) {
  const auto places = [&](double step_deg) {
    return sampling == Sampling::kArea
               ? std::max(1, static_cast<int>(std::ceil(cells_along(step_deg, values.level()) - 1e-6)))
               : 1;
  };
  places_down_ = places(window.step_y_deg);
  const double apart = cells_along(std::max(window.step_x_deg, window.step_y_deg), values.level());
  const int side = sampling != Sampling::kArea && apart > kScattered ? kSmallBlock : kLargeBlock;
  block_side_ = std::min(side, nodes_per_side(values.level()));
}

void MapSampler::sample(int x0, int y0, int nx, int ny, float* out) const {
  std::unique_ptr<Blocks>& blocks = blocks_.local();
  if (!blocks) blocks = std::make_unique<Blocks>(values_, block_side_);
  const std::ptrdiff_t row = std::ptrdiff_t{nx} * values_.channels();
  for (int y = 0; y < ny; ++y) sample_row(x0, y0 + y, nx, *blocks, out + y * row);
}

void MapSampler::sample_row(int x0, int y, int nx, Blocks& blocks, float* out) const {
  const int level = values_.level();
  const auto channels = static_cast<std::size_t>(values_.channels());
  const double widest = std::cos(std::min(std::abs(window_.latitude(y)), std::abs(window_.latitude(y + 1))) *
                                 std::numbers::pi / 180.0);
  const double across = sampling_ == Sampling::kArea ? cells_along(window_.step_x_deg, level) * widest : 1.0;
  const auto places_across = static_cast<std::size_t>(std::max(1.0, std::ceil(across - 1e-6)));
  std::vector<double> sums(static_cast<std::size_t>(nx) * channels);
  double whole_weight = 0.0;

  const std::size_t places = static_cast<std::size_t>(nx) * places_across;
  const std::size_t at_once = std::min(places, kPlacesAtOnce);
  std::vector<double> lat(at_once), lon(at_once), ux(at_once), uy(at_once), uz(at_once);
  std::vector<globe::htm::Trixel> trixels(at_once);

  const auto value_of = [&](std::size_t k, std::array<double, kMapChannels>& value) {
    const Cell cell = globe::planet::cell_from_trixel(trixels[k]);
    const Blocks::Block& block = blocks.holding(cell.d, cell.i, cell.j);
    // The corners in the order of LatticeTrixel: right angle, along i, along j.
    const int h = cell.half, s = 1 - 2 * h;
    const std::array<std::array<int, 2>, 3> corner{
        {{cell.i + h, cell.j + h}, {cell.i + h + s, cell.j + h}, {cell.i + h, cell.j + h + s}}};
    const auto direction = [&](std::size_t c) -> const dvec3& {
      return block.directions.at(corner[c][0], corner[c][1]);
    };
    const std::array<double, 3> w =
        weights_in(direction(0), direction(1), direction(2), {ux[k], uy[k], uz[k]});
    if (sampling_ == Sampling::kCubic) {
      const double x = h == 0 ? w[1] : 1.0 - w[1];
      const double y_in_cell = h == 0 ? w[2] : 1.0 - w[2];
      for (std::size_t c = 0; c < channels; ++c) {
        value[c] = lattice_spline(Node{cell.d, level, cell.i, cell.j}, x, y_in_cell, [&](const Node& node) {
          return static_cast<double>(blocks.holding(node.d, node.i, node.j).at(node.i, node.j)[c]);
        });
      }
      return;
    }
    const auto at = [&](std::size_t c) { return block.at(corner[c][0], corner[c][1]); };
    if (sampling_ == Sampling::kNearest) {
      const float* nearest = at(static_cast<std::size_t>(std::max_element(w.begin(), w.end()) - w.begin()));
      std::copy_n(nearest, channels, value.begin());
      return;
    }
    const float *a = at(0), *b = at(1), *c = at(2);
    for (std::size_t k2 = 0; k2 < channels; ++k2) {
      value[k2] = w[0] * static_cast<double>(a[k2]) + w[1] * static_cast<double>(b[k2]) +
                  w[2] * static_cast<double>(c[k2]);
    }
  };

  for (int s = 0; s < places_down_; ++s) {
    const double latitude = window_.latitude(y + (s + 0.5) / places_down_);
    const double weight = std::cos(latitude * std::numbers::pi / 180.0);
    whole_weight += weight * static_cast<double>(places_across);
    for (std::size_t first = 0; first < places; first += at_once) {
      const std::size_t count = std::min(at_once, places - first);
      for (std::size_t k = 0; k < count; ++k) {
        lat[k] = latitude;
        lon[k] = window_.longitude(x0 + (static_cast<double>(first + k) + 0.5) /
                                            static_cast<double>(places_across));
      }
      const auto part = [count](std::vector<double>& all) { return std::span(all).first(count); };
      globe::geo::normals_from_degrees(part(lat), part(lon), part(ux), part(uy), part(uz));
      globe::htm::trixels_at({part(ux), part(uy), part(uz)}, level, std::span(trixels).first(count));
      for (std::size_t k = 0; k < count; ++k) {
        std::array<double, kMapChannels> value{};
        value_of(k, value);
        double* sum = sums.data() + (first + k) / places_across * channels;
        for (std::size_t c = 0; c < channels; ++c) sum[c] += weight * value[c];
      }
    }
  }
  std::transform(sums.begin(), sums.end(), out,
                 [&](double sum) { return static_cast<float>(sum / whole_weight); });
}

}  // namespace converters
