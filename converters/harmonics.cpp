#include "converters/harmonics.h"

#include <GeographicLib/CircularEngine.hpp>
#include <GeographicLib/SphericalHarmonic.hpp>
#include <cmath>
#include <random>

#include "globe/base/angles.h"

namespace converters {
namespace {

using globe::kDegree;

using GeographicLib::SphericalHarmonic;

SphericalHarmonic engine(const std::vector<double>& cosines, const std::vector<double>& sines, int degree) {
  return {cosines, sines, degree, 1.0, SphericalHarmonic::FULL};
}

}  // namespace

Harmonics::Harmonics(int degree, std::uint64_t seed, double rms_m) : degree_(degree) {
  std::mt19937_64 random(seed);
  const auto amplitude = [&] { return std::ldexp(static_cast<double>(random() >> 11), -52) - 1.0; };
  double power = 0;
  for (int order = 0; order <= degree; ++order) {
    for (int n = order; n <= degree; ++n) {
      const double scale = n == 0 ? 0.0 : 1.0 / (n + 1);
      cosines_.push_back(scale * amplitude());
      power += cosines_.back() * cosines_.back();
      if (order == 0) continue;
      sines_.push_back(scale * amplitude());
      power += sines_.back() * sines_.back();
    }
  }
  for (std::vector<double>* all : {&cosines_, &sines_}) {
    for (double& value : *all) value *= rms_m / std::sqrt(power);
  }
}

void Harmonics::row(double lat_deg, double west_deg, double step_deg, int count, float* out) const {
  const GeographicLib::CircularEngine parallel =
      engine(cosines_, sines_, degree_)
          .Circle(std::cos(lat_deg * kDegree), std::sin(lat_deg * kDegree), false);
  for (int k = 0; k < count; ++k) out[k] = static_cast<float>(parallel(west_deg + k * step_deg));
}

double Harmonics::at(double lat_deg, double lon_deg) const {
  const double r = std::cos(lat_deg * kDegree);
  return engine(cosines_, sines_, degree_)(r * std::cos(lon_deg * kDegree), r * std::sin(lon_deg * kDegree),
                                           std::sin(lat_deg * kDegree));
}

}  // namespace converters
