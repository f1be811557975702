#include "globe/render/clipmap_textures.h"

#include <epoxy/gl.h>

#include <set>

namespace globe::render {
namespace {

constexpr int kFirstLayers = 24;  ///< a camera away from diamond edges needs one a level

gl::TexelBox box_of(const clipmap::NodeRect& rect, int layer) {
  return {rect.i0, rect.j0, rect.width(), rect.height(), layer};
}

void set_sampling(gl::Texture& texture, GLenum filter) {
  texture.set_filter(filter, filter);
  texture.set_wrap(GL_REPEAT);
}

}  // namespace

ClipmapTextures::ClipmapTextures(const clipmap::Settings& settings)
    : settings_(settings),
      positions_(gl::Texture::array(GL_RGBA32F, settings.window(), settings.window(), kFirstLayers)),
      coarse_(gl::Texture::array(GL_RGBA32F, settings.window(), settings.window(), kFirstLayers)),
      lit_(gl::Texture::array(GL_RGBA8, settings.shading_window(), settings.shading_window(), kFirstLayers)),
      water_(gl::Texture::array(GL_R8, settings.shading_window(), settings.shading_window(), kFirstLayers)) {
  for (int layer = kFirstLayers - 1; layer >= 0; --layer) free_.push_back(layer);
  set_sampling(positions_, GL_NEAREST);
  set_sampling(coarse_, GL_NEAREST);
  set_sampling(lit_, GL_LINEAR);
  set_sampling(water_, GL_LINEAR);
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
    for (const clipmap::VertexBlock& block : level.vertex_blocks) {
      const gl::TexelBox box = box_of(block.nodes, layer(l, block.d));
      positions_.upload_wrapped(box, block.position.data());
      coarse_.upload_wrapped(box, block.coarse.data());
    }
    for (const clipmap::ShadingBlock& block : level.shading_blocks) {
      const gl::TexelBox box = box_of(block.nodes, layer(l, block.d));
      lit_.upload_wrapped(box, block.lit.data());
      water_.upload_wrapped(box, block.water.data());
    }
  }
  return update.upload_bytes();
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
  for (gl::Texture* texture : {&positions_, &coarse_, &lit_, &water_}) *texture = texture->grown(2 * before);
  set_sampling(positions_, GL_NEAREST);
  set_sampling(coarse_, GL_NEAREST);
  set_sampling(lit_, GL_LINEAR);
  set_sampling(water_, GL_LINEAR);
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

std::size_t ClipmapTextures::layer_bytes() const {
  const auto w = static_cast<std::size_t>(settings_.window());
  const auto shading = static_cast<std::size_t>(settings_.shading_window());
  return 32 * w * w + 5 * shading * shading;
}

}  // namespace globe::render
