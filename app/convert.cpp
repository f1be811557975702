#include "app/convert.h"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "app/commands.h"
#include "app/mpi_team.h"
#include "app/parse_options.h"
#include "app/progress.h"
#include "converters/convert.h"
#include "globe/base/error.h"

namespace app {
namespace {

constexpr int kMaxConvertLevel = 20;

/// The command line as it was typed.
struct Arguments {
  std::vector<std::string> heights;
  std::vector<std::string> colors;
  std::string planet;
  int level = -1;
  std::string filter;
  std::string ellipsoid;
  std::string latitude = "geodetic";
  std::vector<std::string> extents;
  std::vector<std::string> registrations;
  std::vector<std::string> systems;
  std::vector<std::string> scales;
  std::vector<std::string> offsets;
  std::vector<std::string> units;
  std::vector<std::string> nodata;
  std::string voids = "fill";
  std::string geoid;
  std::string datum;
  std::vector<std::string> credits;
  int memory_mb = 0;
  int threads = 0;
  bool list_jobs = false;
  int job = -1;
  bool overwrite = false;
  bool quiet = false;
  std::string progress;
};

/// Gives maps what an option says of them: once, it is for all height maps (for all color maps when there are
/// no height maps); twice, when there are both, for the height maps, then for the color maps; or it comes
/// once for each map, height maps first. "auto" leaves a map to its file.
template <typename T, typename Parse>
void assign(const std::vector<std::string>& texts, const std::string& option,
            std::optional<T> converters::MapInput::*member, converters::ConvertOptions& options,
            const Parse& parse) {
  std::vector<converters::MapInput>& heights = options.heights;
  std::vector<converters::MapInput>& colors = options.colors;
  const std::size_t maps = heights.size() + colors.size();
  const bool by_kind = texts.size() == 2 && !heights.empty() && !colors.empty();
  if (texts.size() > 1 && texts.size() != maps && !by_kind) {
    throw globe::UsageError(
        option, "given " + std::to_string(texts.size()) + " times for " + std::to_string(maps) + " maps",
        "give it once, once for heights and once for colors, or once for each map, heights first");
  }
  const auto set = [&](converters::MapInput& map, const std::string& text) {
    if (text != "auto") map.*member = parse(text);
  };
  for (std::size_t k = 0; k < maps && !texts.empty(); ++k) {
    const bool is_height = k < heights.size();
    converters::MapInput& map = is_height ? heights[k] : colors[k - heights.size()];
    if (texts.size() == maps) {
      set(map, texts[k]);
    } else if (texts.size() == 2) {
      set(map, texts[is_height ? 0 : 1]);
    } else if (is_height || heights.empty()) {
      set(map, texts.front());
    }
  }
}

/// Reads the number of an option; `example` is one.
std::function<double(const std::string&)> number_for(const std::string& option, const std::string& example) {
  return [=](const std::string& text) {
    const std::optional<double> number = parse_number(text);
    if (number) return *number;
    throw globe::UsageError(option, "'" + text + "' is not a number", "give a value such as " + example);
  };
}

std::vector<converters::MapInput> maps_of(const std::vector<std::string>& paths) {
  std::vector<converters::MapInput> maps;
  for (const std::string& path : paths) maps.push_back({path});
  return maps;
}

converters::ConvertOptions options_from(const Arguments& arguments) {
  static const std::map<std::string, converters::Filter> filters{{"nearest", converters::Filter::kNearest},
                                                                 {"bilinear", converters::Filter::kBilinear},
                                                                 {"bicubic", converters::Filter::kBicubic},
                                                                 {"area", converters::Filter::kArea}};
  converters::ConvertOptions options;
  options.heights = maps_of(arguments.heights);
  options.colors = maps_of(arguments.colors);
  if (options.heights.empty() && options.colors.empty()) {
    throw globe::UsageError("convert", "no map given", "give a height map, --color MAP, or both");
  }
  using converters::MapInput;
  const auto as_it_is = [](const std::string& text) { return text; };
  assign(arguments.extents, "--extent", &MapInput::extent, options, parse_extent);
  assign(arguments.registrations, "--registration", &MapInput::registration, options,
         [](const std::string& text) {
           return text == "area" ? converters::Registration::kArea : converters::Registration::kPoint;
         });
  assign(arguments.systems, "--crs", &MapInput::crs, options, as_it_is);
  assign(arguments.units, "--units", &MapInput::unit, options, as_it_is);
  assign(arguments.scales, "--scale", &MapInput::scale, options, number_for("--scale", "0.1"));
  assign(arguments.offsets, "--offset", &MapInput::offset, options, number_for("--offset", "-10000"));
  assign(arguments.nodata, "--nodata", &MapInput::nodata, options, number_for("--nodata", "-9999 or nan"));
  options.planet = arguments.planet;
  if (arguments.level >= 0) options.level = arguments.level;
  if (!arguments.filter.empty()) options.filter = filters.at(arguments.filter);
  if (!arguments.ellipsoid.empty()) options.ellipsoid = parse_ellipsoid(arguments.ellipsoid);
  options.latitude =
      arguments.latitude == "geodetic" ? converters::Latitude::kGeodetic : converters::Latitude::kGeocentric;
  options.voids = arguments.voids == "fill" ? converters::Gaps::kFill : converters::Gaps::kZero;
  options.geoid = arguments.geoid;
  if (!arguments.datum.empty()) options.datum = arguments.datum;
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

void convert(const Arguments& arguments) {
  const converters::ConvertOptions options = options_from(arguments);
  Progress progress(progress_style(arguments.quiet, arguments.progress == "json"));
  const auto print = [&](const std::string& text) {
    progress.clear();
    std::fprintf(stderr, "globe: %s\n", text.c_str());
  };
  converters::ConvertListener listener;
  if (!arguments.quiet) listener.note = print;
  listener.warning = [&](const std::string& text) { print("warning: " + text); };
  listener.progress = [&](const std::string& stage, double fraction) { progress.show(stage, fraction); };
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
  const auto arguments = std::make_shared<Arguments>();
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
  // What is said of maps, in place of what their files say.
  const auto of_maps = [&](const char* name, std::vector<std::string>& texts, const std::string& help) {
    return command->add_option(name, texts, help)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->delimiter('\0')
        ->group(
            "Of maps (once for all height maps, again for color maps; or once for each; auto: as the file "
            "says)");
  };
  of_maps("--extent", arguments->extents, "W,S,E,N in degrees");
  of_maps("--registration", arguments->registrations, "whether coordinates mean edges or samples")
      ->check(CLI::IsMember({"area", "point", "auto"}));
  of_maps("--crs", arguments->systems, "coordinate reference system: EPSG:32610, or a text of PROJ or WKT");
  of_maps("--nodata", arguments->nodata, "raw value that means no data");
  of_maps("--scale", arguments->scales, "of heights: raw * scale + offset");
  of_maps("--offset", arguments->offsets, "in the unit of --units");
  of_maps("--units", arguments->units, "of heights")->check(CLI::IsMember({"m", "ft", "us-ft", "auto"}));
  command
      ->add_option(
          "--voids", arguments->voids,
          "what voids get that no earlier map has values for: fill (from around them; default), zero")
      ->check(CLI::IsMember({"fill", "zero"}));
  command->add_option("--geoid", arguments->geoid,
                      "grid of geoid heights to add: heights are then above the ellipsoid. A raster, a .pgm "
                      "of GeographicLib, or an installed one's name (egm96-5)");
  command->add_option("--datum", arguments->datum, "name of the heights' vertical datum");
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
