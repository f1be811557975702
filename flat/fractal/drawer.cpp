#include "flat/fractal/drawer.h"

#include <epoxy/gl.h>

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace globe::flat::fractal {

Drawer::Drawer(Terrain& terrain, const Look& look)
    : terrain_(terrain),
      look_(look),
      program_({{"flat/fractal.vert", "flat/fractal.frag"},
                {"POSTS_PER_SIDE " + std::to_string(terrain.pager().cells() + 1)},
                {}}),
      clip_(program_.uniform("clip_from_relative")),
      eye_post_(program_.uniform("eye_post")),
      eye_within_(program_.uniform("eye_within")),
      eye_height_(program_.uniform("eye_height")),
      spacing_(program_.uniform("spacing")),
      sun_(program_.uniform("to_sun")),
      sky_(program_.uniform("sky")),
      per_sight_(program_.uniform("per_sight")),
      relief_(program_.uniform("base_and_relief")),
      bands_(program_.uniform("bands")) {
  const Pager& pager = terrain.pager();
  std::vector<std::uint16_t> indices;
  for (int level = 0; level < kLevels; ++level) {
    for (unsigned edges = 0; edges < 16; ++edges) {
      if (edges != 0 && level == kLevels - 1) continue;
      const std::vector<std::uint16_t> triangles = block_triangles(pager.cells(), level, edges);
      meshes_[static_cast<std::size_t>(level)][edges] = {static_cast<unsigned>(triangles.size()),
                                                         static_cast<unsigned>(indices.size())};
      indices.insert(indices.end(), triangles.begin(), triangles.end());
    }
  }
  const auto blocks = static_cast<std::size_t>(pager.blocks()) * static_cast<std::size_t>(pager.blocks());
  const auto posts =
      static_cast<std::size_t>(pager.cells() + 1) * static_cast<std::size_t>(pager.cells() + 1);
  uploaded_.resize(blocks);
  block_vertices_.resize(posts);
  command_list_.reserve(blocks);
  corner_list_.reserve(blocks);
  indices_ = gl::Buffer::of(indices);
  vertices_ = gl::Buffer(blocks * posts * sizeof(Vertex));
  corners_ = gl::Buffer(blocks * sizeof(glm::ivec2));
  commands_ = gl::Buffer(blocks * sizeof(Command));
  array_ = gl::VertexArray::create();
  array_.set_indices(indices_);
  array_.set_vertices(0, vertices_, 0, sizeof(Vertex));
  array_.set_attribute(0, {.location = 0, .components = 3});
  array_.set_attribute(0, {.location = 2, .components = 3, .offset = offsetof(Vertex, one)});
  array_.set_attribute(0, {.location = 3, .components = 3, .offset = offsetof(Vertex, other)});
  array_.set_vertices(1, corners_, 0, sizeof(glm::ivec2), 1);
  array_.set_attribute(
      1, {.location = 1, .components = 2, .type = GL_INT, .kind = gl::Attribute::Kind::kInteger});
}

void Drawer::upload(int slot) {
  const Pager& pager = terrain_.pager();
  const int rim_posts = pager.posts_with_rim();
  const float* heights = pager.heights(slot).data();
  const auto per_two = static_cast<float>(0.5 / terrain_.spacing_m());
  Vertex* to = block_vertices_.data();
  for (int row = 1; row < rim_posts - 1; ++row) {
    for (int column = 1; column < rim_posts - 1; ++column) {
      const float* at = heights + row * rim_posts + column;
      (to++)->post = {at[0], (at[1] - at[-1]) * per_two, (at[rim_posts] - at[-rim_posts]) * per_two};
    }
  }
  const int side = pager.cells() + 1;
  to = block_vertices_.data();
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column, ++to) {
      to->one = to->other = to->post;
      if (last_level(column, row) == kLevels - 1) continue;
      const Ends ends = ends_of(column, row);
      const int away = ends.rows * side + ends.columns;
      to->one = to[away].post;
      to->other = to[-away].post;
    }
  }
  const std::size_t size = block_vertices_.size() * sizeof(Vertex);
  vertices_.upload(static_cast<std::size_t>(slot) * size, block_vertices_.data(), size);
}

Drawer::Stats Drawer::draw(const render::Camera& camera, const glm::dvec3& eye, double near_m,
                           const gl::Framebuffer& target) {
  Stats stats;
  const Pager& pager = terrain_.pager();
  terrain_.move_to({eye.x, eye.y});
  const glm::dmat4 clip = render::clip_from_relative(camera, near_m);
  command_list_.clear();
  corner_list_.clear();
  for (const BlockDraw& draw : terrain_.draws(clip, eye)) {
    std::optional<BlockKey>& uploaded = uploaded_[static_cast<std::size_t>(draw.slot)];
    if (uploaded != pager.block(draw.slot).key) {
      upload(draw.slot);
      uploaded = pager.block(draw.slot).key;
      stats.upload_bytes += block_vertices_.size() * sizeof(Vertex);
    }
    const Mesh& mesh = meshes_[static_cast<std::size_t>(draw.level)][draw.edges];
    command_list_.push_back({mesh.count, 1, mesh.first, draw.slot * static_cast<int>(block_vertices_.size()),
                             static_cast<unsigned>(command_list_.size())});
    corner_list_.emplace_back(draw.column * pager.cells(), draw.row * pager.cells());
    stats.triangles += mesh.count / 3;
  }
  stats.blocks = command_list_.size();
  stats.culling = terrain_.culling_counts();
  corners_.upload(0, std::span<const glm::ivec2>(corner_list_));
  commands_.upload(0, std::span<const Command>(command_list_));

  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glFrontFace(GL_CCW);
  target.bind();
  target.clear_color(look_.sky.r, look_.sky.g, look_.sky.b, 1.0f);
  target.clear_depth(0.0f);
  // The eye from the square's corner: whole posts, and the rest, small numbers both.
  const BlockKey first = pager.first();
  const glm::dvec2 whole(std::floor(eye.x), std::floor(eye.y));
  const glm::ivec2 eye_post(static_cast<int>(static_cast<std::int64_t>(whole.x) - first.x * pager.cells()),
                            static_cast<int>(static_cast<std::int64_t>(whole.y) - first.y * pager.cells()));
  const Settings& ground = terrain_.settings().ground;
  program_.set(clip_, glm::mat4(clip));
  program_.set(eye_post_, eye_post);
  program_.set(eye_within_, glm::vec2(glm::dvec2(eye.x, eye.y) - whole));
  program_.set(eye_height_, static_cast<float>(eye.z));
  program_.set(spacing_, static_cast<float>(terrain_.spacing_m()));
  program_.set(sun_, glm::normalize(look_.to_sun));
  program_.set(sky_, look_.sky);
  program_.set(per_sight_, look_.sight_m > 0 ? static_cast<float>(1.0 / look_.sight_m) : 0.0f);
  program_.set(relief_, glm::vec2(ground.base_m, ground.relief_m));
  const MorphBands& bands = terrain_.morph_bands();
  program_.set(bands_, glm::vec4(bands.begin[0], bands.end[0], bands.begin[1], bands.end[1]) *
                           static_cast<float>(pager.cells()));
  program_.use();
  array_.bind();
  commands_.bind(GL_DRAW_INDIRECT_BUFFER);
  if (look_.wireframe) glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, nullptr,
                              static_cast<GLsizei>(command_list_.size()), sizeof(Command));
  if (look_.wireframe) glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  return stats;
}

}  // namespace globe::flat::fractal
