#include "globe/effects/atmosphere_tables.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace globe::effects {
namespace {

using namespace glm;

/// Of the share of dust's light that Joseph, Wiscombe and Weinman let go straight on: at dusk the glow is so
/// narrow that with all of it the sky beside the sun is 10 % too light, with none the sky opposite 15 %.
constexpr double kStraightOn = 0.5;
constexpr float kPi = std::numbers::pi_v<float>;

vec4 bilinear(const std::vector<vec4>& texels, const ivec2& size, const vec2& place) {
  const vec2 at = clamp(place, 0.0f, 1.0f) * vec2(size - 1);
  const ivec2 corner = min(ivec2(at), size - 2);
  const vec2 t = at - vec2(corner);
  const auto* row = &texels[static_cast<std::size_t>(corner.y * size.x + corner.x)];
  const vec4 below = row[0] + (row[1] - row[0]) * t.x;
  const auto* next = row + size.x;
  const vec4 above = next[0] + (next[1] - next[0]) * t.x;
  return below + (above - below) * t.y;
}

/// The shader's code with what it looks up.
#define OUT(type) type&
struct Scattering {
  AirBlock air;
  const AirTables* tables;

  vec3 transmittance_texel(const vec2& place) const {
    return vec3(bilinear(tables->transmittance, tables->transmittance_size, place));
  }
  vec4 moments_texel(const vec2& place, int layer) const {
    return bilinear(tables->moments[static_cast<std::size_t>(layer)], tables->moments_size, place);
  }

#include "shaders/lib/scattering.glsl"
};
#undef OUT

namespace map {
#include "shaders/effects/atmosphere_map.glsl"

vec2 bounds(const AirModel& model, float eye_radius) {
  return sky_bounds(eye_radius, static_cast<float>(model.ground_km),
                    static_cast<float>(model.ground_km + model.thickness_km));
}
}  // namespace map

/// Moments of the light around a place and what lies on level ground there, in the axes of
/// shaders/lib/scattering.glsl.
struct Moments {
  vec3 sum{0}, zenith{0}, azimuth{0}, mixed{0}, upward{0}, onward{0}, irradiance{0};

  void add(const vec3& light, float cos_zenith, float cos_azimuth) {
    sum += light;
    zenith += light * (cos_zenith * cos_zenith);
    azimuth += light * (cos_azimuth * cos_azimuth);
    mixed += light * (cos_zenith * cos_azimuth);
    upward += light * cos_zenith;
    onward += light * cos_azimuth;
    irradiance += light * std::max(cos_zenith, 0.0f);
  }
};
constexpr std::size_t kParts = 7;

const vec3& part(const Moments& m, std::size_t k) {
  switch (k) {
    case 0:
      return m.sum;
    case 1:
      return m.zenith;
    case 2:
      return m.azimuth;
    case 3:
      return m.mixed;
    case 4:
      return m.upward;
    case 5:
      return m.irradiance;
    default:
      return m.onward;
  }
}

double column(const AirModel& model, double h, double cos_zenith,
              const std::function<double(double)>& density) {
  const double r = model.ground_km + h, top = model.ground_km + model.thickness_km;
  const double away =
      -r * cos_zenith + std::sqrt(std::max(top * top - r * r * (1.0 - cos_zenith * cos_zenith), 0.0));
  constexpr int kSteps = 400;
  double sum = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double x = (k + 0.5) / kSteps, t = away * x * x;  // crowded at the low end
    const double height = std::sqrt(r * r + t * t + 2.0 * r * t * cos_zenith) - model.ground_km;
    sum += density(std::max(height, 0.0)) * 2.0 * x;
  }
  return sum * away / kSteps;
}

/// Values in between by their logarithms, in which dusk is smooth; all of a row or column being positive.
float refined(float a, float b, float t) {
  return a > 1e-12f && b > 1e-12f ? std::exp(std::log(a) + (std::log(b) - std::log(a)) * t) : a + (b - a) * t;
}

class Precomputation {
 public:
  Precomputation(const AirModel& model, const AirTableSizes& sizes) : model_(model), sizes_(sizes) {
    code_.air = air_block(model);
    code_.tables = &tables_;
    tables_.transmittance_size = sizes.transmittance;
    tables_.moments_size = sizes.upload;
  }

  AirTables run() {
    fill_transmittance();
    std::vector<Moments> total = gathered(true);
    std::vector<Moments> order = total;
    for (int k = 2; k < sizes_.orders; ++k) {
      upload(order);
      order = gathered(false);
      for (std::size_t i = 0; i < total.size(); ++i) {
        total[i].sum += order[i].sum;
        total[i].zenith += order[i].zenith;
        total[i].azimuth += order[i].azimuth;
        total[i].mixed += order[i].mixed;
        total[i].upward += order[i].upward;
        total[i].onward += order[i].onward;
        total[i].irradiance += order[i].irradiance;
      }
    }
    upload(total);
    if (sizes_.orders == 1) {  // once by the air: what it scatters to the ground, but not again
      for (std::size_t p = 0; p < 5; ++p) tables_.moments[p].assign(tables_.moments[p].size(), vec4(0.0f));
    }
    return std::move(tables_);
  }

 private:
  float height_of(int row, int rows) const {
    const float x = static_cast<float>(row) / static_cast<float>(rows - 1);
    return static_cast<float>(model_.thickness_km) * x * x;
  }
  /// Inverse of moments_place().
  float sun_of(int column, int columns) const {
    const float least = code_.air.bounds.w, width = 1.7f * std::abs(least);
    const float u = static_cast<float>(column) / static_cast<float>(columns - 1);
    const float y = u * (1.0f - least) / (1.0f - least + width);
    return least + width * y / (1.0f - y);
  }

  void fill_transmittance() {
    const ivec2 size = sizes_.transmittance;
    tables_.transmittance.resize(static_cast<std::size_t>(size.x * size.y));
    const double ground = model_.ground_km, top = model_.thickness_km;
    const double across = std::sqrt(top * (2.0 * ground + top));
    tbb::parallel_for(0, size.y, [&](int row) {
      const double level = across * row / (size.y - 1);
      const double r = std::sqrt(level * level + ground * ground), h = level * level / (r + ground);
      for (int k = 0; k < size.x; ++k) {
        const double away = top - h + (level + across - top + h) * k / (size.x - 1);
        const double cos_zenith =
            away > 0 ? std::clamp(((top - h) * (2.0 * ground + top + h) - away * away) / (2.0 * r * away),
                                  -1.0, 1.0)
                     : 1.0;
        const double molecules =
            column(model_, h, cos_zenith, [&](double z) { return std::exp(-z / model_.rayleigh_height_km); });
        const double dust =
            column(model_, h, cos_zenith, [&](double z) { return std::exp(-z / model_.mie_height_km); });
        const double ozone = column(model_, h, cos_zenith, [&](double z) {
          return std::max(1.0 - std::abs(z - model_.ozone_height_km) / model_.ozone_half_width_km, 0.0);
        });
        tables_.transmittance[static_cast<std::size_t>(row * size.x + k)] =
            vec4(code_.left_of_light(vec3(molecules, dust, ozone)), 0.0f);
      }
    });
  }

  std::vector<Moments> gathered(bool first) const {
    const ivec2 size = sizes_.moments;
    std::vector<Moments> result(static_cast<std::size_t>(size.x * size.y));
    tbb::parallel_for(0, size.x * size.y, [&](int k) {
      result[static_cast<std::size_t>(k)] =
          gather(height_of(k / size.x, size.y), sun_of(k % size.x, size.x), first);
    });
    return result;
  }

  /// Light of the air and the ground around a place, scattered once or once more.
  Moments gather(float h, float cos_sun, bool first) const {
    Moments moments;
    const vec3 sun(std::sqrt(std::max(1.0f - cos_sun * cos_sun, 0.0f)), 0.0f, cos_sun);
    const vec3 eye(0.0f, 0.0f, static_cast<float>(model_.ground_km) + std::max(h, 1e-3f));
    const float horizon = code_.horizon_cosine(std::max(h, 1e-3f));
    const int zeniths = first ? 2 * sizes_.zeniths : sizes_.zeniths,
              azimuths = first ? 2 * sizes_.azimuths : sizes_.azimuths;
    for (int side = 0; side < 2; ++side) {
      const float range = side == 0 ? 1.0f - horizon : horizon + 1.0f;
      for (int i = 0; i < zeniths; ++i) {
        // Crowded by the horizon, where the air is thick.
        const int in_panel = i % 4, panel = i / 4, panels = zeniths / 4;
        const float y =
            (static_cast<float>(panel) + code_.gauss_place(in_panel)) / static_cast<float>(panels);
        const float cosine = side == 0 ? horizon + range * y * y : horizon - range * y * y;
        const float solid = 2.0f * y * range * code_.gauss_weight(in_panel) / static_cast<float>(panels);
        const float sine = std::sqrt(std::max(1.0f - cosine * cosine, 0.0f));
        for (int j = 0; j < azimuths; ++j) {
          const float angle = kPi * (static_cast<float>(j) + 0.5f) / static_cast<float>(azimuths);
          const vec3 direction(sine * std::cos(angle), sine * std::sin(angle), cosine);
          const vec3 light = along(eye, direction, side == 1, sun, first);
          moments.add(light * (solid * 2.0f * kPi / static_cast<float>(azimuths)), cosine, direction.x);
        }
      }
    }
    return moments;
  }

  vec3 along(const vec3& eye, const vec3& direction, bool down, const vec3& sun, bool first) const {
    const float ground = static_cast<float>(model_.ground_km), top = static_cast<float>(model_.thickness_km);
    const float slope = dot(eye, direction), h = eye.z - ground;
    const float to =
        down ? -slope - std::sqrt(std::max(slope * slope - h * (2.0f * ground + h), 0.0f))
             : -slope + std::sqrt(std::max(slope * slope + (top - h) * (2.0f * ground + top + h), 0.0f));
    const float cos_angle = dot(direction, sun);
    const float phase_r = code_.rayleigh_phase(cos_angle), phase_m = code_.mie_phase(cos_angle);
    const float lowest = std::clamp(-slope, 0.0f, to);
    vec3 light(0.0f), columns(0.0f);
    float before = 0.0f, h_before = h;
    vec3 density_before = code_.densities(h);
    const int panels = sizes_.panels;
    for (int panel = 0; panel < panels; ++panel) {
      for (int k = 0; k < 4; ++k) {
        const vec2 at = code_.spread_distance(
            (static_cast<float>(panel) + code_.gauss_place(k)) / static_cast<float>(panels), 0.0f, lowest, to,
            slope + lowest);
        const vec3 p = eye + direction * at.x;
        const float r = length(p), height = std::max(r - ground, 0.0f);
        const float cos_sun = dot(p, sun) / r;
        const vec3 density = code_.densities(height);
        columns += code_.columns_between(density_before, h_before, density, height, at.x - before);
        vec3 sent;
        if (first) {
          sent = code_.sunlight_at(height, cos_sun) * code_.scattered_once(density, phase_r, phase_m);
        } else {
          const auto again = code_.scattered_again(height, dot(p, direction) / r, cos_sun, cos_angle);
          sent = again.by_molecules * density.x + again.by_dust * density.y;
        }
        light +=
            code_.left_of_ray(columns) * sent * (at.y * code_.gauss_weight(k) / static_cast<float>(panels));
        before = at.x;
        h_before = height;
        density_before = density;
      }
    }
    if (!down) return light;
    columns += code_.columns_between(density_before, h_before, code_.densities(0.0f), 0.0f, to - before);
    const vec3 p = eye + direction * to;
    const float cos_sun = dot(p, sun) / length(p);
    const vec3 lit =
        first ? code_.sunlight_at(0.0f, cos_sun) * std::max(cos_sun, 0.0f) : code_.skylight_at(0.0f, cos_sun);
    return light + code_.left_of_ray(columns) * lit * (static_cast<float>(model_.albedo) / kPi);
  }

  /// Makes the finer table of what was gathered.
  void upload(const std::vector<Moments>& gathered) {
    const ivec2 from = sizes_.moments, to = sizes_.upload;
    for (auto& layer : tables_.moments) layer.assign(static_cast<std::size_t>(to.x * to.y), vec4(0.0f));
    tbb::parallel_for(0, to.y, [&](int row) {
      const float y = static_cast<float>(row) * static_cast<float>(from.y - 1) / static_cast<float>(to.y - 1);
      const int j = std::min(static_cast<int>(y), from.y - 2);
      for (int k = 0; k < to.x; ++k) {
        const float x = static_cast<float>(k) * static_cast<float>(from.x - 1) / static_cast<float>(to.x - 1);
        const int i = std::min(static_cast<int>(x), from.x - 2);
        const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
        const auto* corner = &gathered[static_cast<std::size_t>(j * from.x + i)];
        const std::array<const Moments*, 4> around{corner, corner + 1, corner + from.x, corner + from.x + 1};
        std::array<vec3, kParts> values{};
        for (int channel = 0; channel < 3; ++channel) {
          const auto sum_at = [&](std::size_t c) { return around[c]->sum[channel]; };
          const float sum = refined(refined(sum_at(0), sum_at(1), u), refined(sum_at(2), sum_at(3), u), v);
          values[0][channel] = sum;
          for (std::size_t p = 1; p < kParts; ++p) {  // the others by their share of the sum
            const auto share = [&](std::size_t c) {
              return part(*around[c], p)[channel] / std::max(sum_at(c), 1e-20f);
            };
            const float below = share(0) + (share(1) - share(0)) * u,
                        above = share(2) + (share(3) - share(2)) * u;
            values[p][channel] = sum * (below + (above - below) * v);
          }
        }
        const auto at = static_cast<std::size_t>(row * to.x + k);
        for (std::size_t p = 0; p < 6; ++p)
          tables_.moments[p][at] = vec4(values[p], p < 3 ? values[6][static_cast<int>(p)] : 0.0f);
      }
    });
  }

  AirModel model_;
  AirTableSizes sizes_;
  AirTables tables_;
  mutable Scattering code_;
};

}  // namespace

AirBlock air_block(const AirModel& model) {
  AirBlock block{};
  block.rayleigh = vec4(vec3(model.rayleigh), static_cast<float>(1.0 / model.rayleigh_height_km));
  block.mie = vec4(model.mie_scattering * model.turbidity, model.mie_extinction * model.turbidity,
                   1.0 / model.mie_height_km, model.mie_asymmetry);
  block.ozone = vec4(vec3(model.ozone), static_cast<float>(1.0 / model.ozone_half_width_km));
  // Where the sun stands when the last of the air above a place leaves it, and some more for light scattered
  // twice.
  const double q = model.ground_km / (model.ground_km + model.thickness_km);
  block.bounds =
      vec4(model.ground_km, model.thickness_km, model.ozone_height_km, -1.3 * std::sqrt(1.0 - q * q));
  Scattering code;
  code.air = block;
  double p1 = 0, p2 = 0;
  constexpr int kSteps = 2000;
  for (int k = 0; k < kSteps; ++k) {
    const double c = -1.0 + 2.0 * (k + 0.5) / kSteps;
    const double share = code.mie_phase(static_cast<float>(c)) * 4.0 * std::numbers::pi / kSteps;
    p1 += share * c;
    p2 += share * (1.5 * c * c - 0.5);
  }
  // (1 + sqrt(3) c)^2 is the most forward square of a linear function: means 1 / sqrt(3) and 1/5.
  const double most = 1.0 / std::numbers::sqrt3;
  const double straight = kStraightOn * std::max((p1 - most) / (1.0 - most), 0.0);
  if (straight > 0.0) {
    p1 = most;
    p2 = 0.2;
  }
  block.mie_moments = vec4(3.0 * p1 * 0.25 / std::numbers::pi, 5.0 * p2 * 0.25 / std::numbers::pi,
                           block.mie.y - block.mie.x * straight, block.mie.x * (1.0 - straight));
  return block;
}

AirTables air_tables(const AirModel& model, const AirTableSizes& sizes) {
  return Precomputation(model, sizes).run();
}

glm::vec3 air_radiance(const AirModel& model, const AirTables& tables, const ScatteredRay& ray, int panels,
                       bool sparing) {
  Scattering code;
  code.air = air_block(model);
  code.tables = &tables;
  vec3 left;
  return code.air_radiance(ray.eye, ray.direction, ray.from, ray.to, ray.sun, panels, sparing, left);
}

glm::vec2 air_map_place(const AirModel& model, const glm::vec2& cosines, float eye_radius_km) {
  return {map::sky_column(cosines.x), map::sky_row(cosines.y, map::bounds(model, eye_radius_km))};
}

glm::vec2 air_map_cosines(const AirModel& model, const glm::vec2& place, float eye_radius_km) {
  return {map::cos_azimuth_of_column(place.x),
          map::cos_zenith_of_row(place.y, map::bounds(model, eye_radius_km))};
}

}  // namespace globe::effects
