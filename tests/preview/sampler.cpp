#include "sampler.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace globe::preview {

const Sampler::Shaded& Sampler::shaded(const planet::TileId& id) {
  const std::uint64_t key = static_cast<std::uint64_t>(id.d) << 62 |
                            static_cast<std::uint64_t>(id.level) << 56 |
                            static_cast<std::uint64_t>(id.ti) << 28 | static_cast<std::uint64_t>(id.tj);
  const auto [at, fresh] = known_.try_emplace(key);
  Shaded& shaded = at->second;
  if (!fresh) return shaded;
  shaded.tile = surface_->tile(id);
  const planet::TileValues<dvec3> u = planet::node_directions(id);
  const std::size_t count = shaded.tile->height.values.size();
  shaded.albedo.resize(count);
  shaded.normal.resize(count);
  const bool sea = surface_->has_sea();
  for (int j = id.first_j(); j <= id.first_j() + id.cells(); ++j) {
    for (int i = id.first_i(); i <= id.first_i() + id.cells(); ++i) {
      const planet::GroundSlope s = planet::slope_at(*surface_, *shaded.tile, u, i, j);
      const std::size_t k = shaded.tile->height.index(i, j);
      const planet::Ground ground = planet::ground_at(*surface_, *shaded.tile, u, i, j);
      shaded.albedo[k] = planet::albedo(ground);
      const bool flat = sea && ground.height_m < 0.0;
      shaded.normal[k] = flat ? vec3(u.at(i, j)) : vec3(glm::normalize(u.at(i, j) - s.gradient));
    }
  }
  return shaded;
}

Sample Sampler::at(const dvec3& u, int level) {
  const planet::Place place = planet::locate(u, level);
  const int n = planet::nodes_per_side(level);
  const int i = std::min(static_cast<int>(place.ij.x), n - 1);
  const int j = std::min(static_cast<int>(place.ij.y), n - 1);
  const Shaded& s = shaded(planet::tile_of({place.d, level, i, j}));
  const double x = place.ij.x - i;
  const double y = place.ij.y - j;
  const bool lower = x + y <= 1.0;
  const std::array<std::size_t, 3> k{s.tile->height.index(lower ? i : i + 1, lower ? j : j + 1),
                                     s.tile->height.index(i + 1, j), s.tile->height.index(i, j + 1)};
  const std::array<double, 3> w{lower ? 1.0 - x - y : x + y - 1.0, lower ? x : 1.0 - y, lower ? y : 1.0 - x};
  Sample r;
  for (std::size_t c = 0; c < 3; ++c) {
    r.height_m += w[c] * s.tile->height.values[k[c]];
    r.albedo += static_cast<float>(w[c]) * s.albedo[k[c]];
    r.normal += static_cast<float>(w[c]) * s.normal[k[c]];
  }
  r.normal = glm::normalize(r.normal);
  if (surface_->has_sea() && r.height_m < 0.0) {
    r.height_m = 0.0;
    r.water = true;
  }
  return r;
}

}  // namespace globe::preview
