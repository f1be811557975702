#include "globe/render/draw_list.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <tuple>

#include "globe/clipmap/morph.h"

namespace globe::render {
namespace {

using clipmap::kSubcell;
using clipmap::LatticePoint;
using clipmap::LatticeTrixel;
using clipmap::LevelData;
using clipmap::NodeRect;
using clipmap::Patch;
using planet::kDiamonds;

constexpr int kFarAway = 1 << 28;  ///< 1/1024 cells: an image that no vertex is near to

int modulo(int x, int n) { return (x % n + n) % n; }

/// The nearest images of the nadir, relative to a window's first node.
std::array<glm::ivec2, 4> relative_images(const std::vector<LatticePoint>& images, const NodeRect& rect) {
  std::array<glm::ivec2, 4> result;
  result.fill(glm::ivec2(kFarAway, 0));
  for (std::size_t k = 0; k < std::min<std::size_t>(images.size(), 4); ++k) {
    const std::int64_t i = images[k].i - rect.i0 * kSubcell;
    const std::int64_t j = images[k].j - rect.j0 * kSubcell;
    if (std::abs(i) < kFarAway && std::abs(j) < kFarAway)
      result[k] = {static_cast<int>(i), static_cast<int>(j)};
  }
  return result;
}

struct Levels {
  const clipmap::Settings& settings;
  const clipmap::ClipmapState& state;

  const LevelData& data(int level) const {
    return *state.levels[static_cast<std::size_t>(level - settings.base_level)];
  }
};

/// Bounds of the hex distance from the nearest image of the nadir over the vertices of a patch, 1/1024 cells.
struct DistanceRange {
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  std::int64_t most = std::numeric_limits<std::int64_t>::max();
};

DistanceRange distance_range(const std::vector<LatticePoint>& images, const LatticeTrixel& trixel, int m) {
  DistanceRange range;
  for (const LatticePoint& image : images) {
    // The distance is the largest of six linear functions; each is least and most at a corner.
    std::int64_t most = 0;
    std::array<std::int64_t, 6> least{};
    least.fill(std::numeric_limits<std::int64_t>::max());
    for (const glm::ivec2& corner : trixel.corners()) {
      const std::int64_t i = corner.x * m * kSubcell - image.i, j = corner.y * m * kSubcell - image.j;
      const std::array<std::int64_t, 6> values{i, -i, j, -j, i + j, -i - j};
      for (std::size_t k = 0; k < values.size(); ++k) {
        least[k] = std::min(least[k], values[k]);
        most = std::max(most, values[k]);
      }
    }
    range.least = std::min(range.least, *std::max_element(least.begin(), least.end()));
    range.most = std::min(range.most, most);
  }
  return range;
}

/// A patch's shading and geometry from its distances. `share_begin` and `share_end`: shading_share
/// (clipmap.glsl) is 0 up to the one and 1 from the other on.
struct Bands {
  clipmap::MorphBand morph;
  std::int64_t share_begin, share_end;

  explicit Bands(const clipmap::MorphBand& band)
      : morph(band),
        share_begin(band.begin + (band.end - band.begin) / 2),
        share_end(band.begin + (3 * (band.end - band.begin) + 3) / 4) {}

  Look look(const DistanceRange& distance, float fade, bool on_rim) const {
    const bool fine = distance.most <= share_begin && fade <= 0.5f;
    const bool coarse = distance.least >= share_end || fade >= 0.75f;
    const Shading shading = fine && !on_rim ? Shading::kFine : coarse ? Shading::kCoarse : Shading::kBoth;
    if (on_rim) return {Kind::kRim, shading};
    return {distance.most <= morph.begin && fade == 0.0f ? Kind::kPlain : Kind::kMorphing, shading};
  }
};

/// Whether the sun may glint in water of a patch: somewhere within 20 degrees of the mirror's direction,
/// beyond which less than a thousandth of it is left.
bool may_glint(const clipmap::PatchBounds& bounds, const glm::dvec3& centre, const Camera& camera,
               const glm::dvec3& sun) {
  constexpr double kReach = 0.35;
  const bool has_sea = bounds.lowest == 0.0f;  // drawn at height 0 exactly
  if (!has_sea) return false;
  const glm::dvec3 up = glm::normalize(centre);
  const double radius = static_cast<double>(bounds.radius);
  const double bend = radius / glm::length(centre);
  if (glm::dot(sun, up) < -bend) return false;
  const glm::dvec3 to = centre - camera.position;
  const double distance = glm::length(to);
  const glm::dvec3 half_way = sun - to / std::max(distance, 1e-3);
  const double reach = kReach + bend + radius / std::max(distance, 1e-3);
  return reach >= 3.1 || glm::dot(up, half_way) >= std::cos(reach) * glm::length(half_way);
}

}  // namespace

DrawList make_draw_list(const clipmap::Settings& settings, const clipmap::ClipmapState& state,
                        const ClipmapTextures& textures, const geo::Ellipsoid& ellipsoid,
                        const Camera& camera, clipmap::FinestLevel shown, bool cull, const Room* room) {
  const int finest = shown.level;
  const float fade = shown.fade;
  DrawList list;
  std::map<std::tuple<Look, int, int, bool, RoomSide>, Batch> batches;
  const Levels levels{settings, state};
  const Bands bands(clipmap::morph_band(settings));
  const clipmap::Frustum frustum(camera.forward, camera.right, camera.up, camera.tan_x(), camera.tan_y());
  double lowest_m = levels.data(settings.base_level).lowest_m;
  for (int level = settings.base_level; level <= finest; ++level)
    lowest_m = std::min(lowest_m, levels.data(level).lowest_m);
  const clipmap::Horizon horizon(ellipsoid, lowest_m, camera.position);
  const clipmap::Nadir below(state.target.u);
  std::vector<std::array<int, kDiamonds>> slot_of;
  for (int level = settings.base_level; level <= finest; ++level) {
    const LevelData& data = levels.data(level);
    slot_of.emplace_back().fill(-1);
    const clipmap::GridPoint nadir = below.at(level);
    for (int d = 0; d < kDiamonds; ++d) {
      const auto k = static_cast<std::size_t>(d);
      const NodeRect& rect = data.vertices[k];
      if (rect.empty()) continue;
      slot_of.back()[k] = static_cast<int>(list.slots.size());
      SlotBlock slot;
      slot.offset = glm::vec4(glm::vec3(data.anchor - camera.position),
                              level == finest && level > settings.base_level ? fade : 0.0f);
      const int coarse_slot =
          level == settings.base_level ? static_cast<int>(list.slots.size()) : slot_of[slot_of.size() - 2][k];
      const glm::ivec2 first = settings.vertex_torus().texel(rect.i0, rect.j0);
      slot.torus = {first.x, first.y, textures.vertex_layer(level, d), coarse_slot};
      const auto images = relative_images(clipmap::images(nadir, d), rect);
      slot.images_a = {images[0], images[1]};
      slot.images_b = {images[2], images[3]};
      if (level == settings.base_level) {
        slot.images_a = slot.images_b = glm::ivec4(0);  // never morphed
        slot.coarse = {0, 0, level, textures.shading_layer(level, d)};
      } else {
        const NodeRect& coarse = levels.data(level - 1).vertices[k];
        slot.coarse = {rect.i0 - 2 * coarse.i0, rect.j0 - 2 * coarse.j0, level,
                       textures.shading_layer(level, d)};
      }
      const int up = 1 << settings.shading_levels_at(level);
      const double size = settings.shading_window();
      slot.shading = {static_cast<float>((modulo(rect.i0 * up, settings.shading_window()) + 0.5) / size),
                      static_cast<float>((modulo(rect.j0 * up, settings.shading_window()) + 0.5) / size),
                      static_cast<float>(up / size), static_cast<float>(up / size)};
      list.slots.push_back(slot);
    }
  }
  for (int level = finest; level >= settings.base_level; --level) {
    const LevelData& data = levels.data(level);
    const clipmap::Region* hole = level < finest ? &levels.data(level + 1).region : nullptr;
    const clipmap::GridPoint nadir = below.at(level);
    std::array<std::vector<LatticePoint>, kDiamonds> images;
    for (int d = 0; d < kDiamonds; ++d) images[static_cast<std::size_t>(d)] = clipmap::images(nadir, d);
    for (std::size_t p = 0; p < data.patches.size(); ++p) {
      const Patch& patch = data.patches[p];
      const auto d = static_cast<std::size_t>(patch.trixel.d);
      if (hole != nullptr && hole->holds(patch.trixel)) continue;
      const glm::dvec3 centre = data.anchor + glm::dvec3(data.bounds[p].centre);
      if (cull) {
        const auto radius = static_cast<double>(data.bounds[p].radius);
        const auto highest = static_cast<double>(data.bounds[p].highest);
        if (!frustum.sees(centre - camera.position, radius) || !horizon.sees(centre, radius, highest))
          continue;
      }
      Look look;
      if (level > settings.base_level) {
        look = bands.look(distance_range(images[d], patch.trixel, settings.m), level == finest ? fade : 0.0f,
                          (patch.rim | patch.rim_corners) != 0);
      }
      const bool rim = look.kind == Kind::kRim;
      if (may_glint(data.bounds[p], centre, camera, state.target.lighting.sun))
        look = {level > settings.base_level ? Kind::kRim : Kind::kPlain, Shading::kGlint};
      const NodeRect& rect = data.vertices[d];
      const int half = patch.trixel.half;
      const RoomSide side = room == nullptr
                                ? RoomSide::kOutside
                                : side_of(*room, centre, static_cast<double>(data.bounds[p].radius));
      Batch& batch =
          batches[{look, rim ? patch.rim : 0, rim ? patch.rim_corners : 0, data.bounds[p].water, side}];
      batch.instances.emplace_back((patch.trixel.i + half) * settings.m - rect.i0,
                                   (patch.trixel.j + half) * settings.m - rect.j0, half == 0 ? 1 : -1,
                                   slot_of[static_cast<std::size_t>(level - settings.base_level)][d]);
      if (side != RoomSide::kInside) ++list.patches;
    }
  }
  for (auto& [name, batch] : batches) {
    std::tie(batch.look, batch.rim, batch.rim_corners, batch.water, batch.room) = name;
    list.batches.push_back(std::move(batch));
  }
  return list;
}

}  // namespace globe::render
