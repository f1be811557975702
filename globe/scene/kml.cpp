#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <utility>

#include "globe/base/error.h"
#include "globe/base/one_line.h"
#include "globe/geo/utc.h"
#include "globe/scene/quantity.h"
#include "globe/scene/track_file.h"
#include "globe/scene/xml_file.h"

// KML 2.3 (OGC 12-007r2): tours, tracks and lines as paths.

namespace globe::scene {
namespace {

constexpr double kFlyTo_s = 5.0;  ///< a gx:FlyTo without a duration

/// Whether altitudes of a KML element count from the ground, and whether there are any.
struct AltitudeMode {
  bool above_ground = true;
  bool has_altitude = false;
};

AltitudeMode altitude_mode(const XmlFile& file, const pugi::xml_node& of, std::optional<bool> agl) {
  const pugi::xml_node node = child_named(of, "altitudeMode");
  const std::string mode = node ? std::string(node.text().get()) : "clampToGround";
  if (mode != "absolute" && mode != "relativeToGround" && mode != "clampToGround" &&
      mode != "relativeToSeaFloor" && mode != "clampToSeaFloor")
    file.refuse(node, "altitudeMode \"" + one_line(mode, 40) + "\" is none of KML's",
                "write absolute, relativeToGround or clampToGround");
  const bool clamped = mode.starts_with("clamp");
  return {agl.value_or(mode != "absolute"), !clamped || agl.has_value()};
}

/// The place of a LookAt or a Camera.
PathKey view_of(const XmlFile& file, const pugi::xml_node& node, std::optional<bool> agl) {
  PathKey key;
  key.line = file.line(node);
  key.place.lat_deg = file.number(node, "latitude").value_or(0.0);
  key.place.lon_deg = file.number(node, "longitude").value_or(0.0);
  const AltitudeMode mode = altitude_mode(file, node, agl);
  key.above_ground = mode.above_ground;
  if (mode.has_altitude) key.place.h_m = file.number(node, "altitude").value_or(0.0);
  const double heading = file.number(node, "heading").value_or(0.0);
  const double tilt = file.number(node, "tilt").value_or(0.0);
  if (tilt < 0.0 || tilt > 180.0)
    file.refuse(node, "the tilt is not in 0 to 180", "write degrees from straight down");
  key.look = Look{heading, tilt - 90.0};
  if (local_name(node) == "LookAt") {
    key.range_m = file.number(node, "range").value_or(0.0);
    if (!(key.range_m > 0.0))
      file.refuse(node, "a LookAt without a range above 0", "give its <range> in metres");
  } else {
    // KML rolls about an axis that points at the viewer, so counter-clockwise.
    key.roll_deg = -file.number(node, "roll").value_or(0.0);
    if (!(std::abs(key.roll_deg) <= 180.0))
      file.refuse(node, "the roll is not in -180 to 180", "write degrees, 0 for a level horizon");
  }
  return key;
}

bool is_smooth(const XmlFile& file, const pugi::xml_node& fly_to) {
  const pugi::xml_node node = child_named(fly_to, "flyToMode");
  const std::string mode = node ? std::string(node.text().get()) : "bounce";
  if (mode != "smooth" && mode != "bounce")
    file.refuse(node, "flyToMode \"" + one_line(mode, 40) + "\" is none of KML's", "write bounce or smooth");
  return mode == "smooth";
}

/// A tour: FlyTos arrive after their durations, or at once where they have none; Waits hold. Smooth ones one
/// after the other are flown without a rest between them; anything else begins and ends at rest.
std::vector<PathKey> keys_of_tour(const XmlFile& file, const pugi::xml_node& tour, std::optional<bool> agl) {
  std::vector<PathKey> keys;
  double time = 0.0;
  for (const pugi::xml_node& step : child_named(tour, "Playlist").children()) {
    const std::string_view kind = local_name(step);
    if (kind != "FlyTo" && kind != "Wait") continue;
    const double duration = file.number(step, "duration").value_or(kind == "FlyTo" ? kFlyTo_s : 0.0);
    if (duration < 0.0) file.refuse(step, "a negative duration", "write seconds of at least 0");
    if (kind == "Wait") {
      if (keys.empty() || duration == 0.0) continue;
      time += duration;
      keys.back().stop = true;
      keys.push_back(keys.back());
      keys.back().jump = false;
      keys.back().time_s = time;
      continue;
    }
    const pugi::xml_node camera = child_named(step, "Camera"), look_at = child_named(step, "LookAt");
    if (!camera && !look_at) file.refuse(step, "a FlyTo without a view", "give it a LookAt or a Camera");
    PathKey key = view_of(file, camera ? camera : look_at, agl);
    // The first view is where the path begins, however long it takes to get there.
    const bool smooth = is_smooth(file, step);
    if (!keys.empty()) {
      key.jump = duration == 0.0;
      if (key.jump || !smooth) keys.back().stop = true;
      time += duration;
    }
    key.time_s = time;
    key.stop = keys.empty() || !smooth || key.jump;
    keys.push_back(key);
  }
  if (!keys.empty()) keys.back().stop = true;
  return keys;
}

/// Numbers of "a,b,c" or "a b c".
std::vector<double> numbers_of(std::string text) {
  std::replace(text.begin(), text.end(), ',', ' ');
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;) numbers.push_back(parse_plain(word).value_or(std::nan("")));
  return numbers;
}

PathKey key_at(const XmlFile& file, const pugi::xml_node& node, const std::string& text,
               const AltitudeMode& mode) {
  const std::vector<double> numbers = numbers_of(text);
  if (numbers.size() < 2 || numbers.size() > 3 ||
      !std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }))
    file.refuse(node, '"' + one_line(text, 40) + "\" is not longitude, latitude and altitude",
                "write numbers, longitude first");
  PathKey key;
  key.line = file.line(node);
  key.place = {numbers[1], numbers[0], mode.has_altitude && numbers.size() == 3 ? numbers[2] : 0.0};
  key.above_ground = mode.above_ground;
  return key;
}

std::vector<PathKey> keys_of_track(const XmlFile& file, const pugi::xml_node& track,
                                   std::optional<bool> agl) {
  const AltitudeMode mode = altitude_mode(file, track, agl);
  std::vector<double> times;
  std::optional<geo::UtcDate> first;
  std::vector<PathKey> keys;
  for (const pugi::xml_node& node : track.children()) {
    if (local_name(node) == "coord") keys.push_back(key_at(file, node, node.text().get(), mode));
    if (local_name(node) != "when") continue;
    try {
      const geo::UtcDate date = geo::parse_utc(node.text().get());
      if (!first) first = date;
      times.push_back(geo::seconds_between(*first, date));
    } catch (const UsageError&) {
      file.refuse(node, '"' + one_line(node.text().get(), 40) + "\" is not a date and time",
                  "write ISO 8601, such as 2026-03-21T10:00:00Z");
    }
  }
  if (times.empty()) return keys;
  if (times.size() != keys.size())
    file.refuse(track,
                "the track has " + std::to_string(keys.size()) + " places and " +
                    std::to_string(times.size()) + " times",
                "give a <when> to every <gx:coord>");
  for (std::size_t k = 0; k < keys.size(); ++k) keys[k].time_s = times[k];
  return keys;
}

std::vector<PathKey> keys_of_line(const XmlFile& file, const pugi::xml_node& line, std::optional<bool> agl) {
  const AltitudeMode mode = altitude_mode(file, line, agl);
  const pugi::xml_node coordinates = child_named(line, "coordinates");
  std::istringstream tuples(coordinates.text().get());
  std::vector<PathKey> keys;
  for (std::string tuple; tuples >> tuple;) keys.push_back(key_at(file, coordinates, tuple, mode));
  return keys;
}

}  // namespace

std::vector<PathKey> read_kml(std::string text, const std::string& name, std::optional<bool> agl) {
  const XmlFile file(std::move(text), name);
  std::vector<PathKey> keys;
  if (const auto tours = all_named(file.root(), "Tour"); !tours.empty()) {
    keys = keys_of_tour(file, tours.front(), agl);
  } else if (const auto tracks = all_named(file.root(), "Track"); !tracks.empty()) {
    keys = keys_of_track(file, tracks.front(), agl);
  } else if (const auto lines = all_named(file.root(), "LineString"); !lines.empty()) {
    keys = keys_of_line(file, lines.front(), agl);
  } else {
    throw Error(name, "there is no gx:Tour, gx:Track or LineString in it",
                "give a KML file with one of them");
  }
  require_path(keys, name);
  return keys;
}

}  // namespace globe::scene
