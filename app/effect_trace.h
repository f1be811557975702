#pragma once

#include <string>
#include <vector>

#include "globe/geo/ellipsoid.h"
#include "globe/render/globe_renderer.h"

namespace app {

/// When each effect of a flight became active and why: `fly --trace`.
class EffectTrace {
 public:
  /// Where the camera is in a frame.
  struct Moment {
    int frame = 0;
    double time_s = 0;
    globe::geo::Geodetic place;
    double above_ground_m = 0;
  };

  /// Notes what has changed since the frame before; of the first frame everything.
  void add(const Moment& moment, const std::vector<globe::render::EffectState>& states);

  /// Writes the JSON file (keys in COMMANDS.md), whole or not at all. Throws globe::Error.
  void write(const std::string& path) const;

 private:
  struct Event {
    Moment moment;
    globe::render::EffectState state;
  };

  int frames_ = 0;
  std::vector<globe::render::EffectState> last_;
  std::vector<int> active_frames_;  ///< of each effect
  std::vector<Event> events_;
};

}  // namespace app
