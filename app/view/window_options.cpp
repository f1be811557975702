#include "app/view/window_options.h"

#include <cstdio>

#include "app/view/viewer.h"
#include "globe/base/error.h"

namespace app::view {

void add_window_options(CLI::App& command, WindowOptions& options) {
  command.add_option("--features", options.features,
                     "database made by globe index: its names can be searched for");
  command.add_option("--folder", options.folder, "where pictures and films are put")->capture_default_str();
  command.add_option("--overlay", options.overlay, "off: without panels at first (Tab brings them)")
      ->capture_default_str()
      ->check(CLI::IsMember({"on", "off"}));
  command.add_flag("--fresh", options.fresh, "begin anew, not as the window was left");
  command
      .add_option(
          "--frames", options.frames,
          "close after so many frames, drawn as fast as can be, a sixtieth of a second of time to each, and "
          "print when the first picture was there and what a frame took (of the last 240)")
      ->check(CLI::Range(1, 1'000'000));
  command.footer(
      "Drag turns the globe, the wheel comes nearer, right drag tilts; all keys are in the overlay (Tab).");
}

SessionSettings session_settings(const WindowOptions& options, const ViewOptions& view,
                                 const std::string& word) {
  SessionSettings session;
  session.title = "globe - " + word;
  if (!options.features.empty())
    session.features = std::make_shared<globe::search::FeatureIndex>(options.features);
  session.folder = options.folder;
  session.shows_overlay = options.overlay == "on";
  session.plays = options.plays;
  session.time = view.time;
  session.overhead = view.overhead;
  return session;
}

std::optional<LastView> left_view(const WindowOptions& options, const std::string& name) {
  const auto views = views_file();
  if (options.fresh || options.plays || !views) return std::nullopt;
  return recall_view(*views, name);
}

void take_left_view(const LastView& left, SessionSettings& session) {
  session.start = left.stand;
  session.moment_s = left.moment_s;
  if (!session.time.empty() || !session.overhead.empty()) return;
  session.time = left.time;
  session.overhead = left.overhead;
}

void run_session(const WindowOptions& options, globe::gl::Window& window, Scenery& scenery,
                 const SessionSettings& session) {
  Session shown(window, scenery, session);
  const WindowRun run = run_window(shown, options.frames);
  if (options.frames) {
    std::printf("first picture %.2f s\nframes %zu\nframe p50 %.1f ms\nframe p99 %.1f ms\n",
                run.first_picture_s, run.frames, shown.figures.percentile_ms(50),
                shown.figures.percentile_ms(99));
  }
  const auto views = views_file();
  if (views && !options.frames) remember_view(*views, scenery.name(), shown.view_now());
  if (!window.errors().empty())
    throw globe::Error("OpenGL", window.errors().front(), "globe shot and globe fly draw without a window");
}

}  // namespace app::view
