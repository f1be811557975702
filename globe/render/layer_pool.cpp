#include "globe/render/layer_pool.h"

#include <cassert>
#include <cstddef>
#include <utility>

namespace globe::render {
namespace {

constexpr int kGrowth = 4;  ///< layers: arrays grow by multiples of it

gl::TexelBox box_of(const clipmap::Torus::Piece& piece, int layer) {
  return {piece.x, piece.y, piece.nodes.width(), piece.nodes.height(), layer};
}

std::size_t bytes_of(const std::vector<gl::Texture>& textures) {
  std::size_t sum = 0;
  for (const gl::Texture& texture : textures) sum += texture.bytes();
  return sum;
}

}  // namespace

LayerPool::LayerPool(std::vector<Plane> planes, GLenum filter, int layers)
    : planes_(std::move(planes)), filter_(filter), layers_(layers) {
  for (const Plane& plane : planes_) current_.push_back(make(plane, layers));
  for (int layer = layers - 1; layer >= 0; --layer) free_.push_back(layer);
}

gl::Texture LayerPool::make(const Plane& plane, int layers) const {
  gl::Texture texture =
      gl::Texture::array(plane.format, plane.torus.width, plane.torus.height, plane.each * layers);
  texture.set_filter(filter_, filter_);
  texture.set_wrap(GL_REPEAT);
  return texture;
}

int LayerPool::acquire() {
  assert(!free_.empty());
  const int layer = free_.back();
  free_.pop_back();
  return layer;
}

bool LayerPool::reserve(int count) {
  const int missing = count - free_layers();
  if (missing <= 0) return false;
  assert(!is_growing());
  grown_layers_ = layers_ + (missing + kGrowth - 1) / kGrowth * kGrowth;
  for (int layer = grown_layers_ - 1; layer >= layers_; --layer) free_.insert(free_.begin(), layer);
  return true;
}

void LayerPool::grow() { grown_.push_back(make(planes_[grown_.size()], grown_layers_)); }

std::size_t LayerPool::grown_texel_bytes(std::size_t plane) const {
  return static_cast<std::size_t>(grown_layers_ * planes_[plane].each) *
         gl::pixel_layout(planes_[plane].format).bytes_per_texel;
}

void LayerPool::finish_growth() {
  if (!is_growing()) return;
  assert(grown_.size() == planes_.size());
  current_ = std::exchange(grown_, {});
  layers_ = std::exchange(grown_layers_, 0);
}

void LayerPool::abandon_growth() {
  grown_.clear();
  grown_layers_ = 0;
  std::erase_if(free_, [&](int layer) { return layer >= layers_; });
}

void LayerPool::upload(std::size_t plane, int layer, int which, const clipmap::NodeRect& nodes,
                       const void* texels, int row_length) {
  const std::size_t row_bytes =
      static_cast<std::size_t>(row_length) * gl::pixel_layout(planes_[plane].format).bytes_per_texel;
  for (const clipmap::Torus::Piece& piece : planes_[plane].torus.pieces(nodes)) {
    const auto rows = static_cast<std::size_t>(piece.nodes.j0 - nodes.j0);
    written()[plane].upload_wrapped(box_of(piece, planes_[plane].each * layer + which),
                                    static_cast<const std::byte*>(texels) + rows * row_bytes, row_length);
  }
}

void LayerPool::copy_from_current(std::size_t plane, int layer, int from_layer,
                                  const clipmap::NodeRect& nodes) {
  const int each = planes_[plane].each;
  for (const clipmap::Torus::Piece& piece : planes_[plane].torus.pieces(nodes)) {
    for (int which = 0; which < each; ++which) {
      written()[plane].copy_wrapped(current_[plane], each * from_layer + which,
                                    box_of(piece, each * layer + which));
    }
  }
}

std::size_t LayerPool::bytes() const { return bytes_of(current_) + bytes_of(grown_); }

std::size_t LayerPool::layer_bytes() const { return bytes_of(current_) / static_cast<std::size_t>(layers_); }

}  // namespace globe::render
