#include "globe/planet/profile.h"

#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/interpolation_option.h"
#include "app/planet_argument.h"
#include "app/point.h"
#include "app/profile_plot.h"
#include "app/records.h"
#include "globe/base/error.h"
#include "globe/base/pending_file.h"
#include "globe/htm/trixel.h"

namespace app {
namespace {

using globe::geo::Geodetic;
using globe::planet::Interpolation;
using globe::planet::ProfileSample;
using globe::planet::Surface;

struct ProfileOptions {
  std::string planet, a, b;
  std::optional<std::size_t> count;
  std::optional<int> level;
  Interpolation interpolation = Interpolation::kLinear;
  bool json = false, csv = false;
  std::optional<int> precision;
  std::string output, title;
  bool overwrite = false;
};

std::string table_line(const ProfileSample& sample, char separator, const std::optional<int>& precision) {
  std::string line;
  append_number(line, sample.distance_m, precision);
  append_number(line += separator, sample.place.lat_deg, precision);
  append_number(line += separator, shown_longitude(sample.place.lon_deg, precision), precision);
  append_number(line += separator, sample.height_m, precision);
  return line;
}

std::string json_line(const ProfileSample& sample, const std::optional<int>& precision) {
  const nlohmann::ordered_json object{{"distance_m", shown(sample.distance_m, precision)},
                                      {"lat", shown(sample.place.lat_deg, precision)},
                                      {"lon", shown_longitude(sample.place.lon_deg, precision)},
                                      {"height_m", shown(sample.height_m, precision)}};
  return object.dump();
}

void write_samples(const std::vector<ProfileSample>& samples, const ProfileOptions& options) {
  if (options.csv) std::puts("distance_m,lat,lon,height_m");
  for (const ProfileSample& sample : samples) {
    const std::string line = options.json ? json_line(sample, options.precision)
                                          : table_line(sample, options.csv ? ',' : ' ', options.precision);
    std::fwrite((line + '\n').data(), 1, line.size() + 1, stdout);
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw globe::Error("standard output", "could not be written", "check that the disk is not full");
}

/// "28.6139° N, 77.2090° E"
std::string place_text(const Geodetic& place) {
  const auto angle = [](double degrees, char positive, char negative) {
    return number_text(std::abs(degrees), 4) + "° " + (degrees < 0.0 ? negative : positive);
  };
  return angle(place.lat_deg, 'N', 'S') + ", " + angle(place.lon_deg, 'E', 'W');
}

ProfilePlot plot_of(const std::vector<ProfileSample>& samples, const ProfileOptions& options,
                    const Surface& surface, const globe::planet::DataLevels& levels) {
  const std::string places = place_text(samples.front().place) + "  to  " + place_text(samples.back().place);
  const double km = samples.back().distance_m / 1000.0;
  ProfilePlot plot;
  plot.title = options.title.empty() ? places : options.title;
  if (!options.title.empty()) plot.subtitle = places + " · ";
  plot.subtitle += number_text(km, km >= 100.0 ? 0 : 2) + " km · " + surface.info().name + ", level " +
                   std::to_string(levels.coarsest) +
                   (levels.finest > levels.coarsest ? " to " + std::to_string(levels.finest) : "") +
                   " · datum: " + surface.info().vertical_datum;
  plot.sea = surface.has_sea();
  return plot;
}

void run(const ProfileOptions& options) {
  const Geodetic a = parse_point(options.a).position, b = parse_point(options.b).position;
  if (!options.output.empty()) {
    require_plot_name(options.output);
    globe::refuse_existing(options.output, options.overwrite);
  }
  const auto surface = open_planet(options.planet);
  require_heights(*surface, options.planet);
  warn_of_unknown_datum(*surface, options.planet);
  const globe::planet::DataLevels levels = options.level
                                               ? globe::planet::DataLevels{*options.level, *options.level}
                                               : globe::planet::data_levels_along(*surface, a, b);
  const std::size_t count =
      options.count.value_or(globe::planet::profile_count(*surface, a, b, levels.finest));
  const auto samples = globe::planet::profile(*surface, a, b, count, options.level, options.interpolation);
  if (!options.output.empty()) {
    if (samples.back().distance_m == 0.0) {
      throw globe::UsageError(options.output, "A and B are the same place, there is nothing to draw",
                              "give two places");
    }
    draw_profile(options.output, samples, plot_of(samples, options, *surface, levels), options.overwrite);
  }
  if (options.output.empty() || options.json || options.csv) write_samples(samples, options);
}

}  // namespace

void add_profile(CLI::App& program) {
  auto options = std::make_shared<ProfileOptions>();
  CLI::App* command = program.add_subcommand("profile", "heights along the geodesic between two places");
  command->add_option("PLANET", options->planet, "folder made by globe convert, or procedural[:SEED]")
      ->required();
  command->add_option("A", options->a, "where it begins, \"LAT LON\" or LAT,LON")->required();
  command->add_option("B", options->b, "where it ends")->required();
  command
      ->add_option("--count", options->count,
                   "samples, at equal distances, A and B among them (default: two a grid edge, 512 to 65536)")
      ->check(CLI::Range(std::size_t{2}, std::size_t{10000000}));
  command
      ->add_option(
          "--level", options->level,
          "HTM level (default: the data at their finest, those of insets in insets; procedural: the level of "
          "its own relief)")
      ->check(CLI::Range(0, globe::htm::kMaxLevel));
  add_interpolation_option(*command, options->interpolation);
  CLI::Option* json = command->add_flag("--json", options->json, "one JSON object a sample");
  command->add_flag("--csv", options->csv, "a table with a header line")->excludes(json);
  command
      ->add_option("--precision", options->precision,
                   "decimals of every number with a fraction (default: all)")
      ->check(CLI::Range(0, 17));
  command->add_option("-o,--output", options->output,
                      "draw it, as .svg or .png, instead of writing samples (with --json or --csv: as well)");
  command->add_option("--title", options->title, "of the drawing (default: the coordinates of A and B)");
  command->add_flag("--overwrite", options->overwrite, "replace an existing drawing");
  command->footer(
      "Text: DISTANCE_M LAT LON HEIGHT_M.  The geodesic is the shortest path on the planet's ellipsoid; "
      "between\n"
      "opposite places the one by the north pole.  An ALT is not looked at.  Heights are those of globe "
      "height.\n"
      "Drawings need gnuplot (Debian: gnuplot-nox).\n"
      "Example: globe profile my-planet 28.6139,77.2090 29.6520,91.1721 --title \"Delhi to Lhasa\" -o "
      "lhasa.svg");
  command->callback([options] { run(*options); });
}

}  // namespace app
