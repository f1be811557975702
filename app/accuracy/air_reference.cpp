#include "app/accuracy/air_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/mat2x3.hpp>
#include <numbers>

namespace app::accuracy {
namespace {

using glm::dvec3;

const dvec3 kRayleigh{5.802e-3, 13.558e-3, 33.1e-3};  ///< scattering per km
constexpr double kMieScattering = 3.0e-3, kMieExtinction = 3.4e-3;
constexpr double kRayleighHeight = 8.0, kMieHeight = 1.2;  ///< km
constexpr double kMieAsymmetry = 0.76;
constexpr double kSkyHeight = 12.0;
constexpr double kRepeated = 0.2;

/// Five-point Gauss-Legendre quadrature (Abramowitz and Stegun 1964, table 25.4).
constexpr std::array kNodes{0.0, 0.5384693101056831, 0.9061798459386640};
constexpr std::array kWeights{0.5688888888888889, 0.4786286704993665, 0.2369268850561891};

/// Integral from a to b, in so many panels.
template <class Value, class Function>
Value integral(double a, double b, int panels, const Function& f) {
  Value sum(0.0);
  const double half = 0.5 * (b - a) / panels;
  for (int p = 0; p < panels; ++p) {
    const double middle = a + (2 * p + 1) * half;
    sum += kWeights[0] * f(middle);
    for (std::size_t k = 1; k < kNodes.size(); ++k)
      sum += kWeights[k] * (f(middle - half * kNodes[k]) + f(middle + half * kNodes[k]));
  }
  return half * sum;
}

/// Schüler's formula, as atmosphere.glsl has it.
double approximate_column(double h, double cos_zenith, double ground, double scale_height) {
  const auto upward = [](double x, double c_zenith) {
    const double c = std::sqrt(0.5 * std::numbers::pi * x);
    return c / ((c - 1.0) * c_zenith + 1.0);
  };
  const double r = (ground + h) / scale_height;
  const double density = std::exp(-h / scale_height);
  if (cos_zenith >= 0.0) return scale_height * density * upward(r, cos_zenith);
  const double sin_zenith = std::sqrt(std::max(1.0 - cos_zenith * cos_zenith, 0.0));
  const double lowest = (ground + h) * sin_zenith - ground;
  const double through =
      2.0 * std::exp(std::min(-lowest / scale_height, 30.0)) * upward(std::max(r * sin_zenith, 1.0), 0.0);
  return scale_height * (through - density * upward(r, -cos_zenith));
}

/// Along the ray from its point nearest to the centre, t = ± x²: samples crowd where the air is densest.
double integrated_column(double h, double cos_zenith, double ground, double scale_height) {
  const double radius = ground + h;
  const double nearest = radius * std::sqrt(std::max(1.0 - cos_zenith * cos_zenith, 0.0));
  const double begin = radius * cos_zenith;
  const double outer = ground + std::max(h, 0.0) + 40.0 * scale_height;
  const double end = std::sqrt(std::max(outer * outer - nearest * nearest, 0.0));
  const auto stretch = [&](double to) {  // from the nearest point outward
    return integral<double>(0.0, std::sqrt(to), 24, [&](double x) {
      const double t = x * x;
      const double height = std::sqrt(nearest * nearest + t * t) - ground;
      return 2.0 * x * std::exp(std::min(-height / scale_height, 30.0));
    });
  };
  if (begin < 0.0) return stretch(-begin) + stretch(end);
  // Upward: from the point itself, or the difference of two large numbers would be all that is left.
  return integral<double>(0.0, std::sqrt(std::max(end - begin, 0.0)), 24, [&](double x) {
    const double t = begin + x * x;
    const double height = std::sqrt(nearest * nearest + t * t) - ground;
    return 2.0 * x * std::exp(-height / scale_height);
  });
}

dvec3 extinction(double rayleigh, double mie) {
  return glm::exp(-(kRayleigh * rayleigh + dvec3(kMieExtinction * mie)));
}

dvec3 sky_irradiance(double h, double cos_sun) {
  const double t = std::clamp((cos_sun + 0.16) / 0.51, 0.0, 1.0);
  return dvec3(0.11, 0.145, 0.20) * (t * t * (3.0 - 2.0 * t) * std::exp(-std::max(h, 0.0) / kSkyHeight));
}

double rayleigh_phase(double c) { return 3.0 / (16.0 * std::numbers::pi) * (1.0 + c * c); }

double mie_phase(double c) {
  const double g2 = kMieAsymmetry * kMieAsymmetry;
  const double base = 1.0 + g2 - 2.0 * kMieAsymmetry * c;
  return 3.0 / (8.0 * std::numbers::pi) * (1.0 - g2) * (1.0 + c * c) / ((2.0 + g2) * base * std::sqrt(base));
}

}  // namespace

double air_column(Columns columns, double height_km, double cos_zenith, double ground_km,
                  double scale_height_km) {
  return columns == Columns::kApproximate
             ? approximate_column(height_km, cos_zenith, ground_km, scale_height_km)
             : integrated_column(height_km, cos_zenith, ground_km, scale_height_km);
}

dvec3 SkyParts::tinted_sum() const {
  const double share = std::min(mie.x / std::max(light.x, 1e-7), 12.0);
  return light + light * (kRayleigh.x / kRayleigh) * (share * phase);
}

SkyParts sky_parts(Columns columns, const ReferenceRay& ray) {
  const double cos_angle = glm::dot(ray.direction, ray.sun);
  const double phase_r = rayleigh_phase(cos_angle);
  const double lowest = std::clamp(-glm::dot(ray.eye, ray.direction), ray.from, ray.to);
  const auto height_at = [&](double t) {
    return std::max(glm::length(ray.eye + ray.direction * t) - ray.ground, 0.0);
  };
  double column_r = 0.0, column_m = 0.0;
  SkyParts parts{dvec3(0.0), dvec3(0.0), mie_phase(cos_angle)};
  // Panels narrow enough that the air passed so far is as good as linear in one, one side of the lowest point
  // after the other.
  constexpr int kPanels = 400;
  const auto along = [&](double x) {
    return x < 0.0 ? lowest - (lowest - ray.from) * x * x : lowest + (ray.to - lowest) * x * x;
  };
  double before = ray.from;
  for (int p = 0; p < 2 * kPanels; ++p) {
    const double after = along(static_cast<double>(p + 1 - kPanels) / kPanels);
    if (!(after > before)) continue;
    const double panel_from = before;
    const auto passed = [&](double scale_height, double to) {
      return integral<double>(panel_from, to, 1,
                              [&](double t) { return std::exp(-height_at(t) / scale_height); });
    };
    const auto scattered = integral<glm::dmat2x3>(before, after, 1, [&](double t) {
      const dvec3 place = ray.eye + ray.direction * t;
      const double radius = glm::length(place);
      const double h = std::max(radius - ray.ground, 0.0);
      const double cos_sun = glm::dot(place, ray.sun) / radius;
      const dvec3 here = extinction(column_r + passed(kRayleighHeight, t), column_m + passed(kMieHeight, t));
      const dvec3 lit = here * extinction(air_column(columns, h, cos_sun, ray.ground, kRayleighHeight),
                                          air_column(columns, h, cos_sun, ray.ground, kMieHeight));
      const dvec3 again = here * sky_irradiance(h, cos_sun) * kRepeated;
      const dvec3 rayleigh = kRayleigh * std::exp(-h / kRayleighHeight);
      const double mie = kMieScattering * std::exp(-h / kMieHeight);
      return glm::dmat2x3(lit * rayleigh * phase_r + again * (rayleigh + dvec3(mie)), lit * mie);
    });
    parts.light += scattered[0];
    parts.mie += scattered[1];
    column_r += passed(kRayleighHeight, after);
    column_m += passed(kMieHeight, after);
    before = after;
  }
  return parts;
}

}  // namespace app::accuracy
