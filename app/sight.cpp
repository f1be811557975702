#include "globe/planet/sight.h"

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/planet_argument.h"
#include "app/point_pair.h"
#include "app/records.h"
#include "globe/base/error.h"
#include "globe/geo/geodesic.h"
#include "globe/htm/trixel.h"
#include "globe/planet/profile.h"

namespace app {
namespace {

using globe::geo::Geodetic;
using globe::planet::Sight;
using globe::planet::SightPlace;
using globe::planet::Surface;

constexpr double kEyeHeight = 2.0;  ///< metres above ground, of a point without ALT

struct SightOptions {
  std::string planet;
  std::vector<std::string> points;
  std::optional<int> level;
  double refraction = 0.0;
  bool agl = false;
  RecordOptions records;
};

/// What a pair is answered.
struct SightAnswer {
  Geodetic a, b;  ///< the eyes
  Sight sight;
  double lowest_at_m = 0, blocked_at_m = 0;  ///< along the geodesic from A
  double distance_m = 0;                     ///< from A to B along the geodesic
};

Geodetic eye_of(const Point& point, const Surface& surface, const globe::planet::SightSettings& settings,
                bool agl) {
  constexpr double kHighestEye = 1e9;
  Geodetic eye = point.position;
  if (!point.has_alt || agl)
    eye.h_m = globe::planet::sight_ground(surface, eye, settings) + (point.has_alt ? eye.h_m : kEyeHeight);
  const double deepest = -surface.ellipsoid().a / 10.0;
  if (!(eye.h_m >= deepest && eye.h_m <= kHighestEye)) {
    throw globe::UsageError("ALT " + number_text(eye.h_m, std::nullopt), "is no height of an eye",
                            "give metres from " + number_text(deepest, 0) + " to 1000000000");
  }
  return eye;
}

nlohmann::ordered_json json_place(const SightPlace& place, double distance_m,
                                  const std::optional<int>& precision) {
  return {{"lat", shown(place.ray.lat_deg, precision)},
          {"lon", shown_longitude(place.ray.lon_deg, precision)},
          {"height_m", shown(place.ray.h_m - place.clearance_m, precision)},
          {"distance_m", shown(distance_m, precision)}};
}

std::string json_line(const SightAnswer& answer, const SightOptions& options, const Surface& surface,
                      int level) {
  const auto& precision = options.records.precision;
  const auto& [a, b, sight, lowest_at_m, blocked_at_m, distance_m] = answer;
  nlohmann::ordered_json object;
  object["visible"] = sight.visible;
  object["blocked_at"] = nullptr;
  if (sight.blocked_at) object["blocked_at"] = json_place(*sight.blocked_at, blocked_at_m, precision);
  object["clearance_m"] = shown(sight.lowest.clearance_m, precision);
  object["clearance_at"] = json_place(sight.lowest, lowest_at_m, precision);
  object["distance_m"] = shown(distance_m, precision);
  object["range_m"] = shown(sight.range_m, precision);
  object["eye1_m"] = shown(a.h_m, precision);
  object["eye2_m"] = shown(b.h_m, precision);
  object["refraction"] = options.refraction;
  object["level"] = level;
  object["datum"] = surface.info().vertical_datum;
  return object.dump();
}

std::string table_line(const SightAnswer& answer, char separator, const std::optional<int>& precision) {
  const Sight& sight = answer.sight;
  const SightPlace& place = sight.visible ? sight.lowest : *sight.blocked_at;
  std::string line = sight.visible ? "visible" : "blocked";
  append_number(line += separator, sight.lowest.clearance_m, precision);
  append_number(line += separator, place.ray.lat_deg, precision);
  append_number(line += separator, shown_longitude(place.ray.lon_deg, precision), precision);
  append_number(line += separator, sight.visible ? answer.lowest_at_m : answer.blocked_at_m, precision);
  append_number(line += separator, answer.distance_m, precision);
  return line;
}

/// The finest level of the ground between the eyes.
int level_of(const Surface& surface, const SightAnswer& answer, const SightOptions& options) {
  return options.level ? *options.level
                       : globe::planet::data_levels_along(surface, answer.a, answer.b).finest;
}

int run(const SightOptions& options) {
  if (!(options.refraction >= 0.0 && options.refraction <= 1.0)) {
    throw globe::UsageError("--refraction " + number_text(options.refraction, std::nullopt),
                            "is not between 0 and 1", "give 0 for a straight ray, 0.13 for light in air");
  }
  const std::vector<std::string> records = pair_records(options.points);
  const auto surface = open_planet(options.planet);
  require_heights(*surface, options.planet);
  warn_of_unknown_datum(*surface, options.planet);
  const globe::planet::SightSettings settings{options.level.value_or(surface->finest_data_level()),
                                              options.refraction, !options.level && surface->has_data()};
  const globe::geo::GeodesicSolver geodesics(surface->ellipsoid());
  const auto answer = [&](const std::string& record) {
    const PointPair pair = parse_point_pair(record);
    SightAnswer found;
    found.a = eye_of(pair.a, *surface, settings, options.agl);
    found.b = eye_of(pair.b, *surface, settings, options.agl);
    found.sight = globe::planet::sight(*surface, found.a, found.b, settings);
    const auto distance_m = [&](const Geodetic& place) { return geodesics.inverse(found.a, place).s12_m; };
    found.lowest_at_m = distance_m(found.sight.lowest.ray);
    if (found.sight.blocked_at) found.blocked_at_m = distance_m(found.sight.blocked_at->ray);
    found.distance_m = distance_m(found.b);
    if (options.records.json) return json_line(found, options, *surface, level_of(*surface, found, options));
    return table_line(found, options.records.csv ? ',' : ' ', options.records.precision);
  };
  return answer_records(records, options.records, "state,clearance_m,lat,lon,at_m,distance_m", answer,
                        Threads::kAll);
}

}  // namespace

void add_sight(CLI::App& program, int& exit_status) {
  auto options = std::make_shared<SightOptions>();
  CLI::App* command = program.add_subcommand("sight", "whether two eyes see each other over the ground");
  command->add_option("PLANET", options->planet, "folder made by globe convert, or procedural[:SEED]")
      ->required();
  command->add_option("POINT", options->points,
                      "two eyes, \"LAT LON [ALT]\" or LAT,LON[,ALT] each; without them: a pair a line from "
                      "standard input, LAT LON LAT LON, LAT LON ALT LAT LON ALT or A ; B");
  command
      ->add_option("--refraction", options->refraction,
                   "how much the ray bends, in curvatures of the planet: 0 straight, light in air 0.13")
      ->capture_default_str();
  command->add_flag("--agl", options->agl, "every ALT counts from the ground");
  command
      ->add_option("--level", options->level,
                   "HTM level of the ground (default: the data at their finest, those of insets in insets; "
                   "procedural: the level of its own relief)")
      ->check(CLI::Range(0, globe::htm::kMaxLevel));
  add_record_options(*command, options->records);
  command->footer(
      "Text: visible CLEARANCE_M LAT LON AT_M DISTANCE_M: the ray's least height above the ground, where, "
      "how\n"
      "far from A along the geodesic, and how far B is;  blocked CLEARANCE_M LAT LON AT_M DISTANCE_M: how "
      "deep\n"
      "the ray runs below the ground at worst (negative), and where it first meets it.\n"
      "An eye without ALT is 2 m above ground; ALT is metres above the planet's datum, or with --agl above\n"
      "ground.  The ground is that of globe height, on the curved ellipsoid, the sea at 0.  No ridge is "
      "missed:\n"
      "the ray is not sampled at a fixed step.  With --refraction K the horizon recedes by 1 / sqrt(1 - K).\n"
      "Example: globe sight my-planet 27.9881,86.9250 27.7025,88.1475 --refraction 0.13");
  command->callback([options, &exit_status] { exit_status = run(*options); });
}

}  // namespace app
