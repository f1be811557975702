#include "app/view/session.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "app/image_file.h"
#include "app/records.h"
#include "app/view/shell_words.h"
#include "globe/base/error.h"

namespace app::view {
namespace {

namespace geo = globe::geo;

constexpr double kNoticeTime = 6.0;  ///< seconds

glm::ivec2 at_least_one(glm::ivec2 size) { return {std::max(size.x, 1), std::max(size.y, 1)}; }

std::string exact(double value) { return number_text(value, std::nullopt); }

}  // namespace

Session::Session(globe::gl::Window& shown_in, Scenery& shown, const SessionSettings& settings)
    : title(settings.title),
      window(shown_in),
      scenery(shown),
      canvas(at_least_one(shown_in.size()), shown.options().samples),
      navigator({shown.ellipsoid(), shown.options().optics.fov_deg.value_or(60.0), glm::dvec2(canvas.size())},
                world(), settings.start),
      measure(shown.ellipsoid()),
      flight(settings.flight),
      features(settings.features),
      folder(settings.folder),
      moment_s(settings.moment_s),
      on_path(settings.plays && settings.flight != nullptr),
      shows_overlay(settings.shows_overlay),
      time_(settings.time),
      overhead_(settings.overhead),
      sunlight_(glm::dvec3(1, 0, 0)) {
  set_sun();
}

Navigator::World Session::world() {
  return {[this](glm::dvec2 pixel) { return canvas.seen_at(pixel); },
          [this](const glm::dvec3& at) { return scenery.renderer().height_above_ground(at, false); }};
}

void Session::set_sun() {
  ViewOptions options = scenery.options();
  if (time_.empty() && overhead_.empty()) {
    time_ = options.time;
    overhead_ = options.overhead;
  }
  options.time = time_;
  options.overhead = overhead_;
  sunlight_ = sun_for(options, scenery.body(), navigator.stand().place);
  if (!time_.empty() || !overhead_.empty() || options.sun.time) return;
  // A sun without a time stays where it stands now, wherever the camera goes.
  const geo::Geodetic over = geo::degrees_from_normal(sunlight_.at(0.0));
  overhead_ = options.overhead = exact(over.lat_deg) + "," + exact(over.lon_deg);
  sunlight_ = sun_for(options, scenery.body(), navigator.stand().place);
}

void Session::set_time(const std::string& time) {
  const std::string time_before = std::exchange(time_, time), overhead_before = std::exchange(overhead_, "");
  try {
    set_sun();
  } catch (const globe::Error&) {
    time_ = time_before;
    overhead_ = overhead_before;
    throw;
  }
}

void Session::set_overhead(const std::string& place) {
  geo::parse_point(place);
  time_.clear();
  overhead_ = place;
  set_sun();
}

double Session::above_ground_m() const {
  return scenery.renderer().height_above_ground(
      geo::ecef_from_geodetic(scenery.ellipsoid(), navigator.stand().place), false);
}

double Session::ground_m(double lat_deg, double lon_deg, double camera_m) const {
  const glm::dvec3 above = geo::ecef_from_geodetic(scenery.ellipsoid(), {lat_deg, lon_deg, camera_m});
  return camera_m - scenery.renderer().height_above_ground(above, true);
}

std::string Session::shot_line(const std::string& output) const {
  std::vector<std::string> words = scenery.shot_words();
  words.insert(words.begin(), "globe");
  const auto say = [&](const char* option, const std::string& value) {
    words.insert(words.end(), {option, value});
  };
  const Standpoint& stand = navigator.stand();
  say("--at", exact(stand.place.lat_deg) + "," + exact(stand.place.lon_deg) + "," + exact(stand.place.h_m));
  std::string look = exact(stand.look.heading_deg) + "," + exact(stand.look.pitch_deg);
  if (stand.look.roll_deg != 0.0) look += "," + exact(stand.look.roll_deg);
  say("--look", look);
  say("--size", std::to_string(canvas.size().x) + "x" + std::to_string(canvas.size().y));
  say("--fov", exact(navigator.eye().fov_deg));
  if (!time_.empty()) say("--time", time_);
  if (!overhead_.empty()) say("--sun", overhead_);
  if (moment_s != 0.0) say("--moment", exact(moment_s));
  say("-o", output);
  return shell_line(words);
}

void Session::save_picture() {
  attempt([&] {
    const std::filesystem::path file = free_name(folder, ".png");
    navigator.keep_clear_of([&](const glm::dvec3& at) { return scenery.renderer().height_above_ground(at); });
    canvas.draw(scenery, navigator.camera(), sunlight_, moment_s, true, 0.0);
    const glm::ivec2 size = canvas.size();
    const std::vector<std::uint8_t> rgba = canvas.picture().read_rgba8();
    write_image(file, Picture{size.x, size.y, rgba}, false);
    std::printf("%s\n", shot_line(file.string()).c_str());
    std::fflush(stdout);
    tell("saved " + file.string());
  });
}

void Session::toggle_recording() {
  attempt([&] {
    if (recorder) {
      const std::string file = recorder->file().string();
      recorder->show(canvas.picture(), real_s_);
      Recorder& film = *recorder;
      try {
        film.finish();
      } catch (const globe::Error&) {
        recorder.reset();
        throw;
      }
      recorder.reset();
      tell("saved " + file);
    } else {
      recorder.emplace(free_name(folder, ".mp4"), canvas.size().x, canvas.size().y);
    }
  });
}

void Session::tell(const std::string& text) {
  notice_ = text;
  notice_s_ = kNoticeTime;
}

void Session::pass(double seconds, double real_seconds) {
  real_s_ += real_seconds;
  if (running && (flight || scenery.is_animated())) moment_s += seconds;
  if (!notice_.empty() && (notice_s_ -= real_seconds) <= 0.0) notice_.clear();
  if (!on_path) return;
  const double duration = flight->duration_s();
  if (moment_s >= duration) {
    moment_s = duration;
    running = false;
    on_path = false;
  }
  const Flight::View view = flight->at(moment_s / duration, false);
  navigator.jump_to({view.place, view.look});
}

}  // namespace app::view
