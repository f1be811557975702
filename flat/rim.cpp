#include "flat/rim.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace globe::flat {
namespace {

namespace shader {
using namespace glm;
#define precise
#include "shaders/flat/lift.glsl"
#undef precise
}  // namespace shader

constexpr int kBandShare = 8;  ///< of a region's shorter side

/// A side of a rectangle: x along it or y, and where it lies across.
struct Line {
  bool along_y;
  double across_m;
  double begin_m, end_m;

  dvec3 place(double along_m, double z) const {
    return along_y ? dvec3(across_m, along_m, z) : dvec3(along_m, across_m, z);
  }
  double along(const dvec3& local) const { return along_y ? local.y : local.x; }
};

/// A side of the region's border, moved outward by a distance.
Line line_of(const Terrain& terrain, std::size_t side, double outward_m) {
  const PostRect& posts = terrain.posts();
  const double west = terrain.x_m(0) - outward_m, east = terrain.x_m(posts.columns - 1) + outward_m;
  const double south = terrain.y_m(0) - outward_m, north = terrain.y_m(posts.rows - 1) + outward_m;
  switch (side) {
    case kWest:
      return {true, west, south, north};
    case kEast:
      return {true, east, south, north};
    case kSouth:
      return {false, south, west, east};
    default:
      return {false, north, west, east};
  }
}

RimCurve curve_along(const Terrain& terrain, const Line& line, const Cutter& cut) {
  const TangentFrame& frame = terrain.frame();
  const double middle = 0.5 * (line.begin_m + line.end_m), half = 0.5 * (line.end_m - line.begin_m);
  const double z = frame.z_at(line.place(middle, 0).x, line.place(middle, 0).y, 0.0);
  // Heights there are, and how far the frame's plane departs from the ellipsoid: well within the half length
  // and 20 km.
  const auto segments = cut(
      {frame.ecef_from_local(line.place(middle, z)), frame.axes()[line.along_y ? 0 : 1], half + 20'000.0});
  std::vector<glm::dvec2> points;
  points.reserve(2 * segments.size());
  for (const auto& segment : segments) {
    for (const dvec3& end : segment) {
      const dvec3 local = frame.local_from_ecef(end);
      points.emplace_back(line.along(local), local.z);
    }
  }
  if (points.empty()) points.emplace_back(middle, z);
  return RimCurve(std::move(points));
}

/// Posts of a side, from the west or the south.
struct SidePosts {
  int count;
  bool along_rows;
  int fixed;

  glm::ivec2 post(int k) const { return along_rows ? glm::ivec2(fixed, k) : glm::ivec2(k, fixed); }
};

SidePosts side_posts(const PostRect& posts, std::size_t side) {
  switch (side) {
    case kWest:
      return {posts.rows, true, 0};
    case kEast:
      return {posts.rows, true, posts.columns - 1};
    case kSouth:
      return {posts.columns, false, 0};
    default:
      return {posts.columns, false, posts.rows - 1};
  }
}

int rim_band(const Terrain& terrain) {
  return std::max(kPatchCells, std::min(terrain.posts().columns, terrain.posts().rows) / kBandShare);
}

double lift_share(double away_posts, int band) {
  return static_cast<double>(shader::lift_share(static_cast<float>(away_posts), static_cast<float>(band)));
}

}  // namespace

render::Room room_of(const Terrain& terrain) {
  const PostRect& posts = terrain.posts();
  const double collar_m = kCollarPosts * terrain.spacing_m();
  return {terrain.frame().ecef_from_local(dvec3(0.0)),
          terrain.frame().axes(),
          {terrain.x_m(0) - collar_m, terrain.y_m(0) - collar_m},
          {terrain.x_m(posts.columns - 1) + collar_m, terrain.y_m(posts.rows - 1) + collar_m}};
}

RimCurve::RimCurve(std::vector<glm::dvec2> points) : points_(std::move(points)) {
  std::sort(points_.begin(), points_.end(),
            [](const glm::dvec2& a, const glm::dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  points_.erase(std::unique(points_.begin(), points_.end(),
                            [](const glm::dvec2& a, const glm::dvec2& b) { return a.x == b.x; }),
                points_.end());
}

double RimCurve::z_at(double along_m) const {
  const auto after = std::upper_bound(points_.begin(), points_.end(), along_m,
                                      [](double x, const glm::dvec2& point) { return x < point.x; });
  if (after == points_.begin()) return points_.front().y;
  if (after == points_.end()) return points_.back().y;
  const glm::dvec2& a = *(after - 1);
  return a.y + (after->y - a.y) * ((along_m - a.x) / (after->x - a.x));
}

Rim make_rim(const Terrain& terrain, const Cutter& cut) {
  const PostRect& posts = terrain.posts();
  Rim rim;
  rim.band = rim_band(terrain);
  for (std::size_t side = 0; side < kSides; ++side) {
    rim.outside[side] = curve_along(terrain, line_of(terrain, side, kCollarPosts * terrain.spacing_m()), cut);
    const Line border = line_of(terrain, side, 0.0);
    const RimCurve beside = curve_along(terrain, border, cut);
    const SidePosts along = side_posts(posts, side);
    for (int k = 0; k < along.count; ++k) {
      const glm::ivec2 post = along.post(k);
      const double at = border.along_y ? terrain.y_m(post.y) : terrain.x_m(post.x);
      const auto lift = static_cast<float>(beside.z_at(at) - static_cast<double>(terrain.z(post.x, post.y)));
      rim.lifts[side].push_back(lift);
      rim.highest_m = std::max(rim.highest_m, static_cast<double>(std::abs(lift)));
    }
  }
  // The two sides at a corner agree.
  rim.lifts[kSouth].front() = rim.lifts[kWest].front();
  rim.lifts[kSouth].back() = rim.lifts[kEast].front();
  rim.lifts[kNorth].front() = rim.lifts[kWest].back();
  rim.lifts[kNorth].back() = rim.lifts[kEast].back();
  const render::Room room = room_of(terrain);
  rim.corner_z = {rim.outside[kWest].z_at(room.low.y), rim.outside[kEast].z_at(room.low.y),
                  rim.outside[kWest].z_at(room.high.y), rim.outside[kEast].z_at(room.high.y)};
  return rim;
}

render::RegionBelow region_below(const Terrain& terrain, const dvec3& position) {
  const render::Room room = room_of(terrain);
  if (glm::dot(position, room.axes[2]) < 0.0) return {};  // the planet's other half lies in the same prism
  const glm::dvec4 inside = room.inside_m(position) / terrain.spacing_m() - kCollarPosts;
  const double aside = std::min(inside.x, inside.y), along = std::min(inside.z, inside.w);
  if (aside <= 0.0 || along <= 0.0) return {};
  const int band = rim_band(terrain);
  return {(1.0 - lift_share(aside, band)) * (1.0 - lift_share(along, band)), terrain.height_above(position)};
}

float lift_at(const Rim& rim, const PostRect& posts, int column, int row) {
  const glm::ivec2 last(posts.columns - 1, posts.rows - 1);
  const bool east = 2 * column > last.x, north = 2 * row > last.y;
  const std::vector<float>& beside = rim.lifts[east ? kEast : kWest];
  const std::vector<float>& below = rim.lifts[north ? kNorth : kSouth];
  return shader::lift_of(
      beside[static_cast<std::size_t>(row)], below[static_cast<std::size_t>(column)],
      north ? beside.back() : beside.front(),
      shader::lift_share(static_cast<float>(east ? last.x - column : column), static_cast<float>(rim.band)),
      shader::lift_share(static_cast<float>(north ? last.y - row : row), static_cast<float>(rim.band)));
}

bool is_at_border(const Terrain& terrain, std::size_t patch) {
  const auto east = static_cast<std::size_t>(terrain.patches_east());
  const std::size_t i = patch % east, j = patch / east;
  return i == 0 || j == 0 || i + 1 == east || j + 1 == static_cast<std::size_t>(terrain.patches_north());
}

namespace {

/// A vertex of one of the two edges of the collar.
struct EdgeVertex {
  double along;  ///< posts along the side
  CollarVertex vertex;
};

double cross(const glm::vec2& a, const glm::vec2& b, const glm::vec2& c) {
  const glm::dvec2 u(b - a), v(c - a);
  return u.x * v.y - u.y * v.x;
}

void add_triangle(const CollarVertex& a, const CollarVertex& b, const CollarVertex& c,
                  std::vector<CollarVertex>& triangles) {
  const double area = cross(a.post, b.post, c.post);
  if (area == 0.0) return;
  triangles.insert(triangles.end(), {a, area > 0.0 ? b : c, area > 0.0 ? c : b});
}

/// Triangles between two edges that run the same way.
void add_strip(const std::vector<EdgeVertex>& inner, const std::vector<EdgeVertex>& outer,
               std::vector<CollarVertex>& triangles) {
  std::size_t i = 0, o = 0;
  while (i + 1 < inner.size() || o + 1 < outer.size()) {
    const bool inward =
        o + 1 == outer.size() || (i + 1 < inner.size() && inner[i + 1].along <= outer[o + 1].along);
    if (inward) {
      add_triangle(inner[i].vertex, inner[i + 1].vertex, outer[o].vertex, triangles);
      ++i;
    } else {
      add_triangle(outer[o].vertex, outer[o + 1].vertex, inner[i].vertex, triangles);
      ++o;
    }
  }
}

}  // namespace

void add_collar(const Terrain& terrain, const Rim& rim, const BorderPatch& border, bool morphs,
                const glm::dvec2& eye_post, std::vector<CollarVertex>& triangles) {
  const PostRect& posts = terrain.posts();
  const auto patches_east = static_cast<std::size_t>(terrain.patches_east());
  const glm::ivec2 first(static_cast<int>(border.patch % patches_east) * kPatchCells,
                         static_cast<int>(border.patch / patches_east) * kPatchCells);
  const glm::ivec2 end(posts.columns - 1, posts.rows - 1);
  const std::array<bool, kSides> open{first.x == 0, first.x + kPatchCells == end.x, first.y == 0,
                                      first.y + kPatchCells == end.y};
  for (std::size_t side = 0; side < kSides; ++side) {
    if (!open[side]) continue;
    const bool along_y = side == kWest || side == kEast;
    const auto along_of = [&](const glm::dvec2& post) { return along_y ? post.y : post.x; };
    const auto from_eye = [&](const glm::dvec2& post) { return glm::vec2(post - eye_post); };

    std::vector<EdgeVertex> inner;
    const int step = 1 << (border.state.level + (border.state.coarser[side] ? 1 : 0));
    for (const PatchVertex& vertex : border.vertices) {
      const int across = along_y ? vertex.column : vertex.row;
      const int along = along_y ? vertex.row : vertex.column;
      if (across != (side == kWest || side == kSouth ? 0 : kPatchCells) || along % step != 0) continue;
      const glm::dvec2 post(first.x + vertex.column, first.y + vertex.row);
      inner.push_back(
          {along_of(post), {from_eye(post), morphs ? morphed_z(vertex, border.state) : vertex.z, 1.0f}});
    }
    std::sort(inner.begin(), inner.end(),
              [](const EdgeVertex& a, const EdgeVertex& b) { return a.along < b.along; });

    // The outer edge goes as far along, at the region's corners to those of the room.
    const double spacing = terrain.spacing_m();
    const double origin = along_y ? terrain.y_m(0) : terrain.x_m(0);
    const double across = side == kWest || side == kSouth
                              ? -kCollarPosts
                              : static_cast<double>(along_y ? end.x : end.y) + kCollarPosts;
    const auto outer_vertex = [&](double along, double z) {
      return EdgeVertex{along,
                        {from_eye(along_y ? glm::dvec2(across, along) : glm::dvec2(along, across)),
                         static_cast<float>(z), 0.0f}};
    };
    const double last = along_y ? end.y : end.x;
    const double begin_at = inner.front().along == 0.0 ? -kCollarPosts : inner.front().along;
    const double end_at = inner.back().along == last ? last + kCollarPosts : inner.back().along;
    const RimCurve& curve = rim.outside[side];
    const auto corner = [&](bool far) {
      const bool east = along_y ? side == kEast : far;
      const bool north = along_y ? far : side == kNorth;
      return rim.corner_z[(north ? 2u : 0u) + (east ? 1u : 0u)];
    };
    const auto z_at = [&](double along) {
      if (along < 0.0) return corner(false);
      if (along > last) return corner(true);
      return curve.z_at(origin + along * spacing);
    };
    std::vector<EdgeVertex> outer{outer_vertex(begin_at, z_at(begin_at))};
    for (const glm::dvec2& point : curve.points()) {
      const double along = (point.x - origin) / spacing;
      if (along > begin_at && along < end_at) outer.push_back(outer_vertex(along, point.y));
    }
    outer.push_back(outer_vertex(end_at, z_at(end_at)));
    add_strip(inner, outer, triangles);
  }
}

}  // namespace globe::flat
