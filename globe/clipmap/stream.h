#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "globe/clipmap/level_data.h"
#include "globe/clipmap/settings.h"

namespace globe::clipmap {

/// Where the clipmap is wanted: under which normal, down to which level, and in what light.
struct Target {
  dvec3 u{0.0, 0.0, 1.0};
  int finest = 0;
  Lighting lighting{};
};

/// A whole clipmap, base level first. Levels up to target.finest belong to the target's nadir, so the mesh
/// they make is closed; finer ones, if any, are kept for later.
struct ClipmapState {
  Target target;
  std::vector<std::shared_ptr<const LevelData>> levels;

  int base_level() const { return levels.front()->region.level; }
  int finest_level() const { return levels.back()->region.level; }
};

/// A new state and the uploads that lead to it from the state before, level by level.
struct StateUpdate {
  std::shared_ptr<const ClipmapState> state;
  std::vector<LevelUpdate> levels;

  std::size_t upload_bytes() const;
};

/// How much of a target one call of advance does: all of it, or so much that a long way is gone in steps,
/// coarse levels first.
enum class Stride { kWhole, kStep };

/// Computes the state for a target from the state before (null: nothing). Levels whose region stays are kept
/// as they are, levels finer than the target's as long as they belong to its nadir. Levels are independent of
/// each other and computed on all cores. A step stops at the level at which as much work was done as `fills`
/// levels take that are filled from nothing; its state then is coarser than the target. Levels that only the
/// light has left behind stay as they are once a step has lit a few of them anew.
StateUpdate advance(const Settings& settings, const planet::Surface& surface, const Target& target,
                    const ClipmapState* before, Stride stride, int fills = 2);

/// Makes all the ground that a base level is shaded by, for the surface to hold, on all cores: for the time
/// before there is anything to draw with. Nothing where the surface's cache would not hold it.
void make_base_ground(const Settings& settings, const planet::Surface& surface);

/// Levels of a state, from its base on, whose regions are the right ones for a nadir. Regions move only when
/// the nadir comes closer to another node of their lattice.
int levels_in_place(const Settings& settings, const ClipmapState& state, const dvec3& u);

/// The same of the levels up to target.finest that are also lit as asked.
int levels_ready(const Settings& settings, const ClipmapState& state, const Target& target);

/// True when nothing that the target asks for is missing.
bool still_holds(const Settings& settings, const ClipmapState& state, const Target& target);

/// Computes states on a thread of its own, so that the thread that draws never waits.
///
/// The drawing thread asks for the newest target every frame and takes what is finished; until then it goes
/// on with the state it has, whose mesh is closed wherever the camera is. While a result is being uploaded
/// the next one is computed from it.
class Stream {
 public:
  Stream(Settings settings, std::shared_ptr<const planet::Surface> surface);
  ~Stream();
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  /// Asks for a target; an older one that was not begun is forgotten. `before` is the state the result will
  /// be applied to; nothing happens while a result waits to be taken or is being computed.
  void request(const Target& target, std::shared_ptr<const ClipmapState> before);

  /// The finished update, once.
  std::optional<StateUpdate> take();

  /// Forgets what was asked for, is being computed or waits to be taken.
  void forget();

  /// True when a request would be heard.
  bool is_idle() const;

  /// Levels asked for and not finished.
  int pending() const;

  /// Returns when nothing is being computed: for tests and benchmarks, which want no race.
  void await() const;

 private:
  void work(const std::stop_token& stop);

  struct Job {
    Target target;
    std::shared_ptr<const ClipmapState> before;
  };

  Settings settings_;
  std::shared_ptr<const planet::Surface> surface_;
  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  mutable std::condition_variable done_;
  std::optional<Job> job_;
  bool busy_ = false;
  bool unwanted_ = false;  ///< what is being computed was forgotten meanwhile
  std::optional<StateUpdate> result_;
  std::exception_ptr failure_;
  std::jthread thread_;  ///< last: stops before what it uses is gone
};

}  // namespace globe::clipmap
