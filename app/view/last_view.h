#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/standing_camera.h"

namespace app::view {

/// How a window was left.
struct LastView {
  Standpoint stand;
  double moment_s = 0;
  std::string time, overhead;  ///< of the sun: at most one is not empty
};

/// Where views are remembered: $XDG_STATE_HOME/globe/views.json, by default under ~/.local/state; nothing
/// where there is no home.
std::optional<std::filesystem::path> views_file();

/// How the window of that name was left; nothing when it never was, or the file says nothing that makes
/// sense.
std::optional<LastView> recall_view(const std::filesystem::path& file, const std::string& name);

/// Remembers it, with the others of the file. Throws globe::Error when it cannot be written.
void remember_view(const std::filesystem::path& file, const std::string& name, const LastView& view);

}  // namespace app::view
