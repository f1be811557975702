#include "globe/clipmap/patch_surface.h"

#include <algorithm>
#include <bit>
#include <glm/glm.hpp>

#include "globe/planet/directions.h"

namespace globe::clipmap {
namespace {

namespace shader {
using namespace glm;

#define precise
#include "shaders/lib/patch_surface.glsl"
#undef precise
}  // namespace shader

std::size_t index_of(const NodeRect& rect, const ivec2& p) {
  return static_cast<std::size_t>(p.y - rect.j0) * static_cast<std::size_t>(rect.width()) +
         static_cast<std::size_t>(p.x - rect.i0);
}

/// Knots of whole patches: even ones in steps of half a patch.
NodeRect knots_around(const NodeRect& nodes, int m, int knots_a_patch) {
  const auto up = [&](int x) { return (x + m - 1) / m * knots_a_patch; };
  const auto down = [&](int x) { return x / m * knots_a_patch; };
  return {down(nodes.i0), up(nodes.i1), down(nodes.j0), up(nodes.j1)};
}

}  // namespace

KnotBlock make_knots(const Settings& settings, const geo::Ellipsoid& ellipsoid, int level, int d,
                     const NodeRect& nodes, const dvec3& anchor) {
  const int step = settings.knot_step();
  const int knot_level = level - static_cast<int>(std::bit_width(static_cast<unsigned>(step))) + 1;
  KnotBlock block{knots_around(nodes, settings.m, settings.m / step), {}, {}};
  const NodeRect& rect = block.knots;
  const std::vector<dvec3> normals =
      planet::node_directions(d, knot_level, {rect.i0, rect.j0}, {rect.i1, rect.j1});
  std::vector<dvec3> places;
  places.reserve(normals.size());
  for (const dvec3& u : normals) {
    places.push_back(geo::surface_point(ellipsoid, u) - anchor);
    block.normal.emplace_back(glm::vec3(u), 0.0f);
  }
  block.surface.reserve(places.size());
  for (int j = rect.j0; j <= rect.j1; ++j) {
    for (int i = rect.i0; i <= rect.i1; ++i) {
      dvec3 place = places[index_of(rect, {i, j})];
      const bool halves = step < settings.m && ((i | j) & 1) != 0;
      if (halves) {
        const auto ends = planet::halved_edge(i, j);
        // of the corners as they are stored, so that the middle comes out as it is
        place -= 0.5 * (dvec3(glm::vec3(places[index_of(rect, ends[0])])) +
                        dvec3(glm::vec3(places[index_of(rect, ends[1])])));
      }
      block.surface.emplace_back(glm::vec3(place), 0.0f);
    }
  }
  return block;
}

glm::vec3 patch_surface(const Settings& settings, const KnotBlock& knots, int i, int j, float height) {
  const int m = settings.m;
  const int a_patch = m / settings.knot_step();
  // The patch that holds the node; on an edge either does.
  const auto square = [&](int x, int last) { return std::min(x / m, last / a_patch - 1); };
  ivec2 cell{square(i, knots.knots.i1), square(j, knots.knots.j1)};
  ivec2 ab = ivec2(i, j) - cell * m;
  int turn = 1;
  if (ab.x + ab.y > m) {
    cell += 1;
    ab = ivec2(m) - ab;
    turn = -1;
  }
  const auto knot = [&](int a, int b) { return index_of(knots.knots, cell * a_patch + turn * ivec2(a, b)); };
  const auto corners = [&](const std::vector<glm::vec4>& values, const glm::vec3& share) {
    return shader::between_corners(share, glm::vec3(values[knot(0, 0)]), glm::vec3(values[knot(a_patch, 0)]),
                                   glm::vec3(values[knot(0, a_patch)]));
  };
  const glm::vec3 share = shader::corner_shares(ab, m);
  glm::vec3 place = corners(knots.surface, share);
  if (a_patch == 2) {
    place += shader::bulge(share, glm::vec3(knots.surface[knot(1, 1)]), glm::vec3(knots.surface[knot(0, 1)]),
                           glm::vec3(knots.surface[knot(1, 0)]));
  }
  return shader::raised(place, corners(knots.normal, share), height);
}

}  // namespace globe::clipmap
