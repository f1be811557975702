#include "globe/htm/cover.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "app/commands.h"
#include "app/parse_options.h"
#include "app/region_options.h"
#include "app/trixel_geojson.h"
#include "globe/base/error.h"

namespace app {
namespace {

using globe::htm::CoverSettings;
using globe::htm::IdRange;
using globe::htm::Region;
using globe::htm::Trixel;
using nlohmann::ordered_json;

struct CoverCommand {
  RegionOptions region;
  CoverSettings settings;
  std::string ellipsoid = "wgs84";
  bool json = false;
  bool geojson = false;
};

void write(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stdout); }

std::string text_line(const IdRange& range) {
  return std::to_string(range.first) + ' ' + std::to_string(range.last) + '\n';
}

std::string json_line(const IdRange& range, int level) {
  const ordered_json object{{"level", level},
                            {"first", range.first},
                            {"last", range.last},
                            {"first_name", globe::htm::name({range.first})},
                            {"last_name", globe::htm::name({range.last})},
                            {"inside", range.inside}};
  return object.dump() + '\n';
}

/// Writes a FeatureCollection: one feature for each of the largest trixels that make up the ranges.
class FeatureWriter {
 public:
  FeatureWriter(const Region& region, int level) : region_(region), level_(level) {
    write("{\"type\":\"FeatureCollection\",\"features\":[");
  }

  void add(const IdRange& range) {
    globe::htm::for_each_whole_trixel(level_, range, [&](Trixel t) { add(t); });
  }

  void finish() { write(any_ ? "\n]}\n" : "]}\n"); }

 private:
  void add(Trixel t) {
    const int below = level_ - globe::htm::level(t);
    const bool inside = region_.relation(globe::htm::corners(t)) == globe::htm::Relation::kInside;
    const ordered_json feature{{"type", "Feature"},
                               {"id", globe::htm::name(t)},
                               {"properties",
                                {{"id", t.id},
                                 {"name", globe::htm::name(t)},
                                 {"level", globe::htm::level(t)},
                                 {"first", t.id << (2 * below)},
                                 {"last", ((t.id + 1) << (2 * below)) - 1},
                                 {"inside", inside}}},
                               {"geometry", {{"type", "Polygon"}, {"coordinates", trixel_coordinates(t)}}}};
    write((any_ ? ",\n" : "\n") + feature.dump());
    any_ = true;
  }

  const Region& region_;
  int level_;
  bool any_ = false;
};

template <typename Visit>
void visit(const Region& region, const CoverSettings& settings, const Visit& each) {
  if (settings.max_ranges == 0) {
    globe::htm::visit_cover(region, settings, each);
  } else {
    for (const IdRange& range : globe::htm::cover(region, settings)) each(range);
  }
}

void run(const CoverCommand& command) {
  if (!command.region.any()) refuse_missing_region("cover");
  const auto region = make_region(command.region, parse_ellipsoid(command.ellipsoid));
  const CoverSettings& settings = command.settings;
  if (command.geojson) {
    FeatureWriter writer(*region, settings.level);
    visit(*region, settings, [&](const IdRange& range) { writer.add(range); });
    writer.finish();
  } else {
    visit(*region, settings, [&](const IdRange& range) {
      write(command.json ? json_line(range, settings.level) : text_line(range));
    });
  }
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw globe::Error("standard output", "cannot be written", "see whether the disk is full");
}

}  // namespace

void add_cover(CLI::App& program) {
  auto cover = std::make_shared<CoverCommand>();
  CLI::App* command =
      program.add_subcommand("cover", "the trixels of a cone, polygon or box, as ranges of ids");
  add_region_options(*command, cover->region);
  command->add_option("--level", cover->settings.level, "HTM level of the ids, 0 to 28")
      ->required()
      ->check(CLI::Range(0, globe::htm::kMaxLevel));
  command->add_flag("--inner", cover->settings.inner,
                    "trixels wholly in the region (default: all that touch it)");
  command
      ->add_option("--max-ranges", cover->settings.max_ranges,
                   "at most so many ranges: the tightest that ids of the level allow")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 32));
  command
      ->add_option("--ellipsoid", cover->ellipsoid,
                   "wgs84, moon, mars or A,F: for a radius in units of length")
      ->capture_default_str();
  CLI::Option* json = command->add_flag("--json", cover->json, "one JSON object a range");
  command
      ->add_flag("--geojson", cover->geojson,
                 "a FeatureCollection of the largest trixels that make up the ranges")
      ->excludes(json);
  command->footer(
      "Text: FIRST LAST, ids of the level, both included: WHERE id BETWEEN FIRST AND LAST.  Ranges come in\n"
      "rising order and do not meet. The outer cover holds every point of the region; \"inside\": true "
      "marks\n"
      "ranges that hold no other point.  Without a unit a RADIUS is in metres.\n"
      "Example: globe cover --cone 48.2,16.37,50km --level 12 --max-ranges 20");
  command->callback([cover] { run(*cover); });
}

}  // namespace app
