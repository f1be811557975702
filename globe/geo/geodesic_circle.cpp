#include "globe/geo/geodesic_circle.h"

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace globe::geo {
namespace {

GeographicLib::Geodesic geodesic(const Ellipsoid& ellipsoid) { return {ellipsoid.a, ellipsoid.f}; }

/// A bound of |cosine cos x + sine sin x|.
double magnitude(const dvec3& cosine, const dvec3& sine) {
  return std::sqrt(glm::dot(cosine, cosine) + glm::dot(sine, sine));
}

}  // namespace

GeodesicCircle::GeodesicCircle(const Ellipsoid& ellipsoid, const Geodetic& center, double radius_m) {
  constexpr std::size_t kFewest = 32, kMost = 4096;
  constexpr double kNegligible = 1e-15;  // geodesics end within 2e-15 rad of where they should
  const auto earth = geodesic(ellipsoid);
  for (std::size_t samples = kFewest; samples <= kMost; samples *= 2) {
    const std::size_t terms = samples / 2;
    cosine_.assign(terms, dvec3(0.0));
    sine_.assign(terms, dvec3(0.0));
    std::vector<dvec3> wheel(samples);  // cos and sin of whole steps
    for (std::size_t k = 0; k < samples; ++k) {
      const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(samples);
      wheel[k] = {std::cos(angle), std::sin(angle), 0.0};
    }
    for (std::size_t n = 0; n < samples; ++n) {
      double lat = 0, lon = 0;
      earth.Direct(center.lat_deg, center.lon_deg,
                   360.0 * static_cast<double>(n) / static_cast<double>(samples), radius_m, lat, lon);
      const dvec3 u = normal_from_degrees(lat, lon) / static_cast<double>(terms);
      for (std::size_t k = 0; k < terms; ++k) {
        cosine_[k] += wheel[k * n % samples].x * u;
        sine_[k] += wheel[k * n % samples].y * u;
      }
    }
    cosine_[0] *= 0.5;
    double tail = 0;
    for (std::size_t k = terms - terms / 4; k < terms; ++k)
      tail = std::max(tail, magnitude(cosine_[k], sine_[k]));
    if (tail < kNegligible) break;
  }
  while (cosine_.size() > 2 && magnitude(cosine_.back(), sine_.back()) < kNegligible) {
    cosine_.pop_back();
    sine_.pop_back();
  }
  for (std::size_t k = 1; k < cosine_.size(); ++k)
    bend_ += static_cast<double>(k * k) * magnitude(cosine_[k], sine_[k]);
}

dvec3 GeodesicCircle::at(double azimuth_rad) const {
  const double c = std::cos(azimuth_rad), s = std::sin(azimuth_rad);
  dvec3 u = cosine_[0];
  double ck = 1.0, sk = 0.0;
  for (std::size_t k = 1; k < cosine_.size(); ++k) {
    const double next = ck * c - sk * s;
    sk = sk * c + ck * s;
    ck = next;
    u += ck * cosine_[k] + sk * sine_[k];
  }
  return u;
}

double geodesic_distance_m(const Ellipsoid& ellipsoid, const Geodetic& a, const Geodetic& b) {
  double distance = 0;
  geodesic(ellipsoid).Inverse(a.lat_deg, a.lon_deg, b.lat_deg, b.lon_deg, distance);
  return distance;
}

dvec3 geodesic_end(const Ellipsoid& ellipsoid, const Geodetic& from, double azimuth_deg, double distance_m) {
  double lat = 0, lon = 0;
  geodesic(ellipsoid).Direct(from.lat_deg, from.lon_deg, azimuth_deg, distance_m, lat, lon);
  return normal_from_degrees(lat, lon);
}

double injectivity_radius_m(const Ellipsoid& ellipsoid) {
  const double a = ellipsoid.a, b = ellipsoid.b();
  // pi / sqrt(greatest curvature), 1/b² at the equator if oblate, (b/a²)² at the poles if prolate; half the
  // shortest closed geodesic, a meridian or the equator, is longer.
  return std::numbers::pi * (b <= a ? b : a * (a / b));
}

}  // namespace globe::geo
