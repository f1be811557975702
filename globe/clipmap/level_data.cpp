#include "globe/clipmap/level_data.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <iterator>
#include <limits>

#include "globe/clipmap/footprint.h"
#include "globe/clipmap/patch.h"
#include "globe/clipmap/shading_nodes.h"

namespace globe::clipmap {
namespace {

using planet::kDiamonds;
using planet::Surface;

std::size_t at(const NodeRect& rect, int i, int j) {
  return static_cast<std::size_t>(j - rect.j0) * static_cast<std::size_t>(rect.width()) +
         static_cast<std::size_t>(i - rect.i0);
}

/// What stays resident of a level's ground when its window becomes `rect`.
std::vector<GroundPart> parts_within(const NodeRect& rect, const std::vector<GroundPart>& parts) {
  std::vector<GroundPart> kept;
  for (const GroundPart& part : parts) {
    const NodeRect valid = intersect(part.valid, rect);
    if (!valid.empty()) kept.push_back({part.made, valid, part.nodes});
  }
  return kept;
}

GroundPart make_ground(const Surface& surface, int level, int d, const NodeRect& rect,
                       const planet::Coloring* coloring) {
  auto nodes = std::make_shared<ShadingNodes>(make_shading_nodes(surface, level, d, rect, coloring));
  return {rect, rect, std::move(nodes)};
}

ShadingBlock make_shading_block(const Lighting& lighting, int level, int d, const GroundPart& part) {
  ShadingBlock block{d, part.valid, lit_nodes(lighting, level, d, part.valid, part.made, *part.nodes), {}};
  block.water.reserve(block.lit.size());
  for (int j = part.valid.j0; j <= part.valid.j1; ++j) {
    for (int i = part.valid.i0; i <= part.valid.i1; ++i)
      block.water.push_back(part.nodes->albedo[at(part.made, i, j)].a);
  }
  return block;
}

/// Bounds of a patch of sea floor and of the sea over it: a sphere around both, the sea's being as wide.
PatchBounds with_sea(const dvec3& anchor, const PatchBounds& floor) {
  constexpr auto kWaves = static_cast<float>(planet::kHighestWave);
  const glm::vec3 up(glm::normalize(anchor + dvec3(floor.centre)));
  const float rise = kWaves - floor.lowest;
  PatchBounds both = floor;
  both.centre += 0.5f * rise * up;
  both.radius += rise * (0.5f + floor.radius / static_cast<float>(glm::length(anchor + dvec3(floor.centre))));
  both.highest = std::max(floor.highest, kWaves);
  both.water = true;
  return both;
}

PatchBounds bound_patch(const Settings& settings, const Surface& surface, const LevelData& data,
                        const Patch& patch) {
  const auto d = static_cast<std::size_t>(patch.trixel.d);
  glm::vec3 low(std::numeric_limits<float>::max());
  glm::vec3 high(std::numeric_limits<float>::lowest());
  const auto position = [&](int a, int b) {
    const ivec2 node = patch_node(patch.trixel, settings.m, a, b);
    return data.positions[d][at(data.vertices[d], node.x, node.y)];
  };
  float highest = std::numeric_limits<float>::lowest();
  float lowest = std::numeric_limits<float>::max();
  for (int b = 0; b <= settings.m; ++b) {
    for (int a = 0; a + b <= settings.m; ++a) {
      const glm::vec4 vertex = position(a, b);
      low = glm::min(low, glm::vec3(vertex));
      high = glm::max(high, glm::vec3(vertex));
      highest = std::max(highest, vertex.w);
      lowest = std::min(lowest, vertex.w);
    }
  }
  PatchBounds bounds{(low + high) * 0.5f, 0.0f, highest, lowest};
  for (int b = 0; b <= settings.m; ++b) {
    for (int a = 0; a + b <= settings.m; ++a) {
      bounds.radius = std::max(bounds.radius, glm::distance(bounds.centre, glm::vec3(position(a, b))));
    }
  }
  if (surface.has_bare_floor() && lowest < 0.0f) bounds = with_sea(data.anchor, bounds);
  return bounds;  // morphed vertices lie between these positions, hence inside
}

/// How far the flat triangles of a level lie below the ellipsoid between their corners, metres: the square of
/// the largest circumcircle's radius over 2R. The largest edge, at a face's middle, is 1.56 times 2^-level of
/// a root's.
double sag(const Surface& surface, int level) {
  const double circumradius = std::ldexp(1.56 / std::sqrt(3.0) * surface.root_edge(), -level);
  return circumradius * circumradius / (2.0 * std::min(surface.ellipsoid().a, surface.ellipsoid().b()));
}

double lowest_vertex(const LevelData& data) {
  float lowest = std::numeric_limits<float>::max();
  for (const auto& diamond : data.positions) {
    for (const glm::vec4& position : diamond) lowest = std::min(lowest, position.w);
  }
  return static_cast<double>(lowest);
}

/// Values of a rectangle of nodes copied from those of another.
void copy_nodes(const NodeRect& nodes, const NodeRect& from_nodes, const std::vector<glm::vec4>& from,
                const NodeRect& to_nodes, std::vector<glm::vec4>& to) {
  for (int j = nodes.j0; j <= nodes.j1; ++j) {
    const auto first = from.begin() + static_cast<std::ptrdiff_t>(at(from_nodes, nodes.i0, j));
    std::copy(first, first + nodes.width(),
              to.begin() + static_cast<std::ptrdiff_t>(at(to_nodes, nodes.i0, j)));
  }
}

VertexBlock cut_out(const LevelData& data, int d, const NodeRect& nodes) {
  const auto k = static_cast<std::size_t>(d);
  const auto count = static_cast<std::size_t>(nodes.width()) * static_cast<std::size_t>(nodes.height());
  VertexBlock block{d, nodes, std::vector<glm::vec4>(count), std::vector<glm::vec4>(count), {}, {}};
  copy_nodes(nodes, data.vertices[k], data.positions[k], nodes, block.position);
  copy_nodes(nodes, data.vertices[k], data.coarse[k], nodes, block.coarse);
  return block;
}

/// Vertices of a level's share of a diamond: those that `before` (null: nothing) holds as they are, the rest
/// made. What its textures lack goes to `uploads`.
void fill_vertices(const Settings& settings, const Surface& surface, int level, int d,
                   const LevelData* before, LevelData& data, std::vector<VertexBlock>& uploads) {
  const auto k = static_cast<std::size_t>(d);
  const NodeRect& rect = data.vertices[k];
  const NodeRect held = before != nullptr ? before->vertices[k] : NodeRect{};
  const NodeRect common = held.empty() ? NodeRect{} : intersect(rect, held);
  const bool in_strips = settings.windows == Windows::kHexagon;
  const auto count = static_cast<std::size_t>(rect.width()) * static_cast<std::size_t>(rect.height());
  data.positions[k].resize(count);
  if (in_strips) data.coarse[k].resize(count);
  if (!common.empty()) {
    copy_nodes(common, held, before->positions[k], rect, data.positions[k]);
    if (in_strips) copy_nodes(common, held, before->coarse[k], rect, data.coarse[k]);
  }
  for (const NodeRect& part : difference(rect, held)) {
    VertexBlock block = make_vertex_block(settings, surface, level, d, part, data.anchor);
    copy_nodes(part, part, block.position, rect, data.positions[k]);
    if (in_strips)
      copy_nodes(part, part, block.coarse, rect, data.coarse[k]);
    else
      uploads.push_back(std::move(block));
  }
  if (!in_strips) return;
  // Strips grow where the hexagon's slanted sides move, inside the rectangle too.
  for (const NodeRect& piece :
       difference(data.footprint[k], before != nullptr ? before->footprint[k] : std::vector<NodeRect>{}))
    uploads.push_back(cut_out(data, d, piece));
}

}  // namespace

std::size_t LevelUpdate::upload_bytes() const {
  std::size_t bytes = 0;
  for (const VertexBlock& block : vertex_blocks) bytes += block.upload_bytes();
  for (const ShadingBlock& block : shading_blocks) {
    bytes += block.lit.size() * sizeof(glm::u8vec4) + block.water.size();
  }
  return bytes;
}

dvec3 level_anchor(const Settings& settings, const Surface& surface, const Region& region) {
  Node node{0, region.level, 0, 0};
  if (region.level > settings.base_level && settings.positions != Positions::kFloat32) {
    const int step = std::min(static_cast<int>(std::bit_floor(static_cast<unsigned>(2 * settings.s))),
                              planet::nodes_per_side(region.level));
    node = nearest_lattice_node(grid_point(region.centre), step);
  } else {
    return dvec3(0.0);  // the whole sphere: its centre
  }
  return geo::ecef_from_normal(surface.ellipsoid(), planet::node_direction(node),
                               surface.mesh_height(surface.height(node)));
}

LevelUpdate update_level(const Settings& settings, const Surface& surface, Region region,
                         const Lighting& lighting, const LevelData* before) {
  auto data = std::make_shared<LevelData>();
  LevelUpdate update;
  const int level = region.level;
  const int shading_level = level + settings.shading_levels_at(level);
  const int up = 1 << settings.shading_levels_at(level);
  const int shading_n = planet::nodes_per_side(shading_level);
  data->anchor = level_anchor(settings, surface, region);
  const LevelData* painted =
      before != nullptr && before->lighting.coloring == lighting.coloring ? before : nullptr;
  const bool same_anchor = before != nullptr && before->anchor == data->anchor;
  const bool same_light = before != nullptr && before->lighting == lighting;
  data->vertices = region.nodes;
  struct Blocks {
    std::vector<VertexBlock> vertices;
    std::vector<ShadingBlock> shading;
  };
  std::array<Blocks, kDiamonds> blocks;
  tbb::parallel_for(0, kDiamonds, [&](int d) {
    const auto k = static_cast<std::size_t>(d);
    const NodeRect& rect = data->vertices[k];
    if (rect.empty()) return;
    data->footprint[k] = footprint(settings, region, d);
    fill_vertices(settings, surface, level, d, same_anchor ? before : nullptr, *data, blocks[k].vertices);
    // One guard node all round: bilinear look-ups at the border of the region read it, with weight zero.
    data->shading[k] = {std::max(rect.i0 * up - 1, 0), std::min(rect.i1 * up + 1, shading_n),
                        std::max(rect.j0 * up - 1, 0), std::min(rect.j1 * up + 1, shading_n)};
    if (painted != nullptr) data->ground[k] = parts_within(data->shading[k], painted->ground[k]);
    const std::size_t kept = data->ground[k].size();
    for (const NodeRect& part :
         difference(data->shading[k], painted != nullptr ? painted->shading[k] : NodeRect{})) {
      data->ground[k].push_back(make_ground(surface, shading_level, d, part, lighting.coloring.get()));
    }
    for (std::size_t p = same_light ? kept : 0; p < data->ground[k].size(); ++p)
      blocks[k].shading.push_back(make_shading_block(lighting, shading_level, d, data->ground[k][p]));
  });
  for (Blocks& made : blocks) {
    std::move(made.vertices.begin(), made.vertices.end(), std::back_inserter(update.vertex_blocks));
    std::move(made.shading.begin(), made.shading.end(), std::back_inserter(update.shading_blocks));
  }
  data->lighting = lighting;
  data->region = std::move(region);
  data->patches = make_ring(settings, data->region, nullptr);
  std::sort(data->patches.begin(), data->patches.end(),
            [](const Patch& a, const Patch& b) { return a.trixel < b.trixel; });
  data->bounds.reserve(data->patches.size());
  for (const Patch& patch : data->patches)
    data->bounds.push_back(bound_patch(settings, surface, *data, patch));
  // between chords of whole patches, as deep as triangles of that size would lie
  const int drawn_flat = settings.positions == Positions::kChord
                             ? level - static_cast<int>(std::bit_width(static_cast<unsigned>(settings.m))) + 1
                             : level;
  data->lowest_m = lowest_vertex(*data) - sag(surface, drawn_flat);
  update.data = std::move(data);
  return update;
}

}  // namespace globe::clipmap
