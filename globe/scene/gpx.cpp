#include <cmath>
#include <utility>

#include "globe/base/error.h"
#include "globe/base/one_line.h"
#include "globe/geo/utc.h"
#include "globe/scene/quantity.h"
#include "globe/scene/track_file.h"
#include "globe/scene/xml_file.h"

// GPX 1.1 (https://www.topografix.com/GPX/1/1): tracks and routes as paths.

namespace globe::scene {
namespace {

double degrees_of(const XmlFile& file, const pugi::xml_node& point, const char* name) {
  const char* text = point.attribute(name).value();
  const auto value = parse_plain(text);
  if (!value || !std::isfinite(*value))
    file.refuse(point, std::string(name) + " is \"" + one_line(text, 40) + "\", not a number",
                "write degrees");
  return *value;
}

}  // namespace

std::vector<PathKey> read_gpx(std::string text, const std::string& name, std::optional<bool> agl) {
  const XmlFile file(std::move(text), name);
  std::vector<pugi::xml_node> points = all_named(file.root(), "trkpt");
  if (points.empty()) points = all_named(file.root(), "rtept");
  if (points.empty())
    throw Error(name, "there is no track or route in it", "give a GPX file with <trkpt> or <rtept>");
  std::optional<geo::UtcDate> first;
  std::vector<PathKey> keys;
  for (const pugi::xml_node& point : points) {
    PathKey key;
    key.line = file.line(point);
    key.place = {degrees_of(file, point, "lat"), degrees_of(file, point, "lon"),
                 file.number(point, "ele").value_or(0.0)};
    key.above_ground = agl.value_or(false);
    if (const pugi::xml_node time = child_named(point, "time")) {
      try {
        const geo::UtcDate date = geo::parse_utc(time.text().get());
        if (!first) first = date;
        key.time_s = geo::seconds_between(*first, date);
      } catch (const UsageError&) {
        file.refuse(time, '"' + one_line(time.text().get(), 40) + "\" is not a date and time",
                    "write ISO 8601, such as 2026-03-21T10:00:00Z");
      }
    }
    // Receivers write two places for one second.
    if (!keys.empty() && key.time_s && key.time_s == keys.back().time_s) continue;
    keys.push_back(key);
  }
  require_path(keys, name);
  return keys;
}

}  // namespace globe::scene
