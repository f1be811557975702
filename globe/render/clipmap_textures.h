#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "globe/clipmap/stream.h"
#include "globe/render/layer_pool.h"
#include "globe/render/upload_queue.h"

namespace globe::render {

/// The GPU side of the windows: toroidal layers of vertices (position, coarse position) and of shading (lit
/// ground, water) for each (level, diamond) in use.
///
/// Bytes of a layer of vertices: 2 · 16 w², of shading: 5 (w·2^k)²; w the side of the vertex window and k the
/// shading levels. Where positions are interpolated there are heights and knots in place of positions, 4 w² +
/// 2 · 16 (w/q)² bytes, q being the cells between knots. Hexagons of positions take 2 · 16 (3S + 1)(S + 1)
/// bytes, S = s + 3m/2 - 1. Layers come from pools that grow when they are empty.
///
/// One state is drawn while the next one is loading: its uploads may take any number of frames, and touch no
/// texel that the drawn one needs. What came in goes beside what is there where the torus has room for both
/// (a step of the window's centre), else into a layer of its own: after a jump, around a new anchor, in a new
/// light.
class ClipmapTextures {
 public:
  explicit ClipmapTextures(const clipmap::Settings& settings,
                           UploadQueue::Clock clock = UploadQueue::steady_milliseconds);

  /// Begins to load the state that an update leads to from the drawn one. REQUIRES: nothing is loading.
  void begin(clipmap::StateUpdate update);
  /// Uploads for about `ms` milliseconds, at least a little; returns the bytes that left this computer's
  /// memory.
  std::size_t upload(double ms);
  /// The state that is loading; null when none is.
  std::shared_ptr<const clipmap::ClipmapState> loading() const {
    return loading_ ? loading_->update.state : nullptr;
  }
  /// True when all of what is loading is in.
  bool is_loaded() const { return loading_ && queue_.empty(); }
  /// What is loaded is drawn from now on; returns its state and frees what it does not need.
  std::shared_ptr<const clipmap::ClipmapState> swap();
  /// Forgets what is loading.
  void abandon();

  /// All of it at once, into the layers of the drawn state, which is not drawn any more. Returns the bytes
  /// uploaded.
  std::size_t apply(clipmap::StateUpdate update);

  /// Layers of a drawn level's share of a diamond; -1 when nothing of it is resident.
  int vertex_layer(int level, int d) const;
  int shading_layer(int level, int d) const;

  /// Binds positions, coarse positions, lit ground and water to units 0 to 3; heights and knots in place of
  /// the first two where positions are interpolated.
  void bind() const;

  /// Defines for the vertex shader that reads these textures.
  std::vector<std::string> defines() const;

  const gl::Texture& positions() const { return vertices_.texture(0); }
  const gl::Texture& coarse() const { return vertices_.texture(1); }
  const gl::Texture& lit() const { return shading_.texture(0); }
  const gl::Texture& water() const { return shading_.texture(1); }

  std::size_t bytes() const { return vertices_.bytes() + shading_.bytes(); }
  /// Of a layer of vertices and one of shading.
  std::size_t layer_bytes() const { return vertices_.layer_bytes() + shading_.layer_bytes(); }
  int vertex_layers() const { return vertices_.layers(); }
  int shading_layers() const { return shading_.layers(); }
  /// Jobs and bytes that wait.
  std::size_t queued_jobs() const { return queue_.size(); }
  std::size_t queued_bytes() const { return queue_.bytes(); }

 private:
  struct Layers {
    int vertices = -1;
    int shading = -1;
  };
  using Share = std::pair<int, int>;  ///< level, diamond
  struct Loading {
    clipmap::StateUpdate update;
    std::map<Share, Layers> layers;
    bool beside_drawn;  ///< what the drawn state needs is left alone
  };

  void begin(clipmap::StateUpdate update, bool beside_drawn);
  const clipmap::LevelData* drawn_level(int level) const;
  /// Which layers of the drawn state the new one goes on with.
  Layers kept_layers(const clipmap::LevelData& next, int d) const;
  void assign_layers();
  void release_unused();
  void queue_copies();
  void copy_vertices(int layer, int from_layer, const clipmap::NodeRect& nodes);
  void copy_shading(int layer, int from_layer, const clipmap::NodeRect& nodes);
  void queue_blocks();
  void perform(const UploadJob& job);

  clipmap::Settings settings_;
  LayerPool vertices_, shading_;
  UploadQueue queue_;
  std::shared_ptr<const clipmap::ClipmapState> drawn_;
  std::map<Share, Layers> layers_;  ///< of the drawn state
  std::optional<Loading> loading_;
};

}  // namespace globe::render
