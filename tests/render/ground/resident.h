#pragma once

#include <algorithm>
#include <vector>

#include "globe/clipmap/stream.h"
#include "globe/render/clipmap_textures.h"

namespace views {

/// Texels of rectangles of a toroidal layer, in the order of the nodes.
template <class T>
std::vector<T> resident(const globe::gl::Texture& texture, const globe::clipmap::Torus& torus,
                        const std::vector<globe::clipmap::NodeRect>& rects, int layer) {
  const auto all = texture.read<T>({0, 0, texture.width(), texture.height(), layer});
  std::vector<T> texels;
  for (const globe::clipmap::NodeRect& rect : rects) {
    for (int j = rect.j0; j <= rect.j1; ++j) {
      for (int i = rect.i0; i <= rect.i1; ++i) {
        const glm::ivec2 at = torus.texel(i, j);
        texels.push_back(all[static_cast<std::size_t>(at.y) * static_cast<std::size_t>(texture.width()) +
                             static_cast<std::size_t>(at.x)]);
      }
    }
  }
  return texels;
}

/// Everything that a state needs of the textures, as far as they have layers for it.
struct Resident {
  std::vector<glm::vec4> vertices;  ///< positions and coarse positions, or knots
  std::vector<float> heights;       ///< where positions are interpolated
  std::vector<glm::u8vec4> lit;
  std::vector<std::uint8_t> water;

  std::size_t size() const { return vertices.size() + heights.size() + lit.size() + water.size(); }
  /// Texels that differ.
  std::size_t differing(const Resident& other) const {
    const auto count = [](const auto& a, const auto& b) {
      std::size_t different = a.size() == b.size() ? 0 : std::max(a.size(), b.size());
      for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) different += a[k] == b[k] ? 0 : 1;
      return different;
    };
    return count(vertices, other.vertices) + count(heights, other.heights) + count(lit, other.lit) +
           count(water, other.water);
  }
};

inline Resident resident(const globe::clipmap::Settings& settings, const globe::clipmap::ClipmapState& state,
                         const globe::render::ClipmapTextures& textures) {
  using globe::clipmap::Torus;
  Resident all;
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  for (const auto& level : state.levels) {
    for (int d = 0; d < globe::planet::kDiamonds; ++d) {
      const auto k = static_cast<std::size_t>(d);
      if (level->vertices[k].empty()) continue;
      const int v = textures.vertex_layer(level->region.level, d);
      const int s = textures.shading_layer(level->region.level, d);
      if (v < 0) continue;
      const Torus torus = settings.vertex_torus();
      const Torus shading = Torus::square(settings.shading_window());
      const std::vector<globe::clipmap::NodeRect>& nodes = level->footprint[k];
      if (globe::clipmap::is_interpolated(settings.positions)) {
        const int step = settings.knot_step();
        const globe::clipmap::NodeRect& all_nodes = level->vertices[k];
        append(all.heights, resident<float>(textures.positions(), torus, nodes, v));
        for (const int kind : {0, 1}) {
          append(all.vertices, resident<glm::vec4>(textures.coarse(), Torus::square(settings.window() / step),
                                                   {{all_nodes.i0 / step, all_nodes.i1 / step,
                                                     all_nodes.j0 / step, all_nodes.j1 / step}},
                                                   2 * v + kind));
        }
      } else {
        append(all.vertices, resident<glm::vec4>(textures.positions(), torus, nodes, v));
        append(all.vertices, resident<glm::vec4>(textures.coarse(), torus, nodes, v));
      }
      append(all.lit, resident<glm::u8vec4>(textures.lit(), shading, {level->shading[k]}, s));
      append(all.water, resident<std::uint8_t>(textures.water(), shading, {level->shading[k]}, s));
    }
  }
  return all;
}

}  // namespace views
