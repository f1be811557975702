#include "app/convert.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "app/commands.h"
#include "app/converter_command.h"
#include "app/map_options.h"
#include "app/mpi_team.h"
#include "app/parse_options.h"
#include "app/progress.h"
#include "converters/convert.h"
#include "globe/base/error.h"

namespace app {
namespace {

constexpr int kMaxConvertLevel = 20;

/// The command line as it was typed.
struct ConvertArguments {
  std::vector<std::string> heights;
  std::vector<std::string> colors;
  std::string planet;
  int level = -1;
  std::string filter;
  std::string ellipsoid;
  std::string latitude = "geodetic";
  MapOptions of_maps;
  std::string voids = "fill";
  std::string geoid;
  std::string datum;
  std::vector<std::string> credits;
  int memory_mb = 0;
  int threads = 0;
  bool list_jobs = false;
  int job = -1;
  bool as_thesis = false;
  bool overwrite = false;
  bool quiet = false;
  std::string progress;
};

converters::ConvertOptions options_from(const ConvertArguments& arguments) {
  converters::ConvertOptions options;
  options.heights = maps_of(arguments.heights);
  options.colors = maps_of(arguments.colors);
  if (options.heights.empty() && options.colors.empty()) {
    throw globe::UsageError("convert", "no map given", "give a height map, --color MAP, or both");
  }
  apply_map_options(arguments.of_maps, options.heights, options.colors);
  options.planet = arguments.planet;
  if (arguments.level >= 0) options.level = arguments.level;
  if (!arguments.filter.empty()) options.filter = filter_named(arguments.filter);
  if (!arguments.ellipsoid.empty()) options.ellipsoid = parse_ellipsoid(arguments.ellipsoid);
  options.latitude =
      arguments.latitude == "geodetic" ? converters::Latitude::kGeodetic : converters::Latitude::kGeocentric;
  options.voids = arguments.voids == "zero" ? converters::Gaps::kZero : converters::Gaps::kFill;
  options.mark_voids = arguments.voids == "mark";
  options.geoid = arguments.geoid;
  if (!arguments.datum.empty()) options.datum = arguments.datum;
  options.as_thesis = arguments.as_thesis;
  options.credits = arguments.credits;
  options.memory_bytes = static_cast<std::size_t>(arguments.memory_mb) << 20;
  options.threads = arguments.threads;
  options.overwrite = arguments.overwrite;
  options.program_version = version();
  return options;
}

/// The first member speaks for all. A failure is told here: with the team's end the process ends.
void convert_with_mpi(converters::ConvertOptions options, const converters::ConvertListener& listener) {
  const MpiPlace place = mpi_place();
  const bool first = place.rank == 0;
  if (options.threads == 0) {
    options.threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / place.local_size);
  }
  constexpr std::size_t kLists = 2;  // heights and colors
  const std::unique_ptr<converters::Team> team = make_mpi_team(kLists);
  try {
    converters::convert_with(*team, options, first ? listener : converters::ConvertListener{});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "globe: %s\n", error.what());
    throw;
  }
}

void convert(const ConvertArguments& arguments) {
  const converters::ConvertOptions options = options_from(arguments);
  Progress progress(progress_style(arguments.quiet, arguments.progress == "json"));
  const converters::ConvertListener listener = listener_of(progress, arguments.quiet);
  if (arguments.list_jobs) {
    const std::vector<converters::Job> jobs = converters::list_jobs(options, listener);
    progress.clear();
    for (std::size_t k = 0; k < jobs.size(); ++k) std::printf("%zu %s\n", k, name_of(jobs[k]).c_str());
  } else if (arguments.job >= 0) {
    converters::convert_job(arguments.job, options, listener);
  } else if (mpi_place().size > 1) {
    convert_with_mpi(options, listener);
  } else {
    converters::convert(options, listener);
  }
}

}  // namespace

void add_convert(CLI::App& program, int& exit_status) {
  static_cast<void>(exit_status);
  const auto arguments = std::make_shared<ConvertArguments>();
  CLI::App* command = program.add_subcommand("convert", "Make a planet of maps");
  command->add_option(
      "heights", arguments->heights,
      "height maps: rasters of any kind GDAL or OpenImageIO reads, later ones over earlier ones");
  command->add_option("--color", arguments->colors, "color maps, likewise")->expected(1, -1);
  command->add_option("-o,--output", arguments->planet, "the planet folder to make")->required();
  command
      ->add_option("--level", arguments->level,
                   "finest level of the heights (default: that of the finest map of the whole planet)")
      ->check(CLI::Range(0, kMaxConvertLevel));
  command
      ->add_option("--filter", arguments->filter,
                   "default: area where the map is finer than the grid, else bilinear")
      ->check(CLI::IsMember({"nearest", "bilinear", "bicubic", "area"}));
  command->add_option("--ellipsoid", arguments->ellipsoid, "wgs84, moon, mars or A,F (F also 1/298.257)");
  command->add_option("--latitude", arguments->latitude, "what the map's rows count")
      ->check(CLI::IsMember({"geodetic", "geocentric"}));
  add_map_options(*command, arguments->of_maps);
  command
      ->add_option(
          "--voids", arguments->voids,
          "what voids get that no earlier map has values for: fill (from around them; default), mark\n"
          "(the same, and heights are known as filled from then on), zero")
      ->check(CLI::IsMember({"fill", "mark", "zero"}));
  command->add_option("--geoid", arguments->geoid,
                      "grid of geoid heights to add: heights are then above the ellipsoid. A raster, a .pgm "
                      "of GeographicLib, or an installed one's name (egm96-5)");
  command->add_option("--datum", arguments->datum, "name of the heights' vertical datum");
  command->add_flag("--as-thesis", arguments->as_thesis,
                    "take rows for linear in latitude, as the thesis does: up to 1083 km off, to compare");
  command->add_option("--credit", arguments->credits, "a line for the planet's credits")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command
      ->add_option("--memory", arguments->memory_mb,
                   "MB to use, at least 256; more goes to disk (default: half)")
      ->check(CLI::Range(256, 1 << 24));
  command->add_option("--threads", arguments->threads, "default: all cores")->check(CLI::Range(1, 1024));
  CLI::Option* list = command->add_flag(
      "--jobs", arguments->list_jobs, "list the jobs the conversion falls into: number, layer, diamond, row");
  command
      ->add_option("--job", arguments->job,
                   "do this one; many processes may do one each, the last one finishes the planet")
      ->check(CLI::NonNegativeNumber)
      ->excludes(list);
  command->add_flag("--overwrite", arguments->overwrite, "replace an existing planet");
  command->add_flag("--quiet", arguments->quiet, "warnings and errors only");
  command->add_option("--progress", arguments->progress, "json: a line for each percent, on standard error")
      ->check(CLI::IsMember({"json"}));
  command->callback([arguments] { convert(*arguments); });
}

}  // namespace app
