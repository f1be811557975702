#include "globe/render/clipmap_textures.h"

#include <epoxy/gl.h>

#include <set>

namespace globe::render {
namespace {

constexpr int kFirstLayers = 24;  ///< a camera away from diamond edges needs one a level

gl::TexelBox box_of(const clipmap::NodeRect& rect, int layer) {
  return {rect.i0, rect.j0, rect.width(), rect.height(), layer};
}

}  // namespace

ClipmapTextures::ClipmapTextures(const clipmap::Settings& settings) : settings_(settings) {
  const int w = settings.window();
  const int shading = settings.shading_window();
  if (clipmap::is_interpolated(settings.positions)) {
    const int knots = w / settings.knot_step();
    positions_ = gl::Texture::array(GL_R32F, w, w, kFirstLayers);
    coarse_ = gl::Texture::array(GL_RGBA32F, knots, knots, 2 * kFirstLayers);
  } else {
    positions_ = gl::Texture::array(GL_RGBA32F, w, w, kFirstLayers);
    coarse_ = gl::Texture::array(GL_RGBA32F, w, w, kFirstLayers);
  }
  lit_ = gl::Texture::array(GL_RGBA8, shading, shading, kFirstLayers);
  water_ = gl::Texture::array(GL_R8, shading, shading, kFirstLayers);
  for (int layer = kFirstLayers - 1; layer >= 0; --layer) free_.push_back(layer);
  set_sampling();
}

void ClipmapTextures::set_sampling() {
  for (gl::Texture* texture : {&positions_, &coarse_, &lit_, &water_}) texture->set_wrap(GL_REPEAT);
  for (gl::Texture* texture : {&positions_, &coarse_}) texture->set_filter(GL_NEAREST, GL_NEAREST);
  for (gl::Texture* texture : {&lit_, &water_}) texture->set_filter(GL_LINEAR, GL_LINEAR);
}

std::size_t ClipmapTextures::apply(const clipmap::StateUpdate& update) {
  std::set<std::pair<int, int>> wanted;
  for (const auto& level : update.state->levels) {
    for (int d = 0; d < planet::kDiamonds; ++d) {
      if (!level->vertices[static_cast<std::size_t>(d)].empty()) wanted.insert({level->region.level, d});
    }
  }
  for (auto at = used_.begin(); at != used_.end();) {
    if (wanted.contains(at->first)) {
      ++at;
      continue;
    }
    free_.push_back(at->second);
    at = used_.erase(at);
  }
  for (const auto& [level, d] : wanted) acquire(level, d);
  for (const clipmap::LevelUpdate& level : update.levels) {
    const int l = level.data->region.level;
    for (const clipmap::VertexBlock& block : level.vertex_blocks) upload(block, layer(l, block.d));
    for (const clipmap::ShadingBlock& block : level.shading_blocks) {
      const gl::TexelBox box = box_of(block.nodes, layer(l, block.d));
      lit_.upload_wrapped(box, block.lit.data());
      water_.upload_wrapped(box, block.water.data());
    }
  }
  return update.upload_bytes();
}

void ClipmapTextures::upload(const clipmap::VertexBlock& block, int layer) {
  const gl::TexelBox box = box_of(block.nodes, layer);
  if (clipmap::is_interpolated(settings_.positions)) {
    positions_.upload_wrapped(box, block.height.data());
    coarse_.upload_wrapped(box_of(block.knots.knots, 2 * layer), block.knots.surface.data());
    coarse_.upload_wrapped(box_of(block.knots.knots, 2 * layer + 1), block.knots.normal.data());
  } else {
    positions_.upload_wrapped(box, block.position.data());
    coarse_.upload_wrapped(box, block.coarse.data());
  }
}

int ClipmapTextures::layer(int level, int d) const {
  const auto found = used_.find({level, d});
  return found == used_.end() ? -1 : found->second;
}

int ClipmapTextures::acquire(int level, int d) {
  if (const auto found = used_.find({level, d}); found != used_.end()) return found->second;
  if (free_.empty()) grow();
  const int layer = free_.back();
  free_.pop_back();
  used_[{level, d}] = layer;
  return layer;
}

void ClipmapTextures::grow() {
  const int before = positions_.layers();
  for (gl::Texture* texture : {&positions_, &coarse_, &lit_, &water_})
    *texture = texture->grown(2 * texture->layers());
  set_sampling();
  for (int layer = 2 * before - 1; layer >= before; --layer) free_.push_back(layer);
}

void ClipmapTextures::bind() const {
  positions_.bind(0);
  coarse_.bind(1);
  lit_.bind(2);
  water_.bind(3);
}

std::size_t ClipmapTextures::bytes() const {
  return positions_.bytes() + coarse_.bytes() + lit_.bytes() + water_.bytes();
}

std::size_t ClipmapTextures::layer_bytes() const { return bytes() / static_cast<std::size_t>(layers()); }

std::vector<std::string> ClipmapTextures::defines() const {
  if (!clipmap::is_interpolated(settings_.positions)) return {};
  return {"KNOTS_A_PATCH " + std::to_string(settings_.m / settings_.knot_step()),
          "KNOT_STEP " + std::to_string(settings_.knot_step())};
}

}  // namespace globe::render
