#include "globe/planet/noise.h"

namespace globe::planet {
namespace {

GLOBE_FOR_EVERY_VECTOR_WIDTH void add_octave(std::uint32_t seed, const LanePlaces& p, double frequency,
                                             float amplitude, LaneFloats& __restrict sum) {
  for (std::size_t k = 0; k < kLanes; ++k) {
    const dvec3 at{p.x[k] * frequency, p.y[k] * frequency, p.z[k] * frequency};
    sum[k] += amplitude * gradient_noise(seed, at).value;
  }
}

GLOBE_FOR_EVERY_VECTOR_WIDTH void add_ridges(std::uint32_t seed, const LanePlaces& p, double frequency,
                                             float amplitude, LaneFloats& __restrict weight,
                                             LaneFloats& __restrict sum) {
  for (std::size_t k = 0; k < kLanes; ++k) {
    const dvec3 at{p.x[k] * frequency, p.y[k] * frequency, p.z[k] * frequency};
    const float crest = greater(0.0f, 1.0f - 1.3f * std::abs(gradient_noise(seed, at).value));
    const float signal = crest * crest * weight[k];
    sum[k] += amplitude * signal;
    weight[k] = lesser(1.0f, 0.25f + 1.5f * signal);
  }
}

}  // namespace

LaneFloats fractal_noise(std::uint32_t seed, const LanePlaces& p, double scale, int octaves, float gain) {
  LaneFloats sum{};
  float amplitude = 1.0f;
  for (int k = 0; k < octaves; ++k, amplitude *= gain, scale *= 2.0)
    add_octave(seed + static_cast<std::uint32_t>(k), p, scale, amplitude, sum);
  return sum;
}

LaneFloats ridged_noise(std::uint32_t seed, const LanePlaces& p, double scale, int octaves, float gain) {
  LaneFloats sum{};
  LaneFloats weight;
  weight.fill(1.0f);
  float norm = 0.0f;
  float amplitude = 1.0f;
  for (int k = 0; k < octaves; ++k, amplitude *= gain, scale *= 2.03) {
    add_ridges(seed + static_cast<std::uint32_t>(k), p, scale, amplitude, weight, sum);
    norm += amplitude;
  }
  for (float& value : sum) value /= norm;
  return sum;
}

}  // namespace globe::planet
