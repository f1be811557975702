#pragma once

#include <cstddef>
#include <optional>

#include "app/view/session.h"

namespace app::view {

struct WindowRun {
  std::size_t frames = 0;        ///< drawn after the first picture
  double first_picture_s = 0.0;  ///< from the program's start until it was shown
};

/// Runs a window until a person closes it, or after so many frames. It draws when something moves, loads or
/// is looked at, and sleeps otherwise.
WindowRun run_window(Session& session, std::optional<int> frames);

}  // namespace app::view
