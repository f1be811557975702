#include "tests/bench/search/points.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace bench {

using globe::geo::dvec3;

namespace {

constexpr std::uint64_t kHeapSeed = 99;  ///< the same heaps for the points and for those who ask
constexpr std::size_t kHeaps = 2000;
constexpr double kEarthRadius_m = 6371e3;

}  // namespace

Points::Points(std::uint64_t seed) : random_(kHeapSeed) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (std::size_t k = 0; k < kHeaps; ++k) {
    const double spread_m = 5e3 * std::pow(60.0, unit(random_));
    heaps_.push_back({anywhere(), spread_m / kEarthRadius_m});
  }
  random_.seed(seed);
  normal_.reset();
}

dvec3 Points::anywhere() {
  return glm::normalize(dvec3{normal_(random_), normal_(random_), normal_(random_)});
}

Point Points::next() {
  dvec3 u = anywhere();
  if (random_() % 2 == 0) {
    const Heap& heap = heaps_[random_() % heaps_.size()];
    u = glm::normalize(heap.center +
                       heap.spread * dvec3{normal_(random_), normal_(random_), normal_(random_)});
  }
  const globe::geo::Geodetic at = globe::geo::degrees_from_normal(u);
  return {at.lat_deg, at.lon_deg};
}

void for_each_point(
    std::uint64_t count,
    const std::function<void(std::int64_t id, const Point&, const std::string& name)>& visit) {
  Points points(kSeed);
  for (std::uint64_t k = 1; k <= count; ++k)
    visit(static_cast<std::int64_t>(k), points.next(), "place " + std::to_string(k));
}

}  // namespace bench
