#include "app/inset.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/converter_command.h"
#include "app/map_options.h"
#include "app/planet_argument.h"
#include "app/point.h"
#include "app/progress.h"
#include "converters/inset.h"
#include "globe/base/error.h"
#include "globe/planet/planet_file.h"

namespace app {
namespace {

/// The command line as it was typed.
struct InsetArguments {
  std::string planet;
  std::vector<std::string> heights;
  std::vector<std::string> colors;
  MapOptions of_maps;
  std::string name;
  int level = -1;
  std::string filter;
  std::string rim;
  std::vector<std::string> credits;
  int memory_mb = 0;
  int threads = 0;
  bool overwrite = false;
  bool quiet = false;
  std::string progress;
};

/// The first file's name without what a name of an inset may not have.
std::string name_from(const std::string& path) {
  std::string name;
  for (const char c : std::filesystem::path(path).stem().string()) {
    const bool allowed = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                         c == '.' || c == '_' || c == '-';
    name += allowed && !(name.empty() && c == '.') ? c : '_';
  }
  return name.substr(0, 64);
}

converters::InsetOptions options_from(const InsetArguments& arguments) {
  if (procedural_seed(arguments.planet)) {
    throw globe::UsageError(arguments.planet,
                            "the built-in planet lies in no folder that could hold an inset",
                            "make a planet by globe convert");
  }
  converters::InsetOptions options;
  options.planet = arguments.planet;
  options.heights = maps_of(arguments.heights);
  options.colors = maps_of(arguments.colors);
  if (options.heights.empty() && options.colors.empty())
    throw globe::UsageError("inset", "no data given", "give a DEM, --color IMAGE, or both");
  apply_map_options(arguments.of_maps, options.heights, options.colors);
  options.name = !arguments.name.empty() ? arguments.name
                                         : name_from(arguments.heights.empty() ? arguments.colors.front()
                                                                               : arguments.heights.front());
  if (arguments.level >= 0) options.level = arguments.level;
  if (!arguments.filter.empty()) options.filter = filter_named(arguments.filter);
  if (!arguments.rim.empty()) {
    options.rim_m = parse_length_m(arguments.rim);
    if (!(*options.rim_m > 0.0))
      throw globe::UsageError("--rim " + arguments.rim, "is no width", "give one such as 2km");
  }
  options.credits = arguments.credits;
  options.memory_bytes = static_cast<std::size_t>(arguments.memory_mb) << 20;
  options.threads = arguments.threads;
  options.overwrite = arguments.overwrite;
  options.program_version = version();
  return options;
}

void inset(const InsetArguments& arguments) {
  const converters::InsetOptions options = options_from(arguments);
  Progress progress(progress_style(arguments.quiet, arguments.progress == "json"));
  const converters::ConvertListener listener = listener_of(progress, arguments.quiet);
  converters::lay_inset(options, listener);
}

}  // namespace

void add_inset(CLI::App& program) {
  const auto arguments = std::make_shared<InsetArguments>();
  CLI::App* command = program.add_subcommand("inset", "Lay finer local data over a planet");
  command->add_option("PLANET", arguments->planet, "folder made by globe convert")->required();
  command->add_option(
      "DEM", arguments->heights,
      "height maps of a part of the planet, of any kind and projection GDAL reads; later ones over "
      "earlier ones");
  command->add_option("--color", arguments->colors, "color maps, likewise")->expected(1, -1);
  command->add_option("--name", arguments->name, "what the inset is called (default: as the first file)");
  command
      ->add_option("--level", arguments->level,
                   "HTM level of the heights (default: the smallest that is as fine as their samples)")
      ->check(CLI::Range(0, 24));
  command->add_option(
      "--rim", arguments->rim,
      "how wide it is blended into what lies around, such as 2km (default: eight times as wide as its "
      "heights "
      "are from the planet's on average, at most a quarter of its width; of colors a sixteenth)");
  command
      ->add_option("--filter", arguments->filter,
                   "default: area where the map is finer than the grid, else bilinear")
      ->check(CLI::IsMember({"nearest", "bilinear", "bicubic", "area"}));
  add_map_options(*command, arguments->of_maps);
  command->add_option("--credit", arguments->credits, "a line for the planet's credits")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  command->add_option("--memory", arguments->memory_mb, "MB to use, at least 256 (default: half)")
      ->check(CLI::Range(256, 1 << 24));
  command->add_option("--threads", arguments->threads, "default: all cores")->check(CLI::Range(1, 1024));
  command->add_flag("--overwrite", arguments->overwrite, "replace an inset of the same name");
  command->add_flag("--quiet", arguments->quiet, "warnings and errors only");
  command->add_option("--progress", arguments->progress, "json: a line for each percent, on standard error")
      ->check(CLI::IsMember({"json"}));
  command->footer(
      "The planet is changed in place, whole at every moment. An inset lies over the planet and over the "
      "insets laid\n"
      "before; every command draws it and answers from it. Voids narrower than a cell of the planet's own "
      "data are\n"
      "filled from their borders, wider ones show what lies below. Where a DEM has 0 for sea, --nodata 0 "
      "keeps the\n"
      "planet's own sea floor.\n"
      "Example: globe inset earth rainier.tif --name rainier");
  command->callback([arguments] { inset(*arguments); });
}

}  // namespace app
