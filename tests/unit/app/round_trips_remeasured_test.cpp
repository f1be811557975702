#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "app/accuracy/conversion_studies.h"
#include "app/accuracy/samples.h"
#include "globe/planet/grid.h"
#include "tests/second_method.h"

// What maps lose on their way to nodes and back, as `globe accuracy` reports it, measured again by the
// textbook and in long double: they agree to 5 %.

namespace app::accuracy {
namespace {

using namespace second;
namespace planet = globe::planet;

/// A map's values anywhere. Heights are alike everywhere on the pole, so rows beyond it are those of the
/// other side.
class Plane {
 public:
  explicit Plane(converters::HeightMap map) : map_(std::move(map)), step_(360.0L / map_.width) {}

  Long column(const Geodetic& place) const { return (Long(place.lon_deg) + 180.0L) / step_ - 0.5L; }
  Long row(const Geodetic& place) const { return (90.0L - place.lat_deg) / step_ - 0.5L; }
  int width() const { return map_.width; }

  Long nearest(Long x, Long y) const {
    return pixel(static_cast<int>(std::floor(x + 0.5L)), static_cast<int>(std::floor(y + 0.5L)));
  }
  Long bilinear(Long x, Long y) const {
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const Long fx = x - x0, fy = y - y0;
    return (1.0L - fy) * ((1.0L - fx) * pixel(x0, y0) + fx * pixel(x0 + 1, y0)) +
           fy * ((1.0L - fx) * pixel(x0, y0 + 1) + fx * pixel(x0 + 1, y0 + 1));
  }
  /// Catmull and Rom's weights of 4 x 4 pixels at once, within their range.
  Long bicubic(Long x, Long y) const {
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const std::array<Long, 4> across = weights(x - x0), down = weights(y - y0);
    Long sum = 0, low = pixel(x0, y0), high = low;
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) {
        const Long value = pixel(x0 + i - 1, y0 + j - 1);
        sum += across[static_cast<std::size_t>(i)] * down[static_cast<std::size_t>(j)] * value;
        low = std::min(low, value);
        high = std::max(high, value);
      }
    }
    return std::clamp(sum, low, high);
  }
  Long row_mean(bool north) const {
    Long sum = 0;
    for (int x = 0; x < width(); ++x) sum += pixel(x, north ? 0 : map_.height() - 1);
    return sum / width();
  }

 private:
  static std::array<Long, 4> weights(Long t) {
    const Long s = 1.0L - t;
    return {-0.5L * t * s * s, 1.0L - 2.5L * t * t + 1.5L * t * t * t, 1.0L - 2.5L * s * s + 1.5L * s * s * s,
            -0.5L * t * t * s};
  }
  Long pixel(int x, int y) const {
    if (y < 0 || y >= map_.height()) {
      y = y < 0 ? -1 - y : 2 * map_.height() - 1 - y;
      x += map_.width / 2;
    }
    x = ((x % map_.width) + map_.width) % map_.width;
    return Long(map_.metres[static_cast<std::size_t>(y) * static_cast<std::size_t>(map_.width) +
                            static_cast<std::size_t>(x)]);
  }

  converters::HeightMap map_;
  Long step_;
};

struct Point {
  Long x, y;
};

/// The cell around a node whose corners are the middles of the trixels there, each moved so that the opposite
/// one mirrors it; columns and rows of the map, from the node.
std::vector<Point> cell_around(const Plane& map, const planet::Node& node) {
  const dvec3 u = planet::node_direction(node);
  std::vector<dvec3> around;
  for (const auto& step : planet::kLatticeSteps) {
    const dvec3 next =
        planet::node_direction(planet::fold({node.d, node.level, node.i + step.x, node.j + step.y}));
    if (std::find(around.begin(), around.end(), next) == around.end()) around.push_back(next);
  }
  const dvec3 east = glm::normalize(glm::cross(dvec3(0, 0, 1), u)), north = glm::cross(u, east);
  std::sort(around.begin(), around.end(), [&](const dvec3& a, const dvec3& b) {
    return std::atan2(glm::dot(a, north), glm::dot(a, east)) <
           std::atan2(glm::dot(b, north), glm::dot(b, east));
  });
  const Geodetic place = place_of(u);
  std::vector<Point> corners;
  for (std::size_t k = 0; k < around.size(); ++k) {
    const Geodetic middle = place_of(u + around[k] + around[(k + 1) % around.size()]);
    Point from_node{map.column(middle) - map.column(place), map.row(middle) - map.row(place)};
    from_node.x -= map.width() * std::round(from_node.x / map.width());
    corners.push_back(from_node);
  }
  std::vector<Point> cell;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Point& opposite = corners[(k + corners.size() / 2) % corners.size()];
    cell.push_back({(corners[k].x - opposite.x) / 2.0L, (corners[k].y - opposite.y) / 2.0L});
  }
  return cell;
}

bool holds(const std::vector<Point>& cell, const Point& p) {
  bool inside = false;
  for (std::size_t k = 0; k < cell.size(); ++k) {
    const Point &a = cell[k], &b = cell[(k + 1) % cell.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  }
  return inside;
}

/// Mean of the bilinear map over the cell around a node, by places on a grid.
Long area_mean(const Plane& map, const planet::Node& node) {
  const std::vector<Point> cell = cell_around(map, node);
  const Geodetic place = place_of(planet::node_direction(node));
  Long half_x = 0, half_y = 0;
  for (const Point& p : cell) {
    half_x = std::max(half_x, std::abs(p.x));
    half_y = std::max(half_y, std::abs(p.y));
  }
  constexpr int kSide = 14;
  Long sum = 0;
  int count = 0;
  for (int j = 0; j < kSide; ++j) {
    for (int i = 0; i < kSide; ++i) {
      const Point p{half_x * ((2 * i + 1.0L) / kSide - 1.0L), half_y * ((2 * j + 1.0L) / kSide - 1.0L)};
      if (!holds(cell, p)) continue;
      sum += map.bilinear(map.column(place) + p.x, map.row(place) + p.y);
      ++count;
    }
  }
  return sum / count;
}

/// What each filter gives all nodes of a level.
class Nodes {
 public:
  enum Filter { kNearest, kBilinear, kBicubic, kArea, kFilters };

  Nodes(const Plane& map, int level)
      : level_(level),
        side_(static_cast<std::size_t>(planet::nodes_per_side(level)) + 1),
        values_(planet::kDiamonds * side_ * side_) {
    tbb::parallel_for(std::size_t{0}, values_.size(), [&](std::size_t k) {
      const planet::Node node{static_cast<int>(k / (side_ * side_)), level, static_cast<int>(k % side_),
                              static_cast<int>(k / side_ % side_)};
      const Geodetic place = place_of(planet::node_direction(node));
      const Long x = map.column(place), y = map.row(place);
      const bool pole = std::abs(place.lat_deg) > 89.999;
      for (std::size_t filter = 0; filter < kFilters; ++filter) {
        values_[k][filter] = pole                  ? map.row_mean(place.lat_deg > 0)
                             : filter == kNearest  ? map.nearest(x, y)
                             : filter == kBilinear ? map.bilinear(x, y)
                             : filter == kBicubic  ? map.bicubic(x, y)
                                                   : area_mean(map, node);
      }
    });
  }

  const std::array<Long, kFilters>& at(const planet::Node& node) const {
    return values_[(static_cast<std::size_t>(node.d) * side_ + static_cast<std::size_t>(node.j)) * side_ +
                   static_cast<std::size_t>(node.i)];
  }
  const std::array<Long, kFilters>& at(const Geodetic& corner) const {
    const planet::Place place =
        planet::locate(globe::geo::normal_from_degrees(corner.lat_deg, corner.lon_deg), level_);
    return at(planet::Node{place.d, level_, static_cast<int>(std::lround(place.ij.x)),
                           static_cast<int>(std::lround(place.ij.y))});
  }
  /// By 4 x 4 nodes around a direction.
  Long spline_at(const dvec3& u, Filter filter) const {
    const planet::Place place = planet::locate(u, level_);
    const int last = static_cast<int>(side_) - 2;
    const int i0 = std::min(static_cast<int>(place.ij.x), last),
              j0 = std::min(static_cast<int>(place.ij.y), last);
    std::array<Long, 4> rows{};
    for (int j = 0; j < 4; ++j) {
      std::array<Long, 4> row{};
      for (int i = 0; i < 4; ++i)
        row[static_cast<std::size_t>(i)] =
            at(planet::fold({place.d, level_, i0 + i - 1, j0 + j - 1}))[filter];
      rows[static_cast<std::size_t>(j)] = spline(row, Long(place.ij.x) - i0);
    }
    return spline(rows, Long(place.ij.y) - j0);
  }

 private:
  int level_;
  std::size_t side_;
  std::vector<std::array<Long, kFilters>> values_;
};

TEST(AccuracyRemeasured, RoundTripsOfAMapByTheTextbook) {
  constexpr std::array kMethods{"nearest", "bilinear", "bicubic", "area", "bicubic, back cubic"};
  const MapSample sample = map_sample(Scope{});
  const int truth_width = sample.truth_width, level = sample.own_level;
  const converters::HeightMap truth = converters::map_of(known_relief(), truth_width);
  const converters::HeightMap pixels = converters::map_of(known_relief(), sample.width);
  const Plane map(pixels);
  const Nodes nodes(map, level);
  const Long truth_step = 360.0L / truth_width;
  std::vector<std::array<std::vector<Long>, kMethods.size()>> errors(
      static_cast<std::size_t>(truth.height()));
  tbb::parallel_for(0, truth.height(), [&](int y) {
    for (int x = 0; x < truth_width; ++x) {
      const dvec3 u = globe::geo::normal_from_degrees(static_cast<double>(90.0L - (y + 0.5L) * truth_step),
                                                      static_cast<double>((x + 0.5L) * truth_step - 180.0L));
      const Corners corners = corners_around(u, level);
      std::array<Long, kMethods.size()> back{};
      for (std::size_t c = 0; c < 3; ++c) {
        const auto& values = nodes.at(corners.places[c]);
        for (std::size_t filter = Nodes::kBilinear; filter <= Nodes::kArea; ++filter)
          back[filter] += corners.shares[c] * values[filter];
      }
      const auto most = std::max_element(corners.shares.begin(), corners.shares.end());
      back[0] =
          nodes.at(corners.places[static_cast<std::size_t>(most - corners.shares.begin())])[Nodes::kNearest];
      back[4] = nodes.spline_at(u, Nodes::kBicubic);
      const Long height = truth.metres[static_cast<std::size_t>(y) * static_cast<std::size_t>(truth_width) +
                                       static_cast<std::size_t>(x)];
      for (std::size_t method = 0; method < kMethods.size(); ++method)
        errors[static_cast<std::size_t>(y)][method].push_back(back[method] - height);
    }
  });
  std::array<Second, kMethods.size()> second;
  for (int y = 0; y < truth.height(); ++y) {
    const Long weight = std::cos((90.0L - (y + 0.5L) * truth_step) * kLongDegree);
    for (std::size_t method = 0; method < kMethods.size(); ++method)
      for (const Long error : errors[static_cast<std::size_t>(y)][method]) second[method].add(error, weight);
  }
  const std::vector<Study> studies{filter_study(std::make_shared<const converters::HeightMap>(pixels), level,
                                                level, std::make_shared<const converters::HeightMap>(truth))};
  for (std::size_t method = 0; method < kMethods.size(); ++method)
    expect_agreement(setting(studies, "conversion.filter.l" + std::to_string(level), kMethods[method]),
                     second[method]);
}

}  // namespace
}  // namespace app::accuracy
