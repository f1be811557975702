#include "converters/local_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>
#include <unordered_map>

#include "converters/export_map.h"
#include "globe/base/angles.h"
#include "globe/base/error.h"
#include "globe/planet/lattice_trixel.h"

namespace converters {
namespace {

using globe::kDegree;
using globe::geo::dvec3;
using globe::geo::Geodetic;
using globe::planet::LatticeTrixel;
using globe::planet::Node;
using globe::planet::Surface;

constexpr double kHandyVertices = 1e6;

/// Of a longitude east of the region's western side, [0, 360).
double east_of(double west_deg, double lon_deg) {
  const double east = lon_deg - west_deg;
  return east - 360.0 * std::floor(east / 360.0);
}

dvec3 middle_of(const globe::htm::Corners& c) { return glm::normalize(c[0] + c[1] + c[2]); }

/// Collects the trixels of a level whose middles lie in an extent, in the order of the index.
class Collector {
 public:
  Collector(const Extent& extent, int level) : extent_(extent), level_(level) {
    for (int d = 0; d < globe::planet::kDiamonds; ++d) {
      for (int half = 0; half < 2; ++half) {
        const LatticeTrixel root = globe::planet::lattice_trixel(d, 0, 0, 0, half);
        visit(root, globe::planet::corners(root));
      }
    }
  }

  std::vector<LatticeTrixel> trixels;

 private:
  void visit(const LatticeTrixel& t, const globe::htm::Corners& corners) {
    const dvec3 middle = middle_of(corners);
    const Geodetic at = globe::geo::degrees_from_normal(middle);
    if (t.level == level_) {
      if (at.lat_deg < extent_.south || at.lat_deg > extent_.north ||
          east_of(extent_.west, at.lon_deg) > extent_.east - extent_.west)
        return;
      if (trixels.size() > 2 * kMaxMeshVertices) {
        throw globe::UsageError(
            "--level " + std::to_string(level_),
            "the mesh would have more than " + std::to_string(kMaxMeshVertices) + " vertices",
            "give a coarser --level or a smaller --extent");
      }
      trixels.push_back(t);
      return;
    }
    if (!may_touch(corners, middle, at)) return;
    const auto parts = children(t);
    const auto part_corners = globe::planet::children_corners(corners);
    for (std::size_t k = 0; k < parts.size(); ++k) visit(parts[k], part_corners[k]);
  }

  /// Whether the cap around a trixel reaches the extent.
  bool may_touch(const globe::htm::Corners& corners, const dvec3& middle, const Geodetic& at) const {
    double radius = 0;
    for (const dvec3& corner : corners)
      radius = std::max(radius, std::acos(std::min(1.0, glm::dot(corner, middle))) / kDegree);
    radius += 1e-9;
    if (at.lat_deg + radius < extent_.south || at.lat_deg - radius > extent_.north) return false;
    if (std::abs(at.lat_deg) + radius >= 90.0) return true;
    const double reach =
        std::asin(std::min(1.0, std::sin(radius * kDegree) / std::cos(at.lat_deg * kDegree))) / kDegree;
    const double wide = extent_.east - extent_.west;
    const double east = east_of(extent_.west, at.lon_deg);
    return east <= wide + reach || east >= 360.0 - reach;
  }

  Extent extent_;
  int level_;
};

int level_for(const Surface& surface, const Extent& extent) {
  int level = default_level(surface, MapContent::kHeights, extent);
  const double share = (extent.east - extent.west) / 360.0 *
                       (std::sin(extent.north * kDegree) - std::sin(extent.south * kDegree)) / 2.0;
  while (level > 0 && share * 4.0 * std::pow(4.0, level) > kHandyVertices) --level;
  return level;
}

struct KeyHash {
  std::size_t operator()(const globe::planet::ivec3& key) const {
    return static_cast<std::size_t>(globe::planet::vertex_hash(0, key));
  }
};

/// Turns ECEF metres into the mesh's frame.
class Frame {
 public:
  Frame(const globe::geo::Ellipsoid& ellipsoid, const Geodetic& origin)
      : local_(globe::geo::local_frame(origin.lat_deg, origin.lon_deg)),
        origin_(globe::geo::ecef_from_geodetic(ellipsoid, origin)) {}
  dvec3 operator()(const dvec3& ecef) const {
    const dvec3 from = ecef - origin_;
    return {glm::dot(from, local_.east), glm::dot(from, local_.up), -glm::dot(from, local_.north)};
  }

 private:
  globe::geo::LocalFrame local_;
  dvec3 origin_;
};

}  // namespace

LocalMesh make_local_mesh(const Surface& surface, const Extent& extent, const std::optional<int>& level) {
  if (extent.east - extent.west > kMaxMeshSide_deg || extent.north - extent.south > kMaxMeshSide_deg) {
    throw globe::UsageError("--extent", "a mesh is a local thing, at most 90 degrees each way",
                            "give a smaller --extent");
  }
  LocalMesh mesh;
  mesh.level = level ? *level : level_for(surface, extent);
  const std::vector<LatticeTrixel> trixels = Collector(extent, mesh.level).trixels;
  if (trixels.empty()) {
    throw globe::Error("--extent", "holds no trixel of level " + std::to_string(mesh.level),
                       "give a finer --level or a larger --extent");
  }
  mesh.origin = {0.5 * (extent.south + extent.north), 0.5 * (extent.west + extent.east), 0.0, false};
  const Frame frame(surface.ellipsoid(), mesh.origin);

  std::unordered_map<globe::planet::ivec3, std::uint32_t, KeyHash> known;
  std::vector<dvec3> positions;
  std::vector<glm::dvec2> places;  // degrees east of the extent's western side, and latitude
  const bool made_up = level.has_value() || !surface.has_data();
  const auto vertex = [&](const Node& node) {
    const auto [at, is_new] =
        known.try_emplace(globe::planet::octahedral_key(node), static_cast<std::uint32_t>(positions.size()));
    if (!is_new) return at->second;
    const dvec3 u = globe::planet::node_direction(node);
    const double height_m = made_up ? surface.height(node) : surface.data_height(node);
    positions.push_back(frame(globe::geo::ecef_from_normal(surface.ellipsoid(), u, height_m)));
    const Geodetic degrees = globe::geo::degrees_from_normal(u);
    const bool at_pole = std::abs(degrees.lat_deg) == 90.0;
    const double lon_deg = at_pole ? mesh.origin.lon_deg : degrees.lon_deg;
    double east = east_of(extent.west, lon_deg);
    if (east > 0.5 * (extent.east - extent.west) + 180.0) east -= 360.0;
    places.emplace_back(east, degrees.lat_deg);
    return at->second;
  };
  for (const LatticeTrixel& t : trixels) {
    for (const Node& node : {Node{t.d, t.level, t.i, t.j}, Node{t.d, t.level, t.i + t.sign, t.j},
                             Node{t.d, t.level, t.i, t.j + t.sign}})
      mesh.indices.push_back(vertex(node));
  }

  std::vector<dvec3> normals(positions.size(), dvec3(0.0));
  for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
    const std::uint32_t a = mesh.indices[k], b = mesh.indices[k + 1], c = mesh.indices[k + 2];
    const dvec3 area = glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
    for (const std::uint32_t corner : {a, b, c}) normals[corner] += area;
  }
  double west = places[0].x, east = west, south = places[0].y, north = south;
  for (const glm::dvec2& place : places) {
    west = std::min(west, place.x), east = std::max(east, place.x);
    south = std::min(south, place.y), north = std::max(north, place.y);
  }
  mesh.map.west_deg = extent.west + west;
  mesh.map.north_deg = north;
  mesh.map.step_x_deg = east - west;
  mesh.map.step_y_deg = north - south;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    mesh.positions.emplace_back(positions[k]);
    mesh.normals.emplace_back(glm::normalize(normals[k]));
    mesh.places.emplace_back((places[k].x - west) / mesh.map.step_x_deg,
                             (north - places[k].y) / mesh.map.step_y_deg);
  }
  return mesh;
}

}  // namespace converters
