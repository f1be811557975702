#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "globe/clipmap/stream.h"
#include "globe/gl/texture.h"

namespace globe::render {

/// The GPU side of the windows: four array textures of one toroidal layer for each (level, diamond) in use.
///
/// Bytes of a layer: 2 · 16 w² + 5 (w·2^k)², w the side of the vertex window and k the shading levels. Where
/// positions are interpolated 4 w² + 2 · 16 (w/q)² + 5 (w·2^k)², q being the cells between knots. Layers come
/// from a pool that doubles when it is full.
class ClipmapTextures {
 public:
  explicit ClipmapTextures(const clipmap::Settings& settings);

  /// Uploads what an update brings and gives free what its state no longer needs. Returns the bytes uploaded.
  std::size_t apply(const clipmap::StateUpdate& update);

  /// Layer of a level's share of a diamond; -1 when nothing of it is resident.
  int layer(int level, int d) const;

  /// Binds positions, coarse positions, lit ground and water to units 0 to 3; heights and knots in place of
  /// the first two where positions are interpolated.
  void bind() const;

  /// Defines for the vertex shader that reads these textures.
  std::vector<std::string> defines() const;

  const gl::Texture& positions() const { return positions_; }
  const gl::Texture& coarse() const { return coarse_; }
  const gl::Texture& lit() const { return lit_; }
  const gl::Texture& water() const { return water_; }

  std::size_t bytes() const;
  std::size_t layer_bytes() const;
  int layers() const { return positions_.layers(); }

 private:
  int acquire(int level, int d);
  void grow();
  void set_sampling();
  void upload(const clipmap::VertexBlock& block, int layer);

  clipmap::Settings settings_;
  gl::Texture positions_;  ///< heights, where positions are interpolated
  gl::Texture coarse_;     ///< there the knots, two layers a layer: surface and normals
  gl::Texture lit_, water_;
  std::map<std::pair<int, int>, int> used_;  ///< (level, diamond) -> layer
  std::vector<int> free_;
};

}  // namespace globe::render
