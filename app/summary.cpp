#include "globe/planet/summary.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/commands.h"
#include "app/planet_argument.h"
#include "app/records.h"
#include "app/region_options.h"
#include "globe/base/error.h"
#include "globe/htm/trixel.h"

namespace app {
namespace {

using globe::planet::HeightAt;
using globe::planet::RegionSummary;
using nlohmann::ordered_json;

struct SummaryCommand {
  std::string planet;
  RegionOptions region;
  std::optional<int> level;
  bool json = false;
  std::optional<int> precision;
};

ordered_json to_json(const std::optional<RegionSummary>& found, const std::optional<int>& precision) {
  const auto place = [&](const HeightAt& height) {
    const auto at = globe::geo::degrees_from_normal(height.at);
    return ordered_json{shown(at.lat_deg, precision), shown_longitude(at.lon_deg, precision)};
  };
  ordered_json object{{"min_m", nullptr},  {"mean_m", nullptr}, {"max_m", nullptr}, {"min_at", nullptr},
                      {"max_at", nullptr}, {"area_km2", 0.0},   {"samples", 0}};
  if (!found) return object;
  object["min_m"] = shown(found->lowest.height_m, precision);
  object["mean_m"] = shown(found->mean_m, precision);
  object["max_m"] = shown(found->highest.height_m, precision);
  object["min_at"] = place(found->lowest);
  object["max_at"] = place(found->highest);
  object["area_km2"] = shown(found->area_m2 / 1e6, precision);
  object["samples"] = found->samples;
  return object;
}

/// A line a number, heights with the latitude and longitude of their place; - where there is none.
std::string to_text(const ordered_json& object, const std::optional<int>& precision) {
  std::string text;
  const auto number = [&](const ordered_json& value) {
    return value.is_null() ? "-" : number_text(value.get<double>(), precision);
  };
  for (const char* name : {"min_m", "mean_m", "max_m", "area_km2"}) {
    const std::string place = name == std::string("min_m")   ? "min_at"
                              : name == std::string("max_m") ? "max_at"
                                                             : "";
    text += name + (' ' + number(object[name]));
    if (!place.empty() && !object[place].is_null())
      text += ' ' + number(object[place][0]) + ' ' + number(object[place][1]);
    text += '\n';
  }
  text += "samples " + std::to_string(object["samples"].get<std::uint64_t>()) + '\n';
  text += "level " + std::to_string(object["level"].get<int>()) + '\n';
  text += "source " + object["source"].get<std::string>() + '\n';
  return text + "datum " + object["datum"].get<std::string>() + '\n';
}

void run(const SummaryCommand& command) {
  if (!command.region.any()) refuse_missing_region("summary");
  const auto surface = open_planet(command.planet);
  require_heights(*surface, command.planet);
  const auto region = make_region(command.region, surface->ellipsoid());
  warn_of_unknown_datum(*surface, command.planet);
  const auto found = globe::planet::summarize(*surface, *region, command.level);
  ordered_json object = to_json(found, command.precision);
  object["level"] = found ? found->level : command.level.value_or(surface->data_level());
  const bool measured = surface->has_data() && command.level.value_or(0) <= surface->data_level();
  object["source"] = measured ? "data" : "synthesised";
  object["datum"] = surface->info().vertical_datum;
  const std::string answer = command.json ? object.dump() + '\n' : to_text(object, command.precision);
  std::fputs(answer.c_str(), stdout);
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw globe::Error("standard output", "could not be written", "check that the disk is not full");
}

}  // namespace

void add_summary(CLI::App& program) {
  auto summary = std::make_shared<SummaryCommand>();
  CLI::App* command = program.add_subcommand(
      "summary", "lowest, highest and mean height of a cone, polygon or box, and where");
  command->add_option("PLANET", summary->planet, "folder made by globe convert, or procedural[:SEED]")
      ->required();
  add_region_options(*command, summary->region);
  command
      ->add_option(
          "--level", summary->level,
          "HTM level whose nodes are the samples (default: the data at their finest, those of insets where "
          "they lie; procedural: the level of its own relief)")
      ->check(CLI::Range(0, globe::htm::kMaxLevel));
  command->add_flag("--json", summary->json, "one JSON object");
  command
      ->add_option("--precision", summary->precision,
                   "decimals of every number with a fraction (default: all)")
      ->check(CLI::Range(0, 17));
  command->footer(
      "Text: a line each of min_m HEIGHT LAT LON, mean_m, max_m HEIGHT LAT LON, area_km2, samples, level,\n"
      "source, datum. LEVEL is the finest of the data met. SAMPLES counts the nodes in the region, border\n"
      "included: of the planet's own data, and of the insets' where they lie, or with --level of that level; "
      "min\n"
      "and max are of these nodes, exactly. MEAN is that of the surface linear between them, weighted by "
      "true\n"
      "area on the ellipsoid, right to 2e-5 of the range of heights. AREA is the region's own, right to 2e-4 "
      "or\n"
      "better.\n"
      "A region without a node has 0 samples: min and max are then those of the surface between the nodes.\n"
      "An empty region answers - (null). A RADIUS in units of length is measured on the planet's ellipsoid.\n"
      "Without data of the level (procedural, levels finer than the data) every node is made: at most 4096\n"
      "tiles of 64 x 64 cells, the whole planet at level 11.\n"
      "Example: globe summary earth --polygon alps.geojson --json");
  command->callback([summary] { run(*summary); });
}

}  // namespace app
