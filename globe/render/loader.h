#pragma once

#include <memory>

#include "globe/clipmap/stream.h"
#include "globe/planet/surface.h"
#include "globe/render/clipmap_textures.h"
#include "globe/render/forecast.h"

namespace globe::render {

/// Brings the clipmap to where the camera wants it: computed by threads of its own, uploaded over as many
/// frames as it takes, drawn when all of it is there.
///
/// A state is drawn, the next one is being uploaded, and the one after it computed meanwhile. What the camera
/// will want in a few frames, by its motion, is loaded ahead and waits for it.
class Loader {
 public:
  /// @param max_level  finest level of triangles
  /// @param ahead      false: only what is wanted now is loaded
  Loader(const clipmap::Settings& settings, std::shared_ptr<const planet::Surface> surface, int max_level,
         bool ahead);

  struct Uploaded {
    std::size_t bytes = 0;
    double ms = 0;  ///< that it took this thread
  };

  /// All that the target asks for, at once.
  Uploaded load_whole(const clipmap::Target& target);

  /// One frame of a camera that does not wait: about `ms` milliseconds of uploads.
  /// REQUIRES: load_whole() was called once.
  Uploaded load_some(const clipmap::Target& target, double height_m, double ms);

  /// What is to be drawn: levels up to its target's finest one. Null before anything was loaded.
  const std::shared_ptr<const clipmap::ClipmapState>& state() const { return state_; }
  const ClipmapTextures& textures() const { return textures_; }

  /// Levels being computed, and uploads that wait.
  int queued_jobs() const;
  bool is_computing() const { return stream_ != nullptr && stream_->pending() > 0; }
  /// Returns when nothing is being computed: for tests and benchmarks, which want no race.
  void await_computing() const;

 private:
  /// Draws what is loaded from now on, if it is better for the target; forgets it if it will never be.
  bool swap_if_due(const clipmap::Target& target);
  /// Moves the drawn state's nadir along where all of its levels stay the right ones.
  void follow(const clipmap::Target& target);
  void ask(const clipmap::Target& target);
  /// What will be wanted in so many frames.
  clipmap::Target target_in(int frames, const clipmap::Target& now) const;
  /// Frames to look ahead, from how long loading takes on.
  template <class Visit>
  bool any_horizon(const Visit& visit) const;

  clipmap::Settings settings_;
  std::shared_ptr<const planet::Surface> surface_;
  int max_level_;
  bool ahead_;
  ClipmapTextures textures_;
  std::shared_ptr<const clipmap::ClipmapState> state_;
  Forecast forecast_;
  int frame_ = 0;
  int asked_at_ = 0;                         ///< frame
  int loading_asked_at_ = 0;                 ///< the frame that asked for what is loading
  bool arrival_noted_ = false;               ///< of what is loading
  double latency_frames_ = 3.0;              ///< from asking to having it loaded, of late
  std::unique_ptr<clipmap::Stream> stream_;  ///< made by the first frame that does not wait
};

}  // namespace globe::render
