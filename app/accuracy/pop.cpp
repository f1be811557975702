#include "app/accuracy/pop.h"

#include <cmath>
#include <cstdio>
#include <string>

namespace app::accuracy {
namespace {

using globe::planet::Node;

constexpr double kPixelsPerRadian = 360.0 / 0.57735026918962576;

}  // namespace

NodeName name_of(const Node& node) {
  const auto key = globe::planet::octahedral_key(node);
  return {node.level, key.x, key.y, key.z};
}

std::map<NodeName, std::pair<Node, dvec3>> places(const MeshProbe& probe, const Camera& camera, float fade) {
  std::map<NodeName, std::pair<Node, dvec3>> result;
  for (const auto& v : probe.triangles(camera, fade, MeshProbe::Space::kRelative)) {
    if (!v.on_rim) result[name_of(v.node)] = {v.node, dvec3(v.seen)};
  }
  return result;
}

double on_screen(const dvec3& movement, const dvec3& relative) {
  return glm::length(movement) / glm::length(relative) * kPixelsPerRadian;
}

std::size_t add_pops(const Surface& surface, MeshProbe& probe, const globe::geo::Geodetic& place, int level,
                     float fade, ErrorSum& sum) {
  const double above = surface.root_edge() * probe.settings().s / std::exp2(level);
  const dvec3 u = globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg);
  globe::geo::Geodetic at = place;
  at.h_m = surface.drawn_height(surface.height(u, level)) + above;
  const Camera camera = globe::render::make_camera(surface.ellipsoid(), at, 0.0, -60.0, 60.0, 16.0 / 9.0);
  probe.load(camera.position, level - 1);
  const auto above_it = places(probe, camera, 0.0f);
  const auto at_coarser = [&](int d, int i, int j) {
    return above_it.find(name_of({d, level - 1, i / 2, j / 2}));
  };
  probe.load(camera.position, level);
  std::size_t vertices = 0;
  for (const auto& [name, drawn] : places(probe, camera, fade)) {
    const auto& [node, relative] = drawn;
    if (node.level != level) continue;
    ++vertices;
    const auto ends = globe::planet::halved_edge(node.i, node.j);
    const auto a =
        is_odd(node) ? at_coarser(node.d, ends[0].x, ends[0].y) : at_coarser(node.d, node.i, node.j);
    const auto b = is_odd(node) ? at_coarser(node.d, ends[1].x, ends[1].y) : a;
    if (a == above_it.end() || b == above_it.end()) continue;
    const dvec3 was = 0.5 * (a->second.second + b->second.second);
    sum.add(on_screen(relative - was, was), [&] {
      char text[96];
      std::snprintf(text, sizeof text, "level %d admitted %.3g m over %.4f,%.4f, %.3g m away", level, above,
                    place.lat_deg, place.lon_deg, glm::length(was));
      return std::string(text);
    });
  }
  return vertices;
}

}  // namespace app::accuracy
