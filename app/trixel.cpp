#include <algorithm>
#include <charconv>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/records.h"
#include "globe/base/error.h"
#include "globe/geo/area.h"
#include "globe/geo/ellipsoid.h"
#include "globe/htm/trixel.h"

namespace app {
namespace {

using globe::geo::Geodetic;
using globe::htm::Trixel;
using nlohmann::ordered_json;

struct TrixelCommand {
  std::vector<std::string> operands;
  RecordOptions records;
};

Trixel parse_trixel(const std::string& record) {
  const std::size_t first = record.find_first_not_of(" \t");
  const std::size_t last = record.find_last_not_of(" \t");
  const std::string word = first == std::string::npos ? "" : record.substr(first, last - first + 1);
  std::uint64_t id = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), id);
  const bool is_number = error == std::errc{} && end == word.data() + word.size();
  const auto trixel = is_number ? globe::htm::trixel_from_id(id) : globe::htm::trixel_from_name(word);
  if (!trixel) {
    throw globe::Error("trixel '" + word + "'", "is no id or name of level 0 to 28",
                       "write an id such as 12683 or a name such as N012031");
  }
  return *trixel;
}

double area_km2(Trixel t) {
  return globe::geo::surface_area(globe::geo::kWgs84, globe::htm::corners(t)) / 1e6;
}

/// Centre, then the three corners.
std::array<Geodetic, 4> positions(Trixel t) {
  const auto corners = globe::htm::corners(t);
  std::array<Geodetic, 4> result{globe::geo::degrees_from_normal(globe::htm::center(t))};
  for (std::size_t k = 0; k < 3; ++k) result[k + 1] = globe::geo::degrees_from_normal(corners[k]);
  return result;
}

ordered_json lat_lon(const Geodetic& at, const std::optional<int>& precision) {
  return {shown(at.lat_deg, precision), shown_longitude(at.lon_deg, precision)};
}

std::string json_line(Trixel t, const std::optional<int>& precision) {
  const int level = globe::htm::level(t);
  const auto [center, corner0, corner1, corner2] = positions(t);
  ordered_json object;
  object["id"] = t.id;
  object["name"] = globe::htm::name(t);
  object["level"] = level;
  object["corners"] = {lat_lon(corner0, precision), lat_lon(corner1, precision), lat_lon(corner2, precision)};
  object["center"] = lat_lon(center, precision);
  object["area_km2"] = shown(area_km2(t), precision);
  object["parent"] = level > 0 ? ordered_json(globe::htm::parent(t).id) : ordered_json();
  object["children"] = ordered_json::array();
  for (int k = 0; level < globe::htm::kMaxLevel && k < 4; ++k)
    object["children"].push_back(globe::htm::child(t, k).id);
  object["neighbors"] = ordered_json::array();
  object["neighbor_names"] = ordered_json::array();
  for (const Trixel& neighbor : globe::htm::neighbors(t)) {
    object["neighbors"].push_back(neighbor.id);
    object["neighbor_names"].push_back(globe::htm::name(neighbor));
  }
  return object.dump();
}

std::string text_line(Trixel t, const std::optional<int>& precision) {
  std::string line = std::to_string(t.id) + ' ' + globe::htm::name(t) + ' ' +
                     std::to_string(globe::htm::level(t)) + ' ' + number_text(area_km2(t), precision);
  for (const Geodetic& at : positions(t)) {
    line += ' ' + number_text(at.lat_deg, precision);
    line += ' ' + number_text(shown_longitude(at.lon_deg, precision), precision);
  }
  for (const Trixel& neighbor : globe::htm::neighbors(t)) line += ' ' + globe::htm::name(neighbor);
  return line;
}

std::string answer(const std::string& record, const RecordOptions& options) {
  const Trixel t = parse_trixel(record);
  if (options.json) return json_line(t, options.precision);
  std::string line = text_line(t, options.precision);
  if (options.csv) std::replace(line.begin(), line.end(), ' ', ',');
  return line;
}

}  // namespace

void add_trixel(CLI::App& program, int& exit_status) {
  auto trixel = std::make_shared<TrixelCommand>();
  CLI::App* command =
      program.add_subcommand("trixel", "tell a trixel's corners, area, family and neighbours");
  command->add_option("ID", trixel->operands,
                      "ids (12683) or names (N012031); without any: one a line from standard input");
  add_record_options(*command, trixel->records);
  command->footer(
      "Text: ID NAME LEVEL AREA_KM2, LAT LON of the centre and of three corners, names of three neighbours, "
      "the k-th\n"
      "across the edge opposite corner k. The area is that of the WGS84 surface whose normals lie in the "
      "trixel.\n"
      "Example: globe trixel N012031 --json");
  command->callback([trixel, &exit_status] {
    exit_status = answer_records(
        trixel->operands, trixel->records,
        "id,name,level,area_km2,lat,lon,lat_0,lon_0,lat_1,lon_1,lat_2,lon_2,neighbor_0,neighbor_1,neighbor_2",
        [&](const std::string& record) { return answer(record, trixel->records); });
  });
}

}  // namespace app
