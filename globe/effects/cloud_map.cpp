#include "globe/effects/cloud_map.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <numbers>

#include "globe/base/angles.h"
#include "globe/geo/ellipsoid.h"
#include "globe/planet/noise.h"

namespace globe::effects {
namespace {

using glm::dvec3;

constexpr double kGradientRange = 128.0;  ///< as in shaders/effects/clouds.glsl, as the next
constexpr double kDetailRange = 24.0;

std::size_t index_of(int side, int face, int column, int row) {
  return (static_cast<std::size_t>(face) * static_cast<std::size_t>(side) + static_cast<std::size_t>(row)) *
             static_cast<std::size_t>(side) +
         static_cast<std::size_t>(column);
}

struct CubePlace {
  int face;
  double column, row;
};

CubePlace cube_place(const dvec3& d, int side) {
  const dvec3 size = glm::abs(d);
  const int k = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const double scale = 0.5 * (side - 1);
  return {2 * k + (d[k] < 0.0 ? 1 : 0), (d[(k + 1) % 3] / size[k] + 1.0) * scale,
          (d[(k + 2) % 3] / size[k] + 1.0) * scale};
}

/// A turn of the ground's pattern about a place, as whirls wind clouds up.
struct Whirl {
  dvec3 middle;
  double turn;        ///< radians, in the middle
  double narrowness;  ///< of exp(-narrowness (1 - cos of the distance))
  double nearest;     ///< cosine of the distance from which it is nothing
};

std::vector<Whirl> whirls_of(std::uint32_t seed) {
  constexpr int kWhirls = 44;
  std::vector<Whirl> whirls;
  for (int k = 0; k < kWhirls; ++k) {
    const auto random = [&](int j) {
      return static_cast<double>(planet::unit_from_hash(planet::lattice_hash(seed, k, j, 77)));
    };
    const bool tropical = k % 5 == 4;
    const double side = random(0) < 0.5 ? -1.0 : 1.0;
    const double latitude = side * (tropical ? 9.0 + 14.0 * random(1) : 34.0 + 32.0 * random(1));
    const double radius = kDegree * (tropical ? 2.5 + 2.0 * random(2) : 5.0 + 6.0 * random(2));
    const double narrowness = 2.0 / (radius * radius);
    // Low pressure turns against the sun in the north; a pattern is wound the other way to trail behind.
    const double turn = -side * (tropical ? 5.5 : 2.6 + 2.2 * random(3));
    whirls.push_back(
        {geo::normal_from_degrees(latitude, 360.0 * random(4)), turn, narrowness, 1.0 - 7.0 / narrowness});
  }
  return whirls;
}

dvec3 wound_up(const std::vector<Whirl>& whirls, dvec3 d) {
  for (const Whirl& whirl : whirls) {
    const double near = glm::dot(d, whirl.middle);
    if (near < whirl.nearest) continue;
    const double angle = whirl.turn * (std::exp(whirl.narrowness * (near - 1.0)) - std::exp(-7.0));
    const double c = std::cos(angle), s = std::sin(angle);
    d = d * c + glm::cross(whirl.middle, d) * s + whirl.middle * (near * (1.0 - c));
  }
  return d;
}

/// What the latitude adds.
double belt(double sine) {
  const double latitude = std::asin(std::clamp(sine, -1.0, 1.0)) / kDegree;
  const auto hump = [&](double middle, double width) {
    const double x = (std::abs(latitude) - middle) / width;
    return std::exp(-x * x);
  };
  return 0.20 * hump(4.0, 7.0) - 0.24 * hump(23.0, 10.0) + 0.20 * hump(54.0, 15.0);
}

/// Replaces values by the share of the sphere that lies below them.
void spread_evenly(CloudCover& cover) {
  constexpr std::size_t kBins = 4096;
  constexpr float kLeast = -2.5f, kMost = 2.5f;
  const auto bin_of = [](float value) {
    const float x = (value - kLeast) / (kMost - kLeast) * static_cast<float>(kBins);
    return std::clamp(x, 0.0f, static_cast<float>(kBins) - 0.001f);
  };
  std::vector<double> share(kBins + 1, 0.0);
  for (int face = 0; face < 6; ++face) {
    for (int row = 0; row < cover.side; ++row) {
      for (int column = 0; column < cover.side; ++column) {
        const dvec3 d = cube_direction(face, column, row, cover.side);
        const double area = 1.0 / (glm::dot(d, d) * std::sqrt(glm::dot(d, d)));
        share[static_cast<std::size_t>(bin_of(cover.at(face, column, row))) + 1] += area;
      }
    }
  }
  for (std::size_t k = 1; k <= kBins; ++k) share[k] += share[k - 1];
  for (float& value : cover.values) {
    const float bin = bin_of(value);
    const auto k = static_cast<std::size_t>(bin);
    const double inside = static_cast<double>(bin) - static_cast<double>(k);
    value = static_cast<float>((share[k] + (share[k + 1] - share[k]) * inside) / share[kBins]);
  }
}

template <class Work>
void for_each_row(int side, const Work& work) {
  oneapi::tbb::parallel_for(0, 6 * side, [&](int k) { work(k / side, k % side); });
}

std::uint8_t byte_of(double unit) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(unit, 0.0, 1.0) * 255.0));
}

/// A cover's value and its gradient in space, by radians.
glm::vec4 with_gradient(const CloudCover& cover, int face, int column, int row) {
  const int side = cover.side, axis = face / 2;
  const auto value = [&](int c, int r) {
    if (c >= 0 && r >= 0 && c < side && r < side) return static_cast<double>(cover.at(face, c, r));
    return static_cast<double>(cover.at(cube_direction(face, c, r, side)));
  };
  const double per_texel = 0.25 * (side - 1);  // two texels apart, in units of half a face
  const double by_column = (value(column + 1, row) - value(column - 1, row)) * per_texel;
  const double by_row = (value(column, row + 1) - value(column, row - 1)) * per_texel;
  const dvec3 d = cube_direction(face, column, row, side);
  dvec3 a(0.0), b(0.0), n(0.0);
  n[axis] = d[axis];
  a[(axis + 1) % 3] = b[(axis + 2) % 3] = 1.0;
  const double length = std::sqrt(glm::dot(d, d));
  const dvec3 gradient =
      ((a - n * d[(axis + 1) % 3]) * by_column + (b - n * d[(axis + 2) % 3]) * by_row) * length;
  return {cover.at(face, column, row), glm::vec3(gradient)};
}

void write_texel(const glm::vec4& value, std::uint8_t* texel) {
  texel[0] = byte_of(static_cast<double>(value.x));
  for (int c = 1; c < 4; ++c) texel[c] = byte_of(0.5 + 0.5 * static_cast<double>(value[c]) / kGradientRange);
}

/// Half the texels: each the tent-weighted mean of nine directions around it.
CloudCover halved(const CloudCover& cover) {
  CloudCover half{cover.side / 2, {}};
  half.values.resize(cover.values.size() / 4);
  const double ratio = static_cast<double>(cover.side - 1) / (half.side - 1);
  for_each_row(half.side, [&](int face, int row) {
    for (int column = 0; column < half.side; ++column) {
      double sum = 0.0;
      for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
          const dvec3 d = cube_direction(face, column * ratio + i, row * ratio + j, cover.side);
          sum += (i == 0 ? 0.5 : 0.25) * (j == 0 ? 0.5 : 0.25) * static_cast<double>(cover.at(d));
        }
      }
      half.at(face, column, row) = static_cast<float>(sum);
    }
  });
  return half;
}

/// Gradient noise in the plane that repeats after `period` cells; about [-1, 1].
double repeating_noise(std::uint32_t seed, double x, double y, int period) {
  const double left = std::floor(x), low = std::floor(y);
  const double fx = x - left, fy = y - low;
  const auto fade = [](double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); };
  const auto corner = [&](int i, int j) {
    const int cx = (static_cast<int>(left) + i) % period, cy = (static_cast<int>(low) + j) % period;
    const double angle = 2.0 * std::numbers::pi *
                         static_cast<double>(planet::unit_from_hash(planet::lattice_hash(seed, cx, cy, 0)));
    return std::cos(angle) * (fx - i) + std::sin(angle) * (fy - j);
  };
  const double u = fade(fx), v = fade(fy);
  const double lower = corner(0, 0) * (1.0 - u) + corner(1, 0) * u;
  const double upper = corner(0, 1) * (1.0 - u) + corner(1, 1) * u;
  return 1.5 * (lower * (1.0 - v) + upper * v);
}

}  // namespace

float& CloudCover::at(int face, int column, int row) { return values[index_of(side, face, column, row)]; }
float CloudCover::at(int face, int column, int row) const {
  return values[index_of(side, face, column, row)];
}

float CloudCover::at(const dvec3& direction) const {
  const CubePlace place = cube_place(direction, side);
  const int column = std::clamp(static_cast<int>(place.column), 0, side - 2);
  const int row = std::clamp(static_cast<int>(place.row), 0, side - 2);
  const auto x = static_cast<float>(place.column - column), y = static_cast<float>(place.row - row);
  const float low = at(place.face, column, row) * (1.0f - x) + at(place.face, column + 1, row) * x;
  const float high = at(place.face, column, row + 1) * (1.0f - x) + at(place.face, column + 1, row + 1) * x;
  return low * (1.0f - y) + high * y;
}

dvec3 cube_direction(int face, double column, double row, int side) {
  const int axis = face / 2;
  dvec3 d;
  d[axis] = face % 2 == 0 ? 1.0 : -1.0;
  d[(axis + 1) % 3] = 2.0 * column / (side - 1) - 1.0;
  d[(axis + 2) % 3] = 2.0 * row / (side - 1) - 1.0;
  return d;
}

CloudCover made_up_cover(std::uint32_t seed, int side) {
  using planet::kLanes;
  CloudCover cover{side,
                   std::vector<float>(6 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side))};
  const std::vector<Whirl> whirls = whirls_of(seed);
  for_each_row(side, [&](int face, int row) {
    for (int first = 0; first < side; first += static_cast<int>(kLanes)) {
      planet::LanePlaces places{}, streaked{};
      std::array<double, kLanes> belts{};
      for (std::size_t k = 0; k < kLanes; ++k) {
        const int column = std::min(first + static_cast<int>(k), side - 1);
        const dvec3 d = glm::normalize(cube_direction(face, column, row, side));
        belts[k] = belt(d.z);
        places.set(k, wound_up(whirls, d));
      }
      const planet::LaneFloats x = planet::fractal_noise(seed + 1, places, 3.0, 4, 0.5f);
      const planet::LaneFloats y = planet::fractal_noise(seed + 2, places, 3.0, 4, 0.5f);
      const planet::LaneFloats z = planet::fractal_noise(seed + 3, places, 3.0, 4, 0.5f);
      planet::LanePlaces plain{};
      for (std::size_t k = 0; k < kLanes; ++k) {
        // Winds blow along the parallels more than across.
        const dvec3 warp(static_cast<double>(x[k]), static_cast<double>(y[k]),
                         0.5 * static_cast<double>(z[k]));
        const dvec3 p = places.get(k) + 0.16 * warp;
        streaked.set(k, dvec3(p.x, p.y, 1.9 * p.z));
        const int column = std::min(first + static_cast<int>(k), side - 1);
        plain.set(k, glm::normalize(cube_direction(face, column, row, side)) + 0.05 * warp);
      }
      const planet::LaneFloats broad = planet::fractal_noise(seed + 4, streaked, 2.2, 9, 0.58f);
      const planet::LaneFloats ridges = planet::ridged_noise(seed + 5, streaked, 6.0, 7, 0.66f);
      const planet::LaneFloats broken = planet::fractal_noise(seed + 6, plain, 14.0, 7, 0.68f);
      for (std::size_t k = 0; k < kLanes && first + static_cast<int>(k) < side; ++k)
        cover.at(face, first + static_cast<int>(k), row) =
            broad[k] + 0.5f * (ridges[k] - 0.5f) + 0.42f * broken[k] + static_cast<float>(1.25 * belts[k]);
    }
  });
  spread_evenly(cover);
  return cover;
}

CloudCover cover_of(const LatLongImage& image, int side) {
  CloudCover cover{side,
                   std::vector<float>(6 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side))};
  for_each_row(side, [&](int face, int row) {
    for (int column = 0; column < side; ++column) {
      const geo::Geodetic place = geo::degrees_from_normal(cube_direction(face, column, row, side));
      const std::array<float, 3> rgb = image.at(place.lat_deg, place.lon_deg);
      cover.at(face, column, row) = (rgb[0] + rgb[1] + rgb[2]) / (3.0f * 255.0f);
    }
  });
  return cover;
}

std::vector<std::vector<std::uint8_t>> cloud_texels(const CloudCover& cover) {
  std::vector<std::vector<std::uint8_t>> levels;
  CloudCover level = cover;
  for (;;) {
    std::vector<std::uint8_t>& texels = levels.emplace_back(level.values.size() * 4);
    for_each_row(level.side, [&](int face, int row) {
      for (int column = 0; column < level.side; ++column)
        write_texel(with_gradient(level, face, column, row),
                    texels.data() + 4 * index_of(level.side, face, column, row));
    });
    if (level.side == 2) return levels;
    level = halved(level);
  }
}

double cover_at(const std::vector<std::uint8_t>& texels, int side, const glm::dvec3& direction) {
  const CubePlace place = cube_place(direction, side);
  const auto value = [&](int column, int row) {
    return texels[4 * index_of(side, place.face, column, row)] / 255.0;
  };
  const int column = std::clamp(static_cast<int>(place.column), 0, side - 2);
  const int row = std::clamp(static_cast<int>(place.row), 0, side - 2);
  const double x = place.column - column, y = place.row - row;
  const double low = value(column, row) * (1.0 - x) + value(column + 1, row) * x;
  const double high = value(column, row + 1) * (1.0 - x) + value(column + 1, row + 1) * x;
  return low * (1.0 - y) + high * y;
}

std::vector<std::uint8_t> cloud_detail(std::uint32_t seed, int side) {
  constexpr int kOctaves = 6, kCells = 9;
  CloudCover square{side,
                    std::vector<float>(static_cast<std::size_t>(side) * static_cast<std::size_t>(side))};
  oneapi::tbb::parallel_for(0, side, [&](int row) {
    for (int column = 0; column < side; ++column) {
      double sum = 0.0, weight = 1.0;
      for (int octave = 0, cells = kCells; octave < kOctaves; ++octave, cells *= 2, weight *= 0.55) {
        const double scale = static_cast<double>(cells) / side;
        const double noise =
            repeating_noise(seed + static_cast<std::uint32_t>(octave), column * scale, row * scale, cells);
        // Heaps: round tops with creases between them, but for the broadest.
        sum += weight * (octave == 0 ? noise : 0.75 - 2.2 * std::abs(noise));
      }
      square.at(0, column, row) = static_cast<float>(0.5 * sum);
    }
  });
  double mean = 0.0;
  for (const float value : square.values) mean += static_cast<double>(value);
  mean /= static_cast<double>(square.values.size());
  std::vector<std::uint8_t> texels(square.values.size() * 4, 255);
  const auto value = [&](int column, int row) {
    return static_cast<double>(square.at(0, (column + side) % side, (row + side) % side)) - mean;
  };
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      std::uint8_t* texel = texels.data() + 4 * index_of(side, 0, column, row);
      const double slope_scale = 0.5 * side / kDetailRange * 0.5;
      texel[0] = byte_of(0.5 + 0.5 * value(column, row));
      texel[1] = byte_of(0.5 + slope_scale * (value(column + 1, row) - value(column - 1, row)));
      texel[2] = byte_of(0.5 + slope_scale * (value(column, row + 1) - value(column, row - 1)));
    }
  }
  return texels;
}

}  // namespace globe::effects
