#pragma once

#include <optional>

#include "app/view/session.h"

namespace app::view {

/// Runs a window until a person closes it, or after so many frames. It draws when something moves, loads or
/// is looked at, and sleeps otherwise.
/// @return how many frames were drawn
std::size_t run_window(Session& session, std::optional<int> frames);

}  // namespace app::view
