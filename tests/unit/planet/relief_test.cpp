#include "globe/planet/relief.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "globe/planet/valleys.h"

namespace globe::planet {
namespace {

ReliefScale scale_of(bool craters) { return {0x1234u, 6.371e6, 19.5e3, 75.0, craters}; }

class Places {
 public:
  explicit Places(std::uint32_t seed) : random_(seed) {}

  ReliefPlaces next() {
    ReliefPlaces places;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const dvec3 u = glm::normalize(dvec3(pick(-1.0, 1.0), pick(-1.0, 1.0), pick(-1.0, 1.0)));
      const dvec3 slope = glm::cross(u, dvec3(pick(-0.3, 0.3), pick(-0.3, 0.3), pick(-0.3, 0.3)));
      const bool still = random_() % 16 == 0;
      places.set(k, u, still ? 0.0f : static_cast<float>(pick(0.0, 1.0)),
                 random_() % 8 == 0 ? vec3(0.0f) : vec3(slope));
    }
    return places;
  }

 private:
  double pick(double from, double to) { return std::uniform_real_distribution<double>(from, to)(random_); }

  std::mt19937 random_;
};

/// The same octaves place by place, compiled for the narrowest processor.
Relief reference(const ReliefScale& scale, const ReliefPlaces& places, std::size_t k) {
  const dvec3 u = places.u.get(k);
  const float rough = places.roughness[k];
  const vec3 base{places.base_x[k], places.base_y[k], places.base_z[k]};
  Relief r{0.0f, vec3(0.0f), 0.0f};
  if (rough <= 0.0f) return r;
  float weight = 1.0f;
  for (std::uint32_t octave = 0; octave < 2; ++octave) {
    const double wave = std::ldexp(scale.data_edge_m, 1 - static_cast<int>(octave));
    raise_massif(scale.seed + octave, scale.radius_m / wave, static_cast<float>(wave), u, rough, r, weight);
  }
  ValleyState state{1.0f, kValleyWinding * r.prominence};
  std::uint32_t seed = scale.seed + 0x40;
  for (double wave = 0.5 * scale.data_edge_m; wave >= scale.finest_wave_m; wave *= 0.5, ++seed)
    carve_valley(seed, scale.radius_m / wave, static_cast<float>(wave), evenness(wave), u, rough, base, r,
                 state);
  return r;
}

TEST(Relief, IsTheSameBitsForEveryWidthOfVector) {
  const ReliefScale scale = scale_of(false);
  Places places(1);
  double highest = 0.0;
  for (int round = 0; round < 200; ++round) {
    const ReliefPlaces at = places.next();
    const ReliefLanes lanes = carved_relief(scale, at);
    for (std::size_t k = 0; k < kLanes; ++k) {
      const Relief one = reference(scale, at, k);
      ASSERT_EQ(lanes.height_m[k], one.height_m);
      ASSERT_EQ(lanes.prominence[k], one.prominence);
      ASSERT_EQ(vec3(lanes.slope_x[k], lanes.slope_y[k], lanes.slope_z[k]), one.slope);
      highest = std::max(highest, static_cast<double>(one.height_m));
    }
  }
  EXPECT_GT(highest, 500.0);
}

TEST(Relief, OfAPlaceDoesNotDependOnItsCompany) {
  for (const bool craters : {false, true}) {
    const ReliefScale scale = scale_of(craters);
    Places places(2);
    for (int round = 0; round < 40; ++round) {
      const ReliefPlaces at = places.next();
      const ReliefLanes together = carved_relief(scale, at);
      for (std::size_t k = 0; k < kLanes; ++k) {
        ReliefPlaces alone;
        for (std::size_t lane = 0; lane < kLanes; ++lane)
          alone.set(lane, at.u.get(k), at.roughness[k], {at.base_x[k], at.base_y[k], at.base_z[k]});
        const ReliefLanes r = carved_relief(scale, alone);
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
          ASSERT_EQ(r.height_m[lane], together.height_m[k]);
          ASSERT_EQ(r.slope_x[lane], together.slope_x[k]);
          ASSERT_EQ(r.prominence[lane], together.prominence[k]);
        }
      }
    }
  }
}

TEST(Noise, IsTheSameBitsForEveryWidthOfVector) {
  Places places(3);
  for (int round = 0; round < 200; ++round) {
    const LanePlaces u = places.next().u;
    const LaneFloats lanes = fractal_noise(7u, u, 12.0, 3, 0.5f);
    for (std::size_t k = 0; k < kLanes; ++k) {
      float sum = 0.0f;
      for (int octave = 0; octave < 3; ++octave) {
        const dvec3 p = u.get(k) * std::ldexp(12.0, octave);
        sum += std::ldexp(1.0f, -octave) * gradient_noise(7u + static_cast<std::uint32_t>(octave), p).value;
      }
      ASSERT_EQ(lanes[k], sum);
    }
  }
}

TEST(Noise, GradientIsThatOfItsValue) {
  constexpr double kStep = 1e-3;
  constexpr float kError = 5e-3f;  // second order in the step, and fp32's rounding over it
  Places places(4);
  for (int round = 0; round < 20; ++round) {
    const LanePlaces u = places.next().u;
    for (std::size_t k = 0; k < kLanes; ++k) {
      const dvec3 p = u.get(k) * 40.0;
      const NoiseSample at = gradient_noise(1u, p);
      const auto rise = [&](const dvec3& step) {
        return (gradient_noise(1u, p + step).value - gradient_noise(1u, p - step).value) /
               static_cast<float>(2.0 * kStep);
      };
      ASSERT_NEAR(at.gradient.x, rise({kStep, 0.0, 0.0}), kError);
      ASSERT_NEAR(at.gradient.y, rise({0.0, kStep, 0.0}), kError);
      ASSERT_NEAR(at.gradient.z, rise({0.0, 0.0, kStep}), kError);
    }
  }
}

}  // namespace
}  // namespace globe::planet
