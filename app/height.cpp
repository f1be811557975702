#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/interpolation_option.h"
#include "app/planet_argument.h"
#include "app/point.h"
#include "app/records.h"
#include "globe/base/error.h"
#include "globe/htm/trixel.h"
#include "globe/planet/drawn_ground.h"
#include "globe/planet/interpolation.h"

namespace app {
namespace {

using globe::planet::Interpolation;
using globe::planet::Surface;

constexpr const char* kSynthesised = "synthesised";
constexpr const char* kFilled = "filled";

struct HeightOptions {
  std::string planet;
  std::vector<std::string> points;
  std::optional<int> level;
  Interpolation interpolation = Interpolation::kLinear;
  bool drawn = false;
  RecordOptions records;
};

/// What one point is answered.
struct HeightAnswer {
  double lat_deg, lon_deg;
  int level;
  double height_m;
  std::string source;             ///< "data", the name of an inset, "filled" or "synthesised"
  std::optional<double> error_m;  ///< none where the ground is synthesised
  std::string datum;
};

std::string fields(const HeightAnswer& answer, const std::optional<int>& precision, char separator,
                   const std::string& unknown) {
  std::string line = number_text(answer.lat_deg, precision) + separator +
                     number_text(answer.lon_deg, precision) + separator + std::to_string(answer.level) +
                     separator + number_text(answer.height_m, precision) + separator + answer.source +
                     separator;
  line += answer.error_m ? number_text(*answer.error_m, precision) : unknown;
  return line + separator + answer.datum;
}

std::string json_line(const HeightAnswer& answer, const std::optional<int>& precision) {
  nlohmann::ordered_json object;
  object["lat"] = answer.lat_deg;
  object["lon"] = answer.lon_deg;
  object["level"] = answer.level;
  object["height_m"] = shown(answer.height_m, precision);
  object["source"] = answer.source;
  object["error_m"] = nullptr;
  if (answer.error_m) object["error_m"] = shown(*answer.error_m, precision);
  object["datum"] = answer.datum;
  return object.dump();
}

struct GroundHeight {
  double height_m, error_m;
};

GroundHeight height_of(const Surface& surface, const globe::geo::dvec3& u, int level,
                       const HeightOptions& options) {
  const bool by_data = !options.level && !options.drawn;
  const auto ground = by_data ? globe::planet::data_height_at(surface, u, options.interpolation)
                              : globe::planet::height_at(surface, u, level, options.interpolation);
  if (options.drawn) {
    const double drawn_m = globe::planet::drawn_ground(surface, u, level).height_m;
    return {drawn_m, std::abs(drawn_m - ground.height_m) + 0.5 * ground.spread_m};
  }
  const bool nearest = options.interpolation == Interpolation::kNearest;
  return {ground.height_m, nearest ? ground.spread_m : 0.5 * ground.spread_m};
}

/// What a height of a level is made of. Finer than the planet's own data, the rim of an inset has a share of
/// what is synthesised around it.
std::string source_of(const Surface& surface, const globe::geo::dvec3& u,
                      const globe::planet::DataSource& data, int level, const HeightOptions& options) {
  const bool by_data = !options.level && !options.drawn;
  const bool measured = by_data || level <= surface.data_level() || (level <= data.level && data.inset_alone);
  if (!surface.has_data() || !measured) return kSynthesised;
  if (!data.inset.empty()) return std::string(data.inset);
  return surface.is_filled(u, level) ? kFilled : "data";
}

int run(const HeightOptions& options) {
  const auto surface = open_planet(options.planet);
  require_heights(*surface, options.planet);
  warn_of_unknown_datum(*surface, options.planet);
  const auto& precision = options.records.precision;
  const auto answer = [&](const std::string& record) {
    const auto at = parse_point(record).position;
    const auto u = globe::geo::normal_from_degrees(at.lat_deg, at.lon_deg);
    const globe::planet::DataSource data = surface->data_at(u);
    const int level = options.level.value_or(data.level);
    const GroundHeight height = height_of(*surface, u, level, options);
    HeightAnswer result{shown(at.lat_deg, precision),
                        shown_longitude(at.lon_deg, precision),
                        level,
                        height.height_m,
                        source_of(*surface, u, data, level, options),
                        std::nullopt,
                        surface->info().vertical_datum};
    if (result.source != kSynthesised && result.source != kFilled) result.error_m = height.error_m;
    if (options.records.json) return json_line(result, precision);
    return options.records.csv ? fields(result, precision, ',', "") : fields(result, precision, ' ', "-");
  };
  return answer_records(options.points, options.records, "lat,lon,level,height_m,source,error_m,datum",
                        answer);
}

}  // namespace

void add_height(CLI::App& program, int& exit_status) {
  auto options = std::make_shared<HeightOptions>();
  CLI::App* command = program.add_subcommand("height", "the height of the ground at each point");
  command->add_option("PLANET", options->planet, "folder made by globe convert, or procedural[:SEED]")
      ->required();
  command->add_option("POINT", options->points,
                      "\"LAT LON\" or LAT,LON each; without points: one a line from standard input");
  command
      ->add_option(
          "--level", options->level,
          "HTM level (default: the data at their finest, those of insets in insets; procedural: the level of "
          "its own relief)")
      ->check(CLI::Range(0, globe::htm::kMaxLevel));
  CLI::Option* interpolation = add_interpolation_option(*command, options->interpolation);
  command
      ->add_flag("--drawn", options->drawn,
                 "of the flat trixel that is drawn, where the normal of the place meets it; the sea at 0")
      ->excludes(interpolation);
  add_record_options(*command, options->records);
  command->footer(
      "Text: LAT LON LEVEL HEIGHT_M SOURCE ERROR_M DATUM.  An ALT is not looked at.\n"
      "SOURCE is data, the name of an inset (also in its rim, where it is blended with the data around it), "
      "filled\n"
      "(no map had a value here, of planets made by convert --voids mark), or\n"
      "synthesised: levels finer than the data add made-up detail, and procedural has no data at all.\n"
      "ERROR_M tells how well the samples bound the ground between them: half the difference between the\n"
      "highest and the lowest corner of the trixel (all of it for nearest); with --drawn also how far the "
      "flat\n"
      "trixel lies from the ground between its corners.  It says nothing of errors in the map itself; - "
      "(null)\n"
      "where the ground is filled or synthesised.\n"
      "Example: globe height my-planet --json \"27.99 86.92\"");
  command->callback([options, &exit_status] { exit_status = run(*options); });
}

}  // namespace app
