#include "globe/geo/normals.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "globe/base/vector_width.h"
#include "globe/geo/ellipsoid.h"
#include "globe/geo/sine_cosine.h"

namespace globe::geo {
namespace {

constexpr std::size_t kBlock = 512;

/// Removes the sign of a zero, so that equal points have equal bits.
GLOBE_INLINE double positive_zero(double x) { return x + 0.0; }

GLOBE_INLINE dvec3 normal(double lat_deg, double lon_deg) {
  const SineCosine lat = sine_cosine(lat_deg);
  const SineCosine lon = sine_cosine(lon_deg);
  return {positive_zero(lat.cosine * lon.cosine), positive_zero(lat.cosine * lon.sine),
          positive_zero(lat.sine)};
}

GLOBE_INLINE bool is_large(double lon_deg) { return std::abs(lon_deg) > kLargestAngle_deg; }

double folded(double lon_deg) { return is_large(lon_deg) ? std::remainder(lon_deg, 360.0) : lon_deg; }

GLOBE_FOR_EVERY_VECTOR_WIDTH void make_normals(const double* __restrict lat_deg,
                                               const double* __restrict lon_deg, std::size_t count,
                                               double* __restrict x, double* __restrict y,
                                               double* __restrict z) {
  for (std::size_t k = 0; k < count; ++k) {
    const dvec3 u = normal(lat_deg[k], lon_deg[k]);
    x[k] = u.x;
    y[k] = u.y;
    z[k] = u.z;
  }
}

}  // namespace

dvec3 normal_from_degrees(double lat_deg, double lon_deg) {
  assert(std::abs(lat_deg) <= 90.0 && std::isfinite(lon_deg));
  return normal(lat_deg, folded(lon_deg));
}

void normals_from_degrees(std::span<const double> lat_deg, std::span<const double> lon_deg,
                          std::span<double> x, std::span<double> y, std::span<double> z) {
  const std::size_t count = lat_deg.size();
  assert(lon_deg.size() == count && x.size() == count && y.size() == count && z.size() == count);
  std::array<double, kBlock> small_lon_deg{};
  for (std::size_t first = 0; first < count; first += kBlock) {
    const auto lon = lon_deg.subspan(first, std::min(kBlock, count - first));
    const double* longitudes = lon.data();
    if (std::any_of(lon.begin(), lon.end(), is_large)) {
      std::transform(lon.begin(), lon.end(), small_lon_deg.begin(), folded);
      longitudes = small_lon_deg.data();
    }
    make_normals(&lat_deg[first], longitudes, lon.size(), &x[first], &y[first], &z[first]);
  }
}

}  // namespace globe::geo
