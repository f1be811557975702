#include "globe/clipmap/drawn_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "globe/clipmap/ground_below.h"
#include "globe/clipmap/level_data.h"

namespace globe::clipmap {
namespace {

constexpr double kBoundsRounding = 1e-6;  ///< bounds are in fp32, and so is what they were made from

NodeRect nodes_of(const LatticeTrixel& trixel, int m) {
  return {trixel.i * m, (trixel.i + 1) * m, trixel.j * m, (trixel.j + 1) * m};
}

/// The stretch of a ray inside a sphere, distances from its origin; nothing when it passes by.
struct Stretch {
  double begin, end;
};
std::optional<Stretch> inside(const Ray& ray, const dvec3& centre, double radius) {
  const dvec3 to = centre - ray.origin();
  const double aside = glm::length(glm::cross(to, ray.direction()));
  if (aside > radius) return std::nullopt;
  const double along = glm::dot(to, ray.direction());
  const double half = std::sqrt((radius - aside) * (radius + aside));
  return Stretch{along - half, along + half};
}

}  // namespace

DrawnSurface::DrawnSurface(const Settings& settings, std::shared_ptr<const planet::Surface> surface,
                           const std::shared_ptr<const ClipmapState>& state, int finest, float fade)
    : settings_(settings),
      surface_(std::move(surface)),
      mesh_(make_patch_mesh(settings.m)),
      nadir_(state->target.u),
      finest_(finest),
      fade_(fade) {
  for (int level = settings_.base_level; level <= finest_; ++level) add_ring(*state, level);
}

void DrawnSurface::add_ring(const ClipmapState& state, int level) {
  const auto data_of = [&](int l) -> const LevelData& {
    return *state.levels[static_cast<std::size_t>(l - settings_.base_level)];
  };
  const LevelData& data = data_of(level);
  for (std::size_t p = 0; p < data.patches.size(); ++p) {
    const Patch& patch = data.patches[p];
    if (level < finest_ && data_of(level + 1).region.holds(patch.trixel)) continue;
    const dvec3 centre(data.bounds[p].centre);
    const auto radius = static_cast<double>(data.bounds[p].radius);
    patches_.emplace_back(patch, level, data.anchor + centre,
                          radius + kBoundsRounding * (radius + glm::length(centre)));
  }
}

std::vector<MorphedVertex> DrawnSurface::evaluate(const DrawnPatch& patch) const {
  const LatticeTrixel& trixel = patch.patch.trixel;
  const PositionGrid grid =
      exact_positions(*surface_, patch.level, trixel.d, nodes_of(trixel, settings_.m), dvec3(0.0));
  return morphed_vertices(settings_, mesh_,
                          {patch.patch, patch.level, nadir_, patch.level == finest_ ? fade_ : 0.0f},
                          [&](const ivec2& node) { return dvec3(grid.at(node.x, node.y)); });
}

const std::vector<MorphedVertex>& DrawnSurface::vertices(const DrawnPatch& patch) const {
  std::call_once(patch.evaluated, [&] { patch.vertices = evaluate(patch); });
  return patch.vertices;
}

std::optional<DrawnPoint> DrawnSurface::hit_in(const DrawnPatch& patch, const Ray& ray,
                                               double nearest_m) const {
  const std::vector<MorphedVertex>& vertex = vertices(patch);
  const std::vector<std::uint16_t>& index = mesh_.indices[static_cast<std::size_t>(patch.patch.rim)];
  std::optional<DrawnPoint> first;
  for (std::size_t k = 0; k < index.size(); k += 3) {
    const std::array corner{&vertex[index[k]], &vertex[index[k + 1]], &vertex[index[k + 2]]};
    const auto hit = ray.meet(corner[0]->position, corner[1]->position, corner[2]->position);
    if (!hit || hit->distance_m < nearest_m || (first && hit->distance_m >= first->distance_m)) continue;
    first = DrawnPoint{dvec3(0.0), hit->distance_m, patch.level, 0.0};
    for (std::size_t c = 0; c < 3; ++c) {
      first->position += hit->weights[c] * corner[c]->position;
      first->alpha += hit->weights[c] * static_cast<double>(corner[c]->alpha);
    }
  }
  return first;
}

std::optional<DrawnPoint> DrawnSurface::first_hit(const Ray& ray, double nearest_m) const {
  struct Near {
    double begin;
    const DrawnPatch* patch;
  };
  std::vector<Near> near;
  for (const DrawnPatch& patch : patches_) {
    const auto stretch = inside(ray, patch.centre, patch.radius);
    if (stretch && stretch->end >= nearest_m) near.push_back({stretch->begin, &patch});
  }
  std::sort(near.begin(), near.end(), [](const Near& a, const Near& b) { return a.begin < b.begin; });
  std::optional<DrawnPoint> first;
  for (const Near& candidate : near) {
    if (first && candidate.begin > first->distance_m) break;
    const auto hit = hit_in(*candidate.patch, ray, nearest_m);
    if (hit && (!first || hit->distance_m < first->distance_m)) first = hit;
  }
  return first;
}

CompleteState complete_state(const Settings& settings, const planet::Surface& surface, const dvec3& position,
                             double away_m, int max_level) {
  Settings plain = settings;
  plain.shading_levels = 0;
  const FinestLevel finest = finest_level(settings, surface.root_edge(), away_m, max_level);
  const geo::Geodetic place = geo::geodetic_from_ecef(surface.ellipsoid(), position);
  const Target target{geo::normal_from_degrees(place.lat_deg, place.lon_deg), finest.level, {}};
  return {plain, advance(plain, surface, target, nullptr, Stride::kWhole).state, finest};
}

DrawnSurface complete_surface(const Settings& settings, std::shared_ptr<const planet::Surface> surface,
                              const dvec3& position, int max_level) {
  const double above = std::max(height_above_ground(settings, *surface, position, max_level, true),
                                least_above_ground(surface->ellipsoid()));
  const CompleteState complete = complete_state(settings, *surface, position, above, max_level);
  return {complete.settings, std::move(surface), complete.state, complete.shown.level, complete.shown.fade};
}

}  // namespace globe::clipmap
