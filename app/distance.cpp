#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/parse_options.h"
#include "app/point_pair.h"
#include "app/records.h"
#include "globe/base/error.h"
#include "globe/geo/geodesic.h"

namespace app {
namespace {

using globe::geo::Geodesic;

struct DistanceOptions {
  std::vector<std::string> points;
  std::string ellipsoid = "wgs84";
  RecordOptions records;
};

void append_numbers(std::string& line, std::initializer_list<double> numbers, char separator,
                    const std::optional<int>& precision) {
  for (const double number : numbers) {
    if (!line.empty()) line += separator;
    append_number(line, number, precision);
  }
}

std::string csv_line(const PointPair& pair, const Geodesic& geodesic, const std::optional<int>& precision) {
  const auto& a = pair.a.position;
  const auto& b = pair.b.position;
  std::string line;
  append_numbers(
      line,
      {a.lat_deg, shown_longitude(a.lon_deg, precision), b.lat_deg, shown_longitude(b.lon_deg, precision),
       geodesic.s12_m, geodesic.azi1_deg, geodesic.azi2_deg},
      ',', precision);
  return line;
}

std::string json_line(const PointPair& pair, const Geodesic& geodesic, const DistanceOptions& options) {
  const auto& precision = options.records.precision;
  const nlohmann::ordered_json object{{"lat1", shown(pair.a.position.lat_deg, precision)},
                                      {"lon1", shown_longitude(pair.a.position.lon_deg, precision)},
                                      {"lat2", shown(pair.b.position.lat_deg, precision)},
                                      {"lon2", shown_longitude(pair.b.position.lon_deg, precision)},
                                      {"s12_m", shown(geodesic.s12_m, precision)},
                                      {"azi1", shown(geodesic.azi1_deg, precision)},
                                      {"azi2", shown(geodesic.azi2_deg, precision)},
                                      {"ellipsoid", options.ellipsoid}};
  return object.dump();
}

std::string text_line(const Geodesic& geodesic, const std::optional<int>& precision) {
  std::string line;
  append_numbers(line, {geodesic.s12_m, geodesic.azi1_deg, geodesic.azi2_deg}, ' ', precision);
  return line;
}

int run(const DistanceOptions& options) {
  const globe::geo::GeodesicSolver solver(parse_ellipsoid(options.ellipsoid));
  const auto answer = [&](const std::string& record) {
    const PointPair pair = parse_point_pair(record);
    const Geodesic geodesic = solver.inverse(pair.a.position, pair.b.position);
    if (options.records.json) return json_line(pair, geodesic, options);
    if (options.records.csv) return csv_line(pair, geodesic, options.records.precision);
    return text_line(geodesic, options.records.precision);
  };
  return answer_records(pair_records(options.points), options.records, "lat1,lon1,lat2,lon2,s12_m,azi1,azi2",
                        answer, Threads::kAll);
}

}  // namespace

void add_distance(CLI::App& program, int& exit_status) {
  auto options = std::make_shared<DistanceOptions>();
  CLI::App* command =
      program.add_subcommand("distance", "the shortest path on the ellipsoid between two places");
  command->add_option("POINT", options->points,
                      "two points, \"LAT LON\" or LAT,LON each; without them: a pair a line from standard "
                      "input, LAT LON LAT LON or A ; B");
  command->add_option("--ellipsoid", options->ellipsoid, "wgs84, moon, mars or A,F")->capture_default_str();
  add_record_options(*command, options->records);
  command->footer(
      "Text: S12 AZI1 AZI2: metres along the geodesic, and its azimuths at A and at B, degrees clockwise "
      "from\n"
      "north, both forward.  An ALT is not looked at.  Error: 15 nm on WGS84 (Karney 2013, GeographicLib).\n"
      "Of several shortest paths the one by the north pole is taken.\n"
      "Example: globe distance \"52.5163 13.3777\" \"48.8583 2.2945\"");
  command->callback([options, &exit_status] { exit_status = run(*options); });
}

}  // namespace app
