#include "app/accuracy/vincenty.h"

#include <cmath>

#include "globe/base/angles.h"

namespace app::accuracy {
namespace {

using globe::kDegree;

}  // namespace

std::optional<double> vincenty(const globe::geo::Ellipsoid& ellipsoid, const globe::geo::Geodetic& p,
                               const globe::geo::Geodetic& q) {
  const double a = ellipsoid.a, f = ellipsoid.f, b = ellipsoid.b();
  const double u1 = std::atan((1.0 - f) * std::tan(p.lat_deg * kDegree));
  const double u2 = std::atan((1.0 - f) * std::tan(q.lat_deg * kDegree));
  const double lon = (q.lon_deg - p.lon_deg) * kDegree;
  double lambda = lon;
  for (int round = 0; round < 100; ++round) {
    const double x = std::cos(u2) * std::sin(lambda);
    const double y = std::cos(u1) * std::sin(u2) - std::sin(u1) * std::cos(u2) * std::cos(lambda);
    const double sin_sigma = std::hypot(x, y);
    if (sin_sigma == 0.0) return 0.0;
    const double cos_sigma = std::sin(u1) * std::sin(u2) + std::cos(u1) * std::cos(u2) * std::cos(lambda);
    const double sigma = std::atan2(sin_sigma, cos_sigma);
    const double sin_alpha = std::cos(u1) * std::cos(u2) * std::sin(lambda) / sin_sigma;
    const double cos2_alpha = 1.0 - sin_alpha * sin_alpha;
    const double cos_2m =
        cos2_alpha == 0.0 ? 0.0 : cos_sigma - 2.0 * std::sin(u1) * std::sin(u2) / cos2_alpha;
    const double c = f / 16.0 * cos2_alpha * (4.0 + f * (4.0 - 3.0 * cos2_alpha));
    const double bend = cos_2m + c * cos_sigma * (2.0 * cos_2m * cos_2m - 1.0);
    const double next = lon + (1.0 - c) * f * sin_alpha * (sigma + c * sin_sigma * bend);
    if (std::abs(next - lambda) < 1e-12) {
      const double k2 = cos2_alpha * (a * a - b * b) / (b * b);
      const double big_a = 1.0 + k2 / 16384.0 * (4096.0 + k2 * (-768.0 + k2 * (320.0 - 175.0 * k2)));
      const double big_b = k2 / 1024.0 * (256.0 + k2 * (-128.0 + k2 * (74.0 - 47.0 * k2)));
      const double m2 = 2.0 * cos_2m * cos_2m - 1.0;
      const double delta =
          big_b * sin_sigma *
          (cos_2m + big_b / 4.0 *
                        (cos_sigma * m2 - big_b / 6.0 * cos_2m * (4.0 * sin_sigma * sin_sigma - 3.0) *
                                              (4.0 * cos_2m * cos_2m - 3.0)));
      return b * big_a * (sigma - delta);
    }
    lambda = next;
  }
  return std::nullopt;
}

}  // namespace app::accuracy
