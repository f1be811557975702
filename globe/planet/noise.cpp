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
  for (std::size_t k = 0; k < 8; ++k) cell.hash[k] = finish(hx[k & 1] ^ hy[(k >> 1) & 1] ^ hz[k >> 2]);
  return cell;
}

float fade(float t) { return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f); }
float fade_slope(float t) { return 30.0f * t * t * (t * (t - 2.0f) + 1.0f); }

/// Ten bits of a hash as [-1, 1].
float component(std::uint32_t hash, int shift) {
  return static_cast<float>((hash >> shift) & 1023u) * (2.0f / 1023.0f) - 1.0f;
}

}  // namespace

std::uint32_t lattice_hash(std::uint32_t seed, int x, int y, int z) {
  return finish(seed ^ scaled(x, kX) ^ scaled(y, kY) ^ scaled(z, kZ));
}

NoiseSample gradient_noise(std::uint32_t seed, const dvec3& p) {
  const Cell cell = cell_of(seed, p);
  const vec3 f = cell.f;
  const vec3 w{fade(f.x), fade(f.y), fade(f.z)};
  const vec3 dw{fade_slope(f.x), fade_slope(f.y), fade_slope(f.z)};
  float value = 0.0f;
  vec3 gradient{0.0f};
  for (std::size_t k = 0; k < 8; ++k) {
    const bool px = (k & 1) != 0, py = (k & 2) != 0, pz = (k & 4) != 0;
    const std::uint32_t h = cell.hash[k];
    const vec3 g{component(h, 2), component(h, 12), component(h, 22)};
    const float dot =
        g.x * (px ? f.x - 1.0f : f.x) + g.y * (py ? f.y - 1.0f : f.y) + g.z * (pz ? f.z - 1.0f : f.z);
    const float wx = px ? w.x : 1.0f - w.x, wy = py ? w.y : 1.0f - w.y, wz = pz ? w.z : 1.0f - w.z;
    const float weight = wx * wy * wz;
    value += weight * dot;
    gradient.x += weight * g.x + (px ? dw.x : -dw.x) * wy * wz * dot;
    gradient.y += weight * g.y + (py ? dw.y : -dw.y) * wx * wz * dot;
    gradient.z += weight * g.z + (pz ? dw.z : -dw.z) * wx * wy * dot;
  }
  constexpr float kScale = 1.5f;
  return {value * kScale, gradient * kScale};
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

float sine_of_turns(float turns) {
  const float x = turns - std::floor(turns + 0.5f);
  const float y = 8.0f * x - 16.0f * x * std::abs(x);
  return y + 0.225f * (y * std::abs(y) - y);
}

Stripes stripe_noise(std::uint32_t seed, const dvec3& p, const vec3& across, float waves) {
  const Cell cell = cell_of(seed, p);
  const vec3 f = cell.f;
  const vec3 w{fade(f.x), fade(f.y), fade(f.z)};
  Stripes sum{0.0f, 0.0f};
  for (std::size_t k = 0; k < 8; ++k) {
    const bool px = (k & 1) != 0, py = (k & 2) != 0, pz = (k & 4) != 0;
    const vec3 r{px ? f.x - 1.0f : f.x, py ? f.y - 1.0f : f.y, pz ? f.z - 1.0f : f.z};
    const float weight = (px ? w.x : 1.0f - w.x) * (py ? w.y : 1.0f - w.y) * (pz ? w.z : 1.0f - w.z);
    const float turns = waves * glm::dot(r, across) + unit_from_hash(cell.hash[k]);
    sum.cosine += weight * sine_of_turns(turns + 0.25f);
    sum.sine += weight * sine_of_turns(turns);
  }
  // Where cells cancel each other stripes would fade; raise them, but leave true dislocations smooth.
  const float length = std::sqrt(sum.cosine * sum.cosine + sum.sine * sum.sine + 0.04f);
  return {sum.cosine / length, sum.sine / length};
}

}  // namespace globe::planet
