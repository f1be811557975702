#include "globe/render/draw_list.h"

#include <algorithm>
#include <glm/geometric.hpp>
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

/// True when every vertex of the patch has α = 0: some one image is within the band's beginning of all three
/// corners.
bool is_unmorphed(const std::vector<LatticePoint>& images, const LatticeTrixel& trixel, int m,
                  std::int64_t begin) {
  const auto corners = trixel.corners();
  return std::any_of(images.begin(), images.end(), [&](const LatticePoint& image) {
    return std::all_of(corners.begin(), corners.end(), [&](const glm::ivec2& c) {
      return planet::hex_length(c.x * m * kSubcell - image.i, c.y * m * kSubcell - image.j) <= begin;
    });
  });
}

}  // namespace

DrawList make_draw_list(const clipmap::Settings& settings, const clipmap::ClipmapState& state,
                        const ClipmapTextures& textures, const geo::Ellipsoid& ellipsoid,
                        const Camera& camera, int finest, float fade, bool cull) {
  DrawList list;
  std::map<std::tuple<Kind, int, int>, Batch> batches;
  const Levels levels{settings, state};
  const clipmap::MorphBand band = clipmap::morph_band(settings);
  const clipmap::Frustum frustum(camera.forward, camera.right, camera.up, camera.tan_x(), camera.tan_y());
  double lowest_m = levels.data(settings.base_level).lowest_m;
  for (int level = settings.base_level; level <= finest; ++level)
    lowest_m = std::min(lowest_m, levels.data(level).lowest_m);
  const clipmap::Horizon horizon(ellipsoid, lowest_m, camera.position);
  std::vector<std::array<int, kDiamonds>> slot_of;
  for (int level = settings.base_level; level <= finest; ++level) {
    const LevelData& data = levels.data(level);
    slot_of.emplace_back().fill(-1);
    const clipmap::GridPoint nadir = clipmap::nadir(state.target.u, level);
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
      slot.torus = {modulo(rect.i0, settings.window()), modulo(rect.j0, settings.window()),
                    textures.layer(level, d), coarse_slot};
      const auto images = relative_images(clipmap::images(nadir, d), rect);
      slot.images_a = {images[0], images[1]};
      slot.images_b = {images[2], images[3]};
      if (level == settings.base_level) {
        slot.images_a = slot.images_b = glm::ivec4(0);  // never morphed
        slot.coarse = {0, 0, level, 0};
      } else {
        const NodeRect& coarse = levels.data(level - 1).vertices[k];
        slot.coarse = {rect.i0 - 2 * coarse.i0, rect.j0 - 2 * coarse.j0, level, 0};
      }
      const int up = 1 << settings.shading_levels_at(level);
      const double size = settings.shading_window();
      slot.shading = {static_cast<float>((modulo(rect.i0 * up, settings.shading_window()) + 0.5) / size),
                      static_cast<float>((modulo(rect.j0 * up, settings.shading_window()) + 0.5) / size),
                      static_cast<float>(up / size), static_cast<float>(up / size)};
      slot.axis = glm::vec4(glm::vec3(clipmap::shading_axis(d)), 0.0f);
      list.slots.push_back(slot);
    }
  }
  for (int level = finest; level >= settings.base_level; --level) {
    const LevelData& data = levels.data(level);
    const clipmap::Region* hole = level < finest ? &levels.data(level + 1).region : nullptr;
    const clipmap::GridPoint nadir = clipmap::nadir(state.target.u, level);
    std::array<std::vector<LatticePoint>, kDiamonds> images;
    for (int d = 0; d < kDiamonds; ++d) images[static_cast<std::size_t>(d)] = clipmap::images(nadir, d);
    for (std::size_t p = 0; p < data.patches.size(); ++p) {
      const Patch& patch = data.patches[p];
      const auto d = static_cast<std::size_t>(patch.trixel.d);
      if (hole != nullptr && hole->holds(patch.trixel)) continue;
      if (cull) {
        const glm::dvec3 centre = data.anchor + glm::dvec3(data.bounds[p].centre);
        const auto radius = static_cast<double>(data.bounds[p].radius);
        const auto highest = static_cast<double>(data.bounds[p].highest);
        if (!frustum.sees(centre - camera.position, radius) || !horizon.sees(centre, radius, highest))
          continue;
      }
      Kind kind = Kind::kPlain;
      if (level > settings.base_level) {
        const bool fading = level == finest && fade > 0.0f;
        if (fading || !is_unmorphed(images[d], patch.trixel, settings.m, band.begin)) kind = Kind::kMorphing;
        if ((patch.rim | patch.rim_corners) != 0) kind = Kind::kRim;
      }
      const NodeRect& rect = data.vertices[d];
      const int half = patch.trixel.half;
      const bool rim = kind == Kind::kRim;
      Batch& batch = batches[{kind, rim ? patch.rim : 0, rim ? patch.rim_corners : 0}];
      batch.instances.emplace_back((patch.trixel.i + half) * settings.m - rect.i0,
                                   (patch.trixel.j + half) * settings.m - rect.j0, half == 0 ? 1 : -1,
                                   slot_of[static_cast<std::size_t>(level - settings.base_level)][d]);
      ++list.patches;
    }
  }
  for (auto& [name, batch] : batches) {
    std::tie(batch.kind, batch.rim, batch.rim_corners) = name;
    list.batches.push_back(std::move(batch));
  }
  return list;
}

}  // namespace globe::render
