#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/flight.h"
#include "app/view/canvas.h"
#include "app/view/frame_figures.h"
#include "app/view/last_view.h"
#include "app/view/measure.h"
#include "app/view/navigator.h"
#include "app/view/recorder.h"
#include "app/view/scenery.h"
#include "globe/gl/window.h"
#include "globe/search/feature_index.h"

namespace app::view {

/// What is typed for a search, and what it found.
struct SearchBox {
  struct Found {
    std::string name;
    double lat_deg = 0, lon_deg = 0;
  };
  std::string text;
  std::string asked;  ///< that `found` answers
  std::vector<Found> found;
  bool wants_keyboard = false;
};

/// The sun's time while it is typed.
struct TimeBox {
  std::string text;
  std::string of;  ///< time that it was last filled with
};

/// What `globe view` is told besides what it shows.
struct SessionSettings {
  std::string title;
  Standpoint start;
  double moment_s = 0;
  std::string time, overhead;            ///< of the sun, in place of the scenery's own; at most one
  std::shared_ptr<const Flight> flight;  ///< along a scene's path; null: it has none
  std::shared_ptr<globe::search::FeatureIndex> features;  ///< for searching; null: none
  std::filesystem::path folder = ".";                     ///< for pictures and films
  bool shows_overlay = true;
  bool plays = false;  ///< along the path at first
};

/// What happens in a window: everything that its panels and its keys act on.
struct Session {
  Session(globe::gl::Window& window, Scenery& scenery, const SessionSettings& settings);

  std::string title;  ///< of the window
  globe::gl::Window& window;
  Scenery& scenery;
  Canvas canvas;
  Navigator navigator;
  FrameFigures figures;
  Measure measure;
  std::shared_ptr<const Flight> flight;
  std::shared_ptr<globe::search::FeatureIndex> features;
  std::optional<Recorder> recorder;
  std::filesystem::path folder;

  double moment_s = 0;   ///< of the scene's time
  bool running = true;   ///< it goes on
  bool on_path = false;  ///< the camera follows `flight`

  glm::dvec2 pointer{-1.0};
  std::optional<glm::dvec3>
      pointed;  ///< seen at the pointer in the frame before, ECEF; kept while panels want it

  bool shows_overlay = true;
  bool closes = false;
  SearchBox search;
  TimeBox time_box;

  /// The sun's time, ISO 8601, or where it stands in the zenith; at most one is not empty.
  const std::string& time() const { return time_; }
  const std::string& overhead() const { return overhead_; }
  const Sunlight& sunlight() const { return sunlight_; }
  /// Throws UsageError for what is none, or a time on a planet where it says nothing.
  void set_time(const std::string& time);
  void set_overhead(const std::string& place);

  double above_ground_m() const;
  /// Height above the ellipsoid of the ground as it is drawn under a camera at a height, metres. It waits for
  /// ground that has to be made.
  double ground_m(double lat_deg, double lon_deg, double camera_m) const;
  globe::geo::Geodetic geodetic_of(const glm::dvec3& place) const {
    return globe::geo::geodetic_from_ecef(scenery.ellipsoid(), place);
  }

  /// The command that draws this very picture, for a shell.
  std::string shot_line(const std::string& output) const;
  /// Draws the picture complete and writes it as a PNG beside others, and its command to standard output.
  /// Failures become notices.
  void save_picture();
  void toggle_recording();

  /// Tells something for a few seconds.
  void tell(const std::string& text);
  const std::string& notice() const { return notice_; }
  /// Lets time pass: so much for the scene, and so much really.
  void pass(double seconds, double real_seconds);
  double real_s() const { return real_s_; }

  /// Runs what may fail; a failure becomes a notice.
  template <class Action>
  void attempt(const Action& action) {
    try {
      action();
    } catch (const std::exception& error) {
      tell(error.what());
    }
  }

  LastView view_now() const { return {navigator.stand(), moment_s, time_, overhead_}; }

 private:
  void set_sun();
  Navigator::World world();

  std::string time_, overhead_;
  Sunlight sunlight_;
  std::string notice_;
  double notice_s_ = 0;
  double real_s_ = 0;  ///< since the beginning
};

}  // namespace app::view
