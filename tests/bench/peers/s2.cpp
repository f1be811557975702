#include <s2/s2cell.h>
#include <s2/s2cell_id.h>
#include <s2/s2latlng.h>

#include "tests/bench/peers/peers.h"

namespace peers {

void s2_from_degrees(std::span<const double> lat_deg, std::span<const double> lon_deg, Ids ids) {
  for (std::size_t k = 0; k < ids.size(); ++k)
    ids[k] = S2CellId(S2LatLng::FromDegrees(lat_deg[k], lon_deg[k])).id();
}

void s2_from_vectors(std::span<const glm::dvec3> u, Ids ids) {
  for (std::size_t k = 0; k < ids.size(); ++k) ids[k] = S2CellId(S2Point(u[k].x, u[k].y, u[k].z)).id();
}

void s2_parents(int level, Ids ids) {
  for (std::uint64_t& id : ids) id = S2CellId(id).parent(level).id();
}

double s2_corners(std::span<const std::uint64_t> ids) {
  double sum = 0;
  for (const std::uint64_t id : ids) {
    const S2Cell cell{S2CellId(id)};
    for (int k = 0; k < 4; ++k) sum += cell.GetVertex(k).x();
  }
  return sum;
}

std::uint64_t s2_neighbors(std::span<const std::uint64_t> ids) {
  std::uint64_t sum = 0;
  for (const std::uint64_t id : ids) {
    S2CellId neighbors[4];
    S2CellId(id).GetEdgeNeighbors(neighbors);
    for (const S2CellId& neighbor : neighbors) sum += neighbor.id();
  }
  return sum;
}

}  // namespace peers
