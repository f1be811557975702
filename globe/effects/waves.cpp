#include "globe/effects/waves.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "globe/geo/ellipsoid.h"

namespace globe::effects {
namespace {

constexpr double kGravity = 9.81;  ///< of the Earth, which alone has a sea
using std::numbers::pi;
constexpr int kBands = 36;
constexpr double kShortest = 0.1;  ///< metres
constexpr double kLongest = 0.72;  ///< of the peak's frequency: what is longer has 1 % of the energy
constexpr double kSteepestCotangent = 20.0;  ///< three degrees from a source its waves are not round any more

/// Numbers in [0, 1) that fill it evenly whatever their count.
double spread(int k, double step) { return std::fmod(0.5 + k * step, 1.0); }

}  // namespace

double angular_frequency(double wavelength_m) { return std::sqrt(kGravity * 2.0 * pi / wavelength_m); }

double deep_water_length(double per_second) {
  const double omega = 2.0 * pi * per_second;
  return 2.0 * pi * kGravity / (omega * omega);
}

double slope_variance(double wind_speed) { return 0.003 + 0.00512 * wind_speed; }

double slope_variance(const std::vector<Wave>& waves) {
  double sum = 0.0;
  for (const Wave& wave : waves) {
    const double steepness = wave.amplitude_m * 2.0 * pi / wave.wavelength_m;
    sum += 0.5 * steepness * steepness;
  }
  return sum;
}

std::vector<Wave> wind_waves(double wind_speed, double from_deg) {
  std::vector<Wave> waves;
  if (wind_speed <= 0.0) return waves;
  const double last = angular_frequency(kShortest);
  const double peak = 0.877 * kGravity / wind_speed;
  const double first = kLongest * peak;
  if (first >= 0.9 * last) return waves;
  const double step = std::log(last / first) / kBands;
  for (int k = 0; k < kBands; ++k) {
    // Within its band a wave stands anywhere, so that no two frequencies have a simple ratio.
    const double omega = first * std::exp(step * (k + spread(k, 0.7548776662)));
    const double width = first * std::exp(step * k) * (std::exp(step) - 1.0);
    const double density =
        8.1e-3 * kGravity * kGravity * std::pow(omega, -5.0) * std::exp(-1.25 * std::pow(peak / omega, 4.0));
    // The angle at which the integral of cos^2 has come so far.
    const double share = 2.0 * spread(k, 0.6180339887) - 1.0;
    double angle = share * 0.5 * pi;
    for (int n = 0; n < 8; ++n)
      angle -=
          (2.0 * angle + std::sin(2.0 * angle) - share * pi) / (2.0 + 2.0 * std::cos(2.0 * angle) + 1e-9);
    const double k_wave = omega * omega / kGravity;
    waves.push_back({std::sqrt(2.0 * density * width), 2.0 * pi / k_wave, 2.0 * pi * spread(k, 0.5698402910),
                     from_deg + angle * 180.0 / pi});
  }
  return waves;
}

Sea::Sea(const geo::Ellipsoid& ellipsoid, const geo::Geodetic& reference, std::vector<Wave> waves)
    : radius_m_(ellipsoid.mean_radius()),
      rounding_(radius_m_ / ellipsoid.a, radius_m_ / ellipsoid.a, radius_m_ / ellipsoid.b()),
      waves_(std::move(waves)) {
  std::stable_sort(waves_.begin(), waves_.end(),
                   [](const Wave& a, const Wave& b) { return a.wavelength_m > b.wavelength_m; });
  const geo::LocalFrame frame = geo::local_frame(reference.lat_deg, reference.lon_deg);
  const glm::dvec3 at = foot(geo::ecef_from_geodetic(ellipsoid, {reference.lat_deg, reference.lon_deg, 0.0}));
  for (const Wave& wave : waves_) {
    const glm::dvec3 bearing = rounding_ * geo::look_direction(frame, wave.from_deg, 0.0);
    sources_.push_back(glm::normalize(bearing - at * glm::dot(at, bearing)));
  }
}

double Sea::amplitudes_m() const {
  double sum = 0.0;
  for (const Wave& wave : waves_) sum += wave.amplitude_m;
  return sum;
}

Sea::Local Sea::at(std::size_t wave, const glm::dvec3& foot, double time_s) const {
  const glm::dvec3& source = sources_[wave];
  const double cosine = glm::dot(source, foot);
  const double sine = glm::length(glm::cross(source, foot));
  // From the reference place on, a quarter of the globe from the source.
  const double angle = std::atan2(sine, cosine) - 0.5 * pi;
  const double number = 2.0 * pi / waves_[wave].wavelength_m;
  const double phase = number * radius_m_ * angle - angular_frequency(waves_[wave].wavelength_m) * time_s;
  glm::dvec3 along = foot * cosine - source;
  if (sine < 1e-9)
    along = glm::cross(foot, std::abs(foot.z) < 0.7 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0));
  return {glm::normalize(along),
          std::remainder(std::remainder(phase, 2.0 * pi) + waves_[wave].phase, 2.0 * pi),
          std::clamp(cosine / std::max(sine, 1e-9), -kSteepestCotangent, kSteepestCotangent)};
}

double Sea::height_m(const glm::dvec3& foot, double time_s) const {
  double sum = 0.0;
  for (std::size_t k = 0; k < waves_.size(); ++k)
    sum += waves_[k].amplitude_m * std::cos(at(k, foot, time_s).phase);
  return sum;
}

glm::dvec3 Sea::foot(const glm::dvec3& ecef) const { return glm::normalize(ecef * rounding_); }

}  // namespace globe::effects
