#pragma once

#include <optional>
#include <vector>

#include "globe/clipmap/torus.h"
#include "globe/gl/texture.h"

namespace globe::render {

/// Layers of toroidal windows in array textures that go together, lent one by one.
///
/// When more are wanted than there are, larger arrays are made beside the ones in use; everything from then
/// on is written to them, and they take over with finish_growth(). Until then the ones in use stay what they
/// are.
class LayerPool {
 public:
  /// One of the array textures.
  struct Plane {
    GLenum format;
    clipmap::Torus torus;
    int each = 1;  ///< layers of the texture for a layer of the pool
  };

  /// @param filter  GL_NEAREST or GL_LINEAR
  LayerPool(std::vector<Plane> planes, GLenum filter, int layers);

  int acquire();  ///< a layer; REQUIRES: reserve()d
  void release(int layer) { free_.push_back(layer); }
  int free_layers() const { return static_cast<int>(free_.size()); }

  /// Sees to it that `count` layers are free. Returns true when that began growth: grow() then has to be
  /// called for every plane, and what lies in layers in use to be copied (copy_from_current).
  bool reserve(int count);
  /// Makes the next plane's larger array.
  void grow();
  /// Bytes of one texel of it in all of its layers.
  std::size_t grown_texel_bytes(std::size_t plane) const;
  bool is_growing() const { return grown_layers_ > 0; }
  void finish_growth();
  void abandon_growth();

  /// Writes a rectangle of a plane's layer, the `which`-th of each.
  ///
  /// @param texels      of the plane's format
  /// @param row_length  texels from a row of them to the next
  void upload(std::size_t plane, int layer, int which, const clipmap::NodeRect& nodes, const void* texels,
              int row_length);
  /// Writes a rectangle of a plane's layer from a layer of the arrays in use.
  void copy_from_current(std::size_t plane, int layer, int from_layer, const clipmap::NodeRect& nodes);

  /// The textures in use.
  const gl::Texture& texture(std::size_t plane) const { return current_[plane]; }
  std::size_t planes() const { return planes_.size(); }
  const clipmap::Torus& torus(std::size_t plane) const { return planes_[plane].torus; }
  int layers() const { return layers_; }
  /// Of all textures, those of a growth included.
  std::size_t bytes() const;
  std::size_t layer_bytes() const;

 private:
  gl::Texture make(const Plane& plane, int layers) const;
  std::vector<gl::Texture>& written() { return is_growing() ? grown_ : current_; }

  std::vector<Plane> planes_;
  GLenum filter_;
  int layers_;
  std::vector<gl::Texture> current_;  ///< by plane
  std::vector<gl::Texture> grown_;    ///< as far as they are made
  int grown_layers_ = 0;              ///< of each; 0 unless growing
  std::vector<int> free_;
};

}  // namespace globe::render
