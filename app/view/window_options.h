#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "app/standing_camera.h"
#include "app/view/last_view.h"
#include "app/view/scenery.h"
#include "app/view/session.h"

namespace app::view {

/// What a window is told besides what it shows, as it is written.
struct WindowOptions {
  std::string features;
  std::string folder = ".";
  std::string overlay = "on";
  bool plays = false;
  bool fresh = false;
  std::optional<int> frames;
};
void add_window_options(CLI::App& command, WindowOptions& options);

/// Of a window that shows what the words name. Throws globe::Error for a database that is none.
SessionSettings session_settings(const WindowOptions& options, const ViewOptions& view,
                                 const std::string& word);

/// How the window of that name was left, unless it is to begin anew.
std::optional<LastView> left_view(const WindowOptions& options, const std::string& name);
/// Has a session begin as one was left; a sun that was asked for stays.
void take_left_view(const LastView& left, SessionSettings& session);

/// Runs the window, and remembers how it was left unless it was to close by itself. Throws Error for what the
/// driver complained of.
void run_session(const WindowOptions& options, globe::gl::Window& window, Scenery& scenery,
                 const SessionSettings& session);

}  // namespace app::view
