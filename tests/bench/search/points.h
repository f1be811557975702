#pragma once

#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "globe/geo/ellipsoid.h"

namespace bench {

struct Point {
  double lat_deg, lon_deg;
};

/// Points as catalogues have them: half anywhere, half in 2000 heaps of 5 to 300 km.
class Points {
 public:
  explicit Points(std::uint64_t seed);

  Point next();

 private:
  struct Heap {
    globe::geo::dvec3 center;
    double spread;  ///< radians
  };

  globe::geo::dvec3 anywhere();

  std::mt19937_64 random_;
  std::vector<Heap> heaps_;
  std::normal_distribution<double> normal_;
};

/// (distance m, id) of the features found, in that order.
using Answer = std::vector<std::pair<double, std::int64_t>>;

/// One way to look for points.
class Finder {
 public:
  virtual ~Finder() = default;
  /// All within a geodesic distance.
  virtual Answer within(const Point& near, double radius_m) = 0;
  virtual Answer nearest(const Point& near, std::size_t count) = 0;
};

/// Points 1 .. count of seed kSeed, one by one, with the name of each.
inline constexpr std::uint64_t kSeed = 1;
void for_each_point(std::uint64_t count,
                    const std::function<void(std::int64_t id, const Point&, const std::string& name)>& visit);

}  // namespace bench
