#include "globe/planet/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace globe::planet {
namespace {

constexpr std::uint32_t kX = 0x8da6b343u;
constexpr std::uint32_t kY = 0xd8163841u;
constexpr std::uint32_t kZ = 0xcb1ab31fu;

/// Hughes' "lowbias32" finaliser.
std::uint32_t finish(std::uint32_t h) {
  h ^= h >> 16;
  h *= 0x7feb352du;
  h ^= h >> 15;
  h *= 0x846ca68bu;
  return h ^ (h >> 16);
}

std::uint32_t scaled(int v, std::uint32_t factor) { return static_cast<std::uint32_t>(v) * factor; }

/// The lattice cell that holds a point: hashes of its eight corners (x fastest) and the place inside.
struct Cell {
  std::array<std::uint32_t, 8> hash;
  vec3 f;
};

Cell cell_of(std::uint32_t seed, const dvec3& p) {
  const double x = std::floor(p.x), y = std::floor(p.y), z = std::floor(p.z);
  const int ix = static_cast<int>(x), iy = static_cast<int>(y), iz = static_cast<int>(z);
  const std::array<std::uint32_t, 2> hx{seed ^ scaled(ix, kX), seed ^ scaled(ix + 1, kX)};
  const std::array<std::uint32_t, 2> hy{scaled(iy, kY), scaled(iy + 1, kY)};
  const std::array<std::uint32_t, 2> hz{scaled(iz, kZ), scaled(iz + 1, kZ)};
  Cell cell{{}, {static_cast<float>(p.x - x), static_cast<float>(p.y - y), static_cast<float>(p.z - z)}};
  for (std::size_t k = 0; k < 8; ++k) cell.hash[k] = hx[k & 1] ^ hy[(k >> 1) & 1] ^ hz[k >> 2];
  for (std::size_t k = 0; k < 8; ++k) cell.hash[k] = finish(cell.hash[k]);
  return cell;
}

float fade(float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); }
float fade_slope(float t) { return 30.0f * t * t * (t * (t - 2.0f) + 1.0f); }

/// Ten bits of a hash as [-1, 1].
float component(std::uint32_t hash, int shift) {
  return static_cast<float>(static_cast<int>((hash >> shift) & 1023u)) * (2.0f / 1023.0f) - 1.0f;
}

using Eight = std::array<float, 8>;

/// Of the eight corners: the place seen from each, and its weight. Loops over
/// eight lanes are what compilers turn into vector code.
struct Corners {
  Eight x, y, z, weight;
};

Corners corners_of(const vec3& f, const vec3& w) {
  Corners c;
  for (std::size_t k = 0; k < 8; ++k) {
    const bool px = (k & 1) != 0, py = (k & 2) != 0, pz = (k & 4) != 0;
    c.x[k] = px ? f.x - 1.0f : f.x;
    c.y[k] = py ? f.y - 1.0f : f.y;
    c.z[k] = pz ? f.z - 1.0f : f.z;
    c.weight[k] = (px ? w.x : 1.0f - w.x) * (py ? w.y : 1.0f - w.y) * (pz ? w.z : 1.0f - w.z);
  }
  return c;
}

/// Sum in a fixed order.
float sum_of(const Eight& v) { return ((v[0] + v[4]) + (v[2] + v[6])) + ((v[1] + v[5]) + (v[3] + v[7])); }

}  // namespace

std::uint32_t lattice_hash(std::uint32_t seed, int x, int y, int z) {
  return finish(seed ^ scaled(x, kX) ^ scaled(y, kY) ^ scaled(z, kZ));
}

NoiseSample gradient_noise(std::uint32_t seed, const dvec3& p) {
  const Cell cell = cell_of(seed, p);
  const vec3 f = cell.f;
  const vec3 w{fade(f.x), fade(f.y), fade(f.z)};
  const vec3 dw{fade_slope(f.x), fade_slope(f.y), fade_slope(f.z)};
  const Corners c = corners_of(f, w);
  Eight gx, gy, gz, value, sx, sy, sz;
  for (std::size_t k = 0; k < 8; ++k) {
    gx[k] = component(cell.hash[k], 2);
    gy[k] = component(cell.hash[k], 12);
    gz[k] = component(cell.hash[k], 22);
  }
  for (std::size_t k = 0; k < 8; ++k) {
    const bool px = (k & 1) != 0, py = (k & 2) != 0, pz = (k & 4) != 0;
    const float dot = gx[k] * c.x[k] + gy[k] * c.y[k] + gz[k] * c.z[k];
    const float wx = px ? w.x : 1.0f - w.x, wy = py ? w.y : 1.0f - w.y, wz = pz ? w.z : 1.0f - w.z;
    value[k] = c.weight[k] * dot;
    sx[k] = c.weight[k] * gx[k] + (px ? dw.x : -dw.x) * wy * wz * dot;
    sy[k] = c.weight[k] * gy[k] + (py ? dw.y : -dw.y) * wx * wz * dot;
    sz[k] = c.weight[k] * gz[k] + (pz ? dw.z : -dw.z) * wx * wy * dot;
  }
  constexpr float kScale = 1.5f;
  return {sum_of(value) * kScale, vec3(sum_of(sx), sum_of(sy), sum_of(sz)) * kScale};
}

float fractal_noise(std::uint32_t seed, const dvec3& p, int octaves, float gain) {
  float sum = 0.0f;
  float amplitude = 1.0f;
  double frequency = 1.0;
  for (int k = 0; k < octaves; ++k) {
    sum += amplitude * gradient_noise(seed + static_cast<std::uint32_t>(k), p * frequency).value;
    amplitude *= gain;
    frequency *= 2.0;
  }
  return sum;
}

float ridged_noise(std::uint32_t seed, const dvec3& p, int octaves, float gain) {
  float sum = 0.0f;
  float norm = 0.0f;
  float amplitude = 1.0f;
  float weight = 1.0f;
  double frequency = 1.0;
  for (int k = 0; k < octaves; ++k) {
    const float v = gradient_noise(seed + static_cast<std::uint32_t>(k), p * frequency).value;
    const float crest = std::max(0.0f, 1.0f - 1.3f * std::abs(v));
    const float signal = crest * crest * weight;
    sum += amplitude * signal;
    norm += amplitude;
    weight = std::min(1.0f, 0.25f + 1.5f * signal);
    amplitude *= gain;
    frequency *= 2.03;
  }
  return sum / norm;
}

Stripes stripe_noise(std::uint32_t seed, const dvec3& p, const vec3& across, float waves, float shift) {
  const Cell cell = cell_of(seed, p);
  const vec3 f = cell.f;
  const vec3 w{fade(f.x), fade(f.y), fade(f.z)};
  const Corners c = corners_of(f, w);
  const vec3 along = waves * across;
  Eight cosine, sine;
  for (std::size_t k = 0; k < 8; ++k) {
    const auto phase = static_cast<float>(static_cast<int>(cell.hash[k] >> 8)) * 0x1p-24f;
    const float turns = c.x[k] * along.x + c.y[k] * along.y + c.z[k] * along.z + (phase + shift);
    cosine[k] = c.weight[k] * sine_of_turns(turns + 0.25f);
    sine[k] = c.weight[k] * sine_of_turns(turns);
  }
  const Stripes sum{sum_of(cosine), sum_of(sine)};
  // Where cells cancel each other stripes would fade; raise them, but leave true dislocations smooth.
  const float length = std::sqrt(sum.cosine * sum.cosine + sum.sine * sum.sine + 0.04f);
  return {sum.cosine / length, sum.sine / length};
}

}  // namespace globe::planet
