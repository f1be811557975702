#include <GeographicLib/GeoCoords.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/interpolation_option.h"
#include "app/planet_argument.h"
#include "app/point.h"
#include "app/records.h"
#include "globe/base/error.h"
#include "globe/geo/ellipsoid.h"
#include "globe/htm/trixel.h"
#include "globe/planet/cell.h"
#include "globe/planet/interpolation.h"

namespace app {
namespace {

constexpr int kDefaultLevel = 20;

using globe::planet::Interpolation;

struct Lookup {
  std::vector<std::string> operands;
  std::optional<int> level;
  Interpolation interpolation = Interpolation::kLinear;
  bool interpolates = false;  ///< whether --interpolation is given
  RecordOptions records;
};

/// All that one point is called.
struct Place {
  double lat_deg, lon_deg;
  globe::htm::Trixel trixel;
  globe::planet::Cell cell;
  std::optional<double> height_m;  ///< with a PLANET: of its data at their finest
  globe::geo::dvec3 ecef_m;
};

/// @param surface  null without a PLANET
Place place_of(const Point& point, std::optional<int> wanted, const globe::planet::Surface* surface,
               Interpolation interpolation, const std::optional<int>& precision) {
  const auto& at = point.position;
  const auto u = globe::geo::normal_from_degrees(at.lat_deg, at.lon_deg);
  const int level = wanted ? *wanted : surface ? surface->data_at(u).level : kDefaultLevel;
  const auto trixel = globe::htm::trixel_at(u, level);
  const auto& ellipsoid = surface ? surface->ellipsoid() : globe::geo::kWgs84;
  Place place{shown(at.lat_deg, precision),
              shown_longitude(at.lon_deg, precision),
              trixel,
              globe::planet::cell_from_trixel(trixel),
              std::nullopt,
              globe::geo::ecef_from_normal(ellipsoid, u, at.h_m)};
  if (surface) {
    place.height_m = data_height_at(*surface, u, interpolation).height_m;
  }
  return place;
}

/// UTM or UPS to the millimetre and MGRS to the metre; empty off the WGS84 ellipsoid, where they mean
/// nothing.
struct GridNames {
  std::string utm, mgrs;
};

GridNames grid_names(const Point& point, const globe::geo::Ellipsoid& ellipsoid) {
  if (ellipsoid != globe::geo::kWgs84) return {};
  const GeographicLib::GeoCoords coords(point.position.lat_deg, point.position.lon_deg);
  return {coords.UTMUPSRepresentation(3), coords.MGRSRepresentation(0)};
}

std::string text_line(const Place& place, const std::optional<int>& precision) {
  std::string line;
  line.reserve(128);
  const auto& [d, level, i, j, half] = place.cell;
  append_number(line, place.lat_deg, precision);
  append_number(line += ' ', place.lon_deg, precision);
  append_integer(line += ' ', static_cast<std::uint64_t>(level));
  append_integer(line += ' ', place.trixel.id);
  line += ' ';
  line += globe::htm::name(place.trixel);
  for (const int number : {d, i, j}) append_integer(line += ' ', static_cast<std::uint64_t>(number));
  if (place.height_m) append_number(line += ' ', *place.height_m, precision);
  return line;
}

std::string csv_line(const Place& place, const GridNames& names, const std::optional<int>& precision) {
  std::string line = text_line(place, precision);
  std::replace(line.begin(), line.end(), ' ', ',');
  for (int k = 0; k < 3; ++k) line += ',' + number_text(place.ecef_m[k], precision);
  return line + ',' + names.utm + ',' + names.mgrs;
}

std::string json_line(const Place& place, const GridNames& names, const std::optional<int>& precision) {
  nlohmann::ordered_json object;
  object["lat"] = place.lat_deg;
  object["lon"] = place.lon_deg;
  object["level"] = place.cell.level;
  object["id"] = place.trixel.id;
  object["name"] = globe::htm::name(place.trixel);
  object["diamond"] = place.cell.d;
  object["i"] = place.cell.i;
  object["j"] = place.cell.j;
  if (place.height_m) object["height_m"] = shown(*place.height_m, precision);
  object["ecef_m"] = {shown(place.ecef_m.x, precision), shown(place.ecef_m.y, precision),
                      shown(place.ecef_m.z, precision)};
  const auto text_or_null = [](const std::string& text) {
    return text.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(text);
  };
  object["utm"] = text_or_null(names.utm);
  object["mgrs"] = text_or_null(names.mgrs);
  return object.dump();
}

int run(Lookup lookup) {
  const std::optional<std::string> planet = take_planet(lookup.operands);
  std::shared_ptr<const globe::planet::Surface> surface;
  if (planet) {
    surface = open_planet(*planet);
    require_heights(*surface, *planet);
    warn_of_unknown_datum(*surface, *planet);
  } else if (lookup.interpolates) {
    throw globe::UsageError("--interpolation", "without a PLANET there are no heights",
                            "give a PLANET before the points");
  }
  const RecordOptions& records = lookup.records;
  const auto& ellipsoid = surface ? surface->ellipsoid() : globe::geo::kWgs84;
  const auto answer = [&](const std::string& record) {
    const Point point = parse_point(record);
    const Place place = place_of(point, lookup.level, surface.get(), lookup.interpolation, records.precision);
    if (records.json) return json_line(place, grid_names(point, ellipsoid), records.precision);
    if (records.csv) return csv_line(place, grid_names(point, ellipsoid), records.precision);
    return text_line(place, records.precision);
  };
  const std::string header = std::string("lat,lon,level,id,name,diamond,i,j") + (surface ? ",height_m" : "") +
                             ",ecef_x_m,ecef_y_m,ecef_z_m,utm,mgrs";
  return answer_records(lookup.operands, records, header, answer, Threads::kAll);
}

}  // namespace

void add_lookup(CLI::App& program, int& exit_status) {
  auto lookup = std::make_shared<Lookup>();
  CLI::App* command = program.add_subcommand("lookup", "name the trixel and the grid cell of each point");
  command->add_option(
      "POINT", lookup->operands,
      "[PLANET] and points, \"LAT LON\" or LAT,LON each; without points: one a line from standard input");
  command
      ->add_option("--level", lookup->level,
                   "HTM level (default: that of the planet's finest data at the point, else 20)")
      ->check(CLI::Range(0, globe::htm::kMaxLevel));
  CLI::Option* interpolation = add_interpolation_option(*command, lookup->interpolation);
  add_record_options(*command, lookup->records);
  command->footer(
      "Text: LAT LON LEVEL ID NAME DIAMOND I J, with a PLANET also HEIGHT_M, that of globe height without\n"
      "--level, whichever level the trixel is of. ECEF is on the planet's ellipsoid (WGS84 without one), at "
      "the point's ALT or 0.\n"
      "Example: globe lookup --level 14 \"50.0875 14.4213\"");
  command->callback([lookup, interpolation, &exit_status] {
    lookup->interpolates = interpolation->count() > 0;
    exit_status = run(*lookup);
  });
}

}  // namespace app
