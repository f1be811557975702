#include "app/accuracy/scattering_reference.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <vector>

namespace app::accuracy {
namespace {

using glm::dvec3;
using Model = globe::effects::AirModel;

constexpr double kPi = std::numbers::pi;

/// Five-point Gauss-Legendre quadrature (Abramowitz and Stegun 1964, table 25.4), on [-1, 1].
constexpr std::array kGaussNodes{-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                 0.9061798459386640};
constexpr std::array kGaussWeights{0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                   0.4786286704993665, 0.2369268850561891};

double strongest(const dvec3& v) { return std::max({v.x, v.y, v.z}); }
double mean(const dvec3& v) { return (v.x + v.y + v.z) / 3.0; }

struct Air {
  dvec3 scattered_by_molecules, extinct;
  double scattered_by_dust;
};

Air air_at(const Model& model, double h) {
  const dvec3 molecules = model.rayleigh * std::exp(-h / model.rayleigh_height_km);
  const double dust = model.turbidity * std::exp(-h / model.mie_height_km);
  const double ozone = std::max(1.0 - std::abs(h - model.ozone_height_km) / model.ozone_half_width_km, 0.0);
  return {molecules, molecules + dvec3(model.mie_extinction * dust) + model.ozone * ozone,
          model.mie_scattering * dust};
}

double molecule_phase(double c) { return 3.0 / (16.0 * kPi) * (1.0 + c * c); }

double dust_phase(const Model& model, double c) {
  const double g = model.mie_asymmetry, base = 1.0 + g * g - 2.0 * g * c;
  return 3.0 / (8.0 * kPi) * (1.0 - g * g) * (1.0 + c * c) / ((2.0 + g * g) * base * std::sqrt(base));
}

double henyey_greenstein(const Model& model, double c) {
  const double g = model.mie_asymmetry, base = 1.0 + g * g - 2.0 * g * c;
  return (1.0 - g * g) / (4.0 * kPi * base * std::sqrt(base));
}

double height(const Model& model, const dvec3& p) { return std::max(glm::length(p) - model.ground_km, 0.0); }

/// What of the sun's light reaches a place.
dvec3 sunlight(const Model& model, const dvec3& p, const dvec3& sun) {
  const double along = glm::dot(p, sun), top = model.ground_km + model.thickness_km;
  const double square = glm::dot(p, p) - along * along;  // of the distance from the axis
  if (along < 0.0 && square < model.ground_km * model.ground_km) return dvec3(0.0);
  const double to = -along + std::sqrt(std::max(top * top - square, 0.0));
  const double lowest = std::clamp(-along, 0.0, to);
  dvec3 depth(0.0);
  const auto stretch = [&](double length, double side) {  // crowded at the lowest point
    constexpr int kPanels = 6;
    if (length <= 0.0) return;
    for (int panel = 0; panel < kPanels; ++panel) {
      for (std::size_t k = 0; k < kGaussNodes.size(); ++k) {
        const double x = (panel + 0.5 + 0.5 * kGaussNodes[k]) / kPanels;
        const dvec3 at = p + sun * (lowest + side * length * x * x);
        depth +=
            air_at(model, height(model, at)).extinct * (length * 2.0 * x * kGaussWeights[k] * 0.5 / kPanels);
      }
    }
  };
  stretch(lowest, -1.0);
  stretch(to - lowest, 1.0);
  return glm::exp(-depth);
}

dvec3 turned(const Model& model, const Air& air, double cos_angle) {
  return air.scattered_by_molecules * molecule_phase(cos_angle) +
         dvec3(air.scattered_by_dust * dust_phase(model, cos_angle));
}

/// A ray cut into pieces that crowd where it is lowest, with what of the light is left at each piece's begin.
class Way {
 public:
  Way(const Model& model, const dvec3& eye, const dvec3& direction, double from, double to, int pieces)
      : model_(model), eye_(eye), direction_(direction) {
    const double lowest = std::clamp(-glm::dot(eye, direction), from, to);
    const double begin = lowest > from ? -1.0 : 0.0, end = to > lowest ? 1.0 : 0.0;
    const auto distance = [&](double x) {
      return x < 0 ? lowest - (lowest - from) * x * x : lowest + (to - lowest) * x * x;
    };
    dvec3 depth(0.0), extinct_before = air_at(model, height(model, at(from))).extinct;
    double before = from, sum = 0;
    pieces_.reserve(static_cast<std::size_t>(pieces));
    for (int k = 0; k < pieces; ++k) {
      const double after = distance(begin + (end - begin) * (k + 1) / pieces), length = after - before;
      const Air air = air_at(model, height(model, at(0.5 * (before + after))));
      const dvec3 extinct_after = air_at(model, height(model, at(after))).extinct;
      const dvec3 scattered = air.scattered_by_molecules + dvec3(air.scattered_by_dust);
      sum += mean(glm::exp(-(depth + 0.5 * length * air.extinct)) * scattered) * length;
      pieces_.push_back({before, length, sum, depth});
      depth += (extinct_before + 4.0 * air.extinct + extinct_after) * (length / 6.0);  // Simpson's rule
      before = after;
      extinct_before = extinct_after;
    }
    // Of all pieces a share alike, or those high up would never be met in twilight.
    left_ = glm::exp(-depth);
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      pieces_[k].sum = (1.0 - kEven) * pieces_[k].sum / sum + kEven * static_cast<double>(k + 1) / pieces;
  }

  dvec3 at(double t) const { return eye_ + direction_ * t; }
  /// Of light at the far end.
  const dvec3& left() const { return left_; }

  /// A place on the ray for a number in [0, 1), and the light left from there divided by the density of such
  /// places.
  struct Place {
    dvec3 p, left;
  };
  Place place(double u) const {
    const auto it = std::lower_bound(pieces_.begin(), pieces_.end() - 1, u,
                                     [](const Piece& piece, double value) { return piece.sum <= value; });
    const double before = it == pieces_.begin() ? 0.0 : (it - 1)->sum;
    const double share = it->sum - before, x = std::clamp((u - before) / share, 0.0, 1.0);
    const dvec3 depth = it->depth + air_depth(it->from, it->length * x);
    return {at(it->from + it->length * x), glm::exp(-depth) * (it->length / share)};
  }

 private:
  static constexpr double kEven = 0.3;
  struct Piece {
    double from, length, sum;
    dvec3 depth;
  };

  /// Simpson's rule.
  dvec3 air_depth(double from, double length) const {
    const auto extinct = [&](double t) { return air_at(model_, height(model_, at(t))).extinct; };
    return (extinct(from) + 4.0 * extinct(from + 0.5 * length) + extinct(from + length)) * (length / 6.0);
  }

  const Model& model_;
  dvec3 eye_, direction_, left_{0.0};
  std::vector<Piece> pieces_;
};

/// A direction at an angle to another.
dvec3 turned_by(const dvec3& axis, double cosine, double azimuth) {
  const dvec3 aside = glm::normalize(std::abs(axis.z) < 0.9 ? glm::cross(axis, dvec3(0, 0, 1))
                                                            : glm::cross(axis, dvec3(1, 0, 0)));
  const dvec3 ahead = glm::cross(aside, axis);
  const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
  return axis * cosine + (aside * std::cos(azimuth) + ahead * std::sin(azimuth)) * sine;
}

class Paths {
 public:
  Paths(const Model& model, const dvec3& sun, std::uint64_t seed) : model_(model), sun_(sun), random_(seed) {}

  /// Light that comes to a place of the first ray having been scattered elsewhere.
  dvec3 from(dvec3 p, dvec3 direction, dvec3 weight) {
    dvec3 light(0.0);
    for (int order = 2; order < 200; ++order) {
      if (!turn(p, direction, weight)) break;
      const ScatteringRay ray = scattering_ray(model_, p, direction, sun_);
      const Way way(model_, p, direction, 0.0, ray.to, 32);
      const bool down = glm::length(way.at(ray.to)) < model_.ground_km + 1e-3;
      const double to_ground = down ? strongest(way.left()) * model_.albedo : 0.0;
      const double chance = to_ground / (to_ground + 1.0 - mean(way.left()));
      if (down && unit() < chance) {
        p = way.at(ray.to);
        const dvec3 normal = glm::normalize(p);
        p = normal * (model_.ground_km + 1e-6);
        weight *= way.left() * (model_.albedo / chance);
        light += weight * sunlight(model_, p, sun_) * (std::max(glm::dot(normal, sun_), 0.0) / kPi);
        on_ground_ = true;
      } else {
        const Way::Place place = way.place(unit());
        p = place.p;
        weight *= place.left / (down ? 1.0 - chance : 1.0);
        light += weight * sunlight(model_, p, sun_) *
                 turned(model_, air_at(model_, height(model_, p)), glm::dot(direction, sun_));
        on_ground_ = false;
      }
      if (order > 3) {  // Russian roulette, against what a path of this kind carries
        const double live =
            std::min(0.8, strongest(weight) * (on_ground_ ? 1.0 : strongest(scattered(p))) / scale_);
        if (unit() >= live) break;
        weight /= live;
      } else if (order == 2) {
        scale_ = std::max(strongest(weight) * (on_ground_ ? 1.0 : strongest(scattered(p))), 1e-300);
      }
    }
    on_ground_ = false;
    return light;
  }

  double unit() { return std::generate_canonical<double, 53>(random_); }

 private:
  dvec3 scattered(const dvec3& p) const {
    const Air air = air_at(model_, height(model_, p));
    return air.scattered_by_molecules + dvec3(air.scattered_by_dust);
  }

  /// Chooses where the light at p comes from, `weight` taking the scattering there.
  bool turn(const dvec3& p, dvec3& direction, dvec3& weight) {
    if (on_ground_) {
      direction = turned_by(glm::normalize(p), std::sqrt(unit()), 2.0 * kPi * unit());
      return true;
    }
    const Air air = air_at(model_, height(model_, p));
    const double molecules = mean(air.scattered_by_molecules);
    const double share = 0.25 + 0.75 * molecules / (molecules + air.scattered_by_dust);
    const double g = model_.mie_asymmetry;
    double c;
    if (unit() < share) {
      c = 2.0 * unit() - 1.0;
    } else {
      const double s = (1.0 - g * g) / (1.0 - g + 2.0 * g * unit());
      c = std::clamp((1.0 + g * g - s * s) / (2.0 * g), -1.0, 1.0);
    }
    const double density = share / (4.0 * kPi) + (1.0 - share) * henyey_greenstein(model_, c);
    weight *= turned(model_, air, c) / density;
    direction = turned_by(direction, c, 2.0 * kPi * unit());
    return strongest(weight) > 0.0;
  }

  const Model& model_;
  dvec3 sun_;
  std::mt19937_64 random_;
  bool on_ground_ = false;
  double scale_ = 1.0;
};

dvec3 scattered_once(const Model& model, const ScatteringRay& ray) {
  // In pieces so short that each is as good as even.
  constexpr int kPieces = 3000;
  const double lowest = std::clamp(-glm::dot(ray.eye, ray.direction), ray.from, ray.to);
  const double cos_angle = glm::dot(ray.direction, ray.sun);
  dvec3 light(0.0), depth(0.0);
  double before = ray.from;
  for (int k = 0; k < 2 * kPieces; ++k) {
    const double x = static_cast<double>(k + 1 - kPieces) / kPieces;
    const double after = x < 0 ? lowest - (lowest - ray.from) * x * x : lowest + (ray.to - lowest) * x * x;
    const double length = after - before;
    if (!(length > 0.0)) continue;
    const dvec3 p = ray.eye + ray.direction * (0.5 * (before + after));
    const Air air = air_at(model, height(model, p));
    light += glm::exp(-(depth + 0.5 * length * air.extinct)) * turned(model, air, cos_angle) *
             sunlight(model, p, ray.sun) * length;
    depth += length * air.extinct;
    before = after;
  }
  return light;
}

}  // namespace

ScatteringRay scattering_ray(const Model& model, const dvec3& eye, const dvec3& direction, const dvec3& sun) {
  const double along = glm::dot(eye, direction), radius = glm::length(eye);
  const double top = model.ground_km + model.thickness_km;
  const double square = radius * radius - along * along;
  if (square >= top * top) return {eye, direction, 0.0, 0.0, sun};
  const double half = std::sqrt(top * top - square);
  const double from = std::max(-along - half, 0.0);
  double to = std::max(-along + half, 0.0);
  if (along < 0.0 && square < model.ground_km * model.ground_km) {
    const double ground = -along - std::sqrt(model.ground_km * model.ground_km - square);
    to = std::min(to, std::max(ground, from));
  }
  return {eye, direction, from, to, sun};
}

ScatteredLight scattered_light(const Model& model, const ScatteringRay& ray, double interval,
                               std::int64_t most, std::uint64_t seed) {
  ScatteredLight result{};
  if (ray.to <= ray.from) return result;
  result.once = scattered_once(model, ray);
  const Way way(model, ray.eye, ray.direction, ray.from, ray.to, 1000);
  Paths paths(model, ray.sun, seed);
  constexpr int kBatch = 1000;  // one path for each part of the first ray
  dvec3 sum(0.0), squares(0.0);
  std::int64_t batches = 0;
  do {
    dvec3 batch(0.0);
    for (int k = 0; k < kBatch; ++k) {
      const Way::Place place = way.place((k + paths.unit()) / kBatch);
      batch += paths.from(place.p, ray.direction, place.left);
    }
    batch /= kBatch;
    sum += batch;
    squares += batch * batch;
    ++batches;
    const auto n = static_cast<double>(batches);
    result.again = sum / n;
    result.interval = 1.96 * glm::sqrt(glm::max(squares / n - result.again * result.again, dvec3(0.0)) /
                                       std::max(n - 1.0, 1.0));
  } while (batches < 20 || (batches * kBatch < most && strongest(result.interval / result.sum()) > interval));
  return result;
}

}  // namespace app::accuracy
