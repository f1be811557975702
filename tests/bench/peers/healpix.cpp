#include <healpix_cxx/healpix_base.h>

#include <cmath>

#include "tests/bench/peers/peers.h"

namespace peers {
namespace {

const Healpix_Base2& grid() {
  static const Healpix_Base2 base(20, NEST);
  return base;
}

}  // namespace

void healpix_from_degrees(std::span<const double> lat_deg, std::span<const double> lon_deg, Ids ids) {
  constexpr double kRadians = M_PI / 180;
  for (std::size_t k = 0; k < ids.size(); ++k) {
    ids[k] = static_cast<std::uint64_t>(
        grid().ang2pix(pointing((90.0 - lat_deg[k]) * kRadians, lon_deg[k] * kRadians)));
  }
}

void healpix_from_vectors(std::span<const glm::dvec3> u, Ids ids) {
  for (std::size_t k = 0; k < ids.size(); ++k)
    ids[k] = static_cast<std::uint64_t>(grid().vec2pix(vec3(u[k].x, u[k].y, u[k].z)));
}

}  // namespace peers
