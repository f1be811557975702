#pragma once

#include <cstdint>
#include <vector>

namespace converters {

/// A smooth height over the sphere that is known everywhere: the sum of all real spherical harmonics of
/// degree 1 to `degree`, with amplitudes at random that fall as 1 / (degree + 1), as those of planets' relief
/// do. The same seed gives the same heights on every machine but for rounding.
class Harmonics {
 public:
  /// @param rms_m  root of the mean square of the heights over the sphere, metres
  Harmonics(int degree, std::uint64_t seed, double rms_m);

  /// Heights along a parallel: at longitudes west_deg, west_deg + step_deg, ...
  void row(double lat_deg, double west_deg, double step_deg, int count, float* out) const;

  double at(double lat_deg, double lon_deg) const;

 private:
  int degree_;
  std::vector<double> cosines_;  ///< fully normalised, by order, then degree, as GeographicLib has them
  std::vector<double> sines_;
};

}  // namespace converters
