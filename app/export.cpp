#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/converter_command.h"
#include "app/parse_options.h"
#include "app/planet_argument.h"
#include "app/progress.h"
#include "converters/export_map.h"
#include "converters/export_mesh.h"
#include "converters/resources.h"
#include "globe/base/error.h"
#include "globe/base/pending_file.h"

namespace app {
namespace {

using globe::UsageError;

constexpr int kMaxExportLevel = 24;
constexpr int kLeastMemory_mb = 256;
constexpr std::size_t kEnoughBytes = std::size_t{1} << 30;  ///< of a cache

/// The command line as it was typed.
struct ExportArguments {
  std::string planet;
  std::string output;
  std::string layer;
  std::string size;
  std::string extent;
  std::string range;
  std::string filter;
  std::optional<int> level;
  std::optional<double> nodata;
  std::optional<int> memory_mb;
  int threads = 0;
  bool overwrite = false;
  bool quiet = false;
  std::string progress;
};

converters::MapSize parse_map_size(const std::string& text) {
  const std::vector<double> sides = parse_numbers(text, 'x');
  const auto is_side = [](double side) { return side >= 1 && side <= 1e9 && side == std::floor(side); };
  if (sides.size() != 2 || !is_side(sides[0]) || !is_side(sides[1])) {
    throw UsageError("--size", "'" + text + "' is not a size in pixels", "write WxH, such as 3600x1800");
  }
  return {static_cast<int>(sides[0]), static_cast<int>(sides[1])};
}

/// As parse_extent; W above E runs across longitude 180.
converters::Extent parse_part(const std::string& text) {
  std::vector<double> sides = parse_numbers(text, ',');
  if (sides.size() == 4 && sides[0] > sides[2]) sides[2] += 360.0;
  if (sides.size() != 4 || sides[0] >= sides[2] || sides[2] - sides[0] > 360.0 || sides[1] >= sides[3] ||
      sides[1] < -90.0 || sides[3] > 90.0) {
    throw UsageError("--extent", "'" + text + "' is not W,S,E,N with S < N, at most 360 degrees wide",
                     "give degrees such as 5.9,45.8,10.5,47.8");
  }
  return {sides[0], sides[1], sides[2], sides[3]};
}

std::pair<double, double> parse_range(const std::string& text) {
  const std::vector<double> ends = parse_numbers(text, ',');
  if (ends.size() != 2 || ends[0] >= ends[1]) {
    throw UsageError("--range", "'" + text + "' is not LO,HI with LO < HI",
                     "give metres such as --range=-500,8848");
  }
  return {ends[0], ends[1]};
}

converters::ExportOptions options_from(const ExportArguments& arguments) {
  static const std::map<std::string, converters::Sampling> filters{
      {"nearest", converters::Sampling::kNearest},
      {"linear", converters::Sampling::kLinear},
      {"cubic", converters::Sampling::kCubic},
      {"area", converters::Sampling::kArea}};
  converters::ExportOptions options;
  options.output = arguments.output;
  if (!arguments.layer.empty()) {
    options.content =
        arguments.layer == "height" ? converters::MapContent::kHeights : converters::MapContent::kColors;
  }
  if (!arguments.extent.empty()) options.extent = parse_part(arguments.extent);
  if (!arguments.size.empty()) options.size = parse_map_size(arguments.size);
  options.level = arguments.level;
  if (!arguments.filter.empty()) options.sampling = filters.at(arguments.filter);
  if (!arguments.range.empty()) options.range = parse_range(arguments.range);
  options.nodata = arguments.nodata;
  options.threads = arguments.threads;
  options.overwrite = arguments.overwrite;
  return options;
}

/// A mesh is a part of the planet, of heights, as its level has them.
void require_mesh_options(const ExportArguments& arguments) {
  if (arguments.extent.empty()) {
    throw UsageError(arguments.output, "a mesh shows a part of the planet", "give --extent W,S,E,N");
  }
  if (arguments.nodata) throw UsageError("--nodata", "means nothing to a mesh", "leave it out");
  for (const auto& [option, text] :
       {std::pair{"--layer", arguments.layer}, std::pair{"--range", arguments.range},
        std::pair{"--filter", arguments.filter}}) {
    if (!text.empty()) throw UsageError(option, "means nothing to a mesh", "leave it out");
  }
}

void run(const ExportArguments& arguments) {
  converters::ExportOptions options = options_from(arguments);
  const bool is_mesh = options.output.extension() == ".glb";
  if (is_mesh) require_mesh_options(arguments);
  globe::refuse_existing(options.output, options.overwrite);
  // For tiles as they are stored, for ground made of them, for pixels on their way.
  const std::size_t share =
      (converters::memory_cap(static_cast<std::size_t>(arguments.memory_mb.value_or(0)) << 20) -
       converters::kReservedBytes) /
      3;
  const auto surface =
      open_planet(arguments.planet, std::min(share, kEnoughBytes), std::min(share, kEnoughBytes));
  options.memory_bytes = share;
  Progress progress(progress_style(arguments.quiet, arguments.progress == "json"));
  const converters::ConvertListener listener = listener_of(progress, arguments.quiet);
  if (is_mesh) {
    converters::export_mesh(surface, options, listener);
  } else {
    converters::export_map(surface, options, listener);
  }
}

}  // namespace

void add_export(CLI::App& program) {
  const auto arguments = std::make_shared<ExportArguments>();
  CLI::App* command = program.add_subcommand("export", "Make a latitude-longitude map of a planet");
  command->add_option("PLANET", arguments->planet, "folder made by globe convert, or procedural[:SEED]")
      ->required();
  command
      ->add_option("-o,--output", arguments->output,
                   "the map to make: .tif (GeoTIFF), .png or .exr; .glb: a local mesh")
      ->required();
  command
      ->add_option("--layer", arguments->layer,
                   "height or color (default: color for a .png of a planet that has colors, else height)")
      ->check(CLI::IsMember({"height", "color"}));
  command->add_option("--size", arguments->size,
                      "WxH in pixels (default: one for each cell of the level along the equator)");
  command->add_option("--extent", arguments->extent, "W,S,E,N in degrees (default -180,-90,180,90)");
  command->add_option("--range", arguments->range,
                      "LO,HI: metres of 0 and 65535 in a .png of heights (default: the planet's range)");
  command
      ->add_option("--level", arguments->level,
                   "HTM level to read (default: the data's; finer ones are synthesised)")
      ->check(CLI::Range(0, kMaxExportLevel));
  command
      ->add_option("--filter", arguments->filter,
                   "nearest, linear (in the trixel), cubic or area (mean over the pixel);\n"
                   "default: area where pixels are larger than cells, else linear")
      ->check(CLI::IsMember({"nearest", "linear", "cubic", "area"}));
  command->add_option(
      "--nodata", arguments->nodata,
      "metres (or nan) where no map had a height, of a planet converted with --voids mark; .tif");
  command
      ->add_option("--memory", arguments->memory_mb, "MB to use, at least 256 (default: half the machine's)")
      ->check(CLI::Range(kLeastMemory_mb, 1 << 24));
  command->add_option("--threads", arguments->threads, "default: all cores")->check(CLI::Range(1, 1024));
  command->add_flag("--overwrite", arguments->overwrite, "replace an existing map");
  command->add_flag("--quiet", arguments->quiet, "warnings and errors only");
  command->add_option("--progress", arguments->progress, "json: a line for each percent, on standard error")
      ->check(CLI::IsMember({"json"}));
  command->footer(
      "A .tif holds heights as float metres or colors as sRGB bytes, its place and coordinate system; a "
      ".png\n"
      "colors as sRGB bytes or heights as 16 bits; an .exr float metres or linear light.\n"
      "A .glb is the ground of --extent (at most 90 degrees each way) as one mesh of trixels, metres around "
      "its\n"
      "middle (x east, y up, z south), with the colors as a picture of --size.\n"
      "Example: globe export my-planet -o alps.tif --extent 5,43,17,49");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace app
