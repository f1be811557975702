#include "converters/map_plan.h"

#include <algorithm>
#include <cstdio>

#include "converters/body.h"
#include "converters/coverage.h"
#include "converters/number_text.h"
#include "globe/base/error.h"
#include "globe/planet/grid.h"

namespace converters {
namespace {

using globe::geo::Ellipsoid;
using globe::planet::nodes_per_side;

/// Beyond this many rows a cell, the area filter starts from averaged blocks of samples.
constexpr double kEnoughRowsPerCell = 16.0;

const char* name_of(Filter filter) {
  switch (filter) {
    case Filter::kNearest:
      return "nearest";
    case Filter::kBilinear:
      return "bilinear";
    case Filter::kBicubic:
      return "bicubic";
    case Filter::kArea:
      break;
  }
  return "area";
}

std::string what(MapKind kind) { return kind == MapKind::kHeights ? "heights" : "color"; }

std::string size_text(const RasterInfo& info) {
  return std::to_string(info.width) + "x" + std::to_string(info.height);
}

std::string share_text(double share) {
  char text[32];
  std::snprintf(text, sizeof text, share > 0.999 ? "over %.4g %%" : "%.4g %%", std::min(99.9, 100.0 * share));
  return text;
}

void warn_of_another_body(const OpenedMap& map, MapKind kind, const Ellipsoid& ellipsoid,
                          const Report& report) {
  const RasterInfo& info = map.info;
  const std::string hint = hinted_body(info);
  if (hint.empty() || hint == body_of(ellipsoid)) return;
  report.warning(
      what(kind) + " " + info.name + " looks like the " + hint + ", but the ellipsoid is that of " +
      (body_of(ellipsoid) == "other" ? "another body" : "the " + body_of(ellipsoid)) + "; see --ellipsoid");
}

OpenedMap open(const MapInput& input, MapKind kind, const ConvertOptions& options, const Ellipsoid& ellipsoid,
               int threads, const Report& report) {
  OpenedMap map = open_map(input, kind, {ellipsoid, options.latitude}, threads);
  const RasterInfo& info = map.info;
  const int channels = info.channels - (info.has_mask ? 1 : 0);
  if (kind == MapKind::kHeights && channels > 1) {
    report.warning("heights " + info.name + " has " + std::to_string(channels) +
                   " channels; the first is used");
  }
  warn_of_another_body(map, kind, ellipsoid, report);
  return map;
}

/// The level when none is asked for.
int level_of(const std::vector<PlannedMap>& maps, MapKind kind, const Report& report) {
  int of_wholes = -1, of_parts = 0;
  for (const PlannedMap& map : maps) {
    int& level = map.opened.geometry.is_whole_planet() ? of_wholes : of_parts;
    level = std::max(level, default_level(map.opened.geometry));
  }
  if (of_wholes >= 0) return of_wholes;
  if (of_parts <= kMostLevelOfParts) return of_parts;
  report.note(what(kind) + ": level " + std::to_string(kMostLevelOfParts) +
              ", though the finest map has samples for " + std::to_string(of_parts) +
              ": no map is of the whole planet (--level)");
  return kMostLevelOfParts;
}

void note(const PlannedMap& map, MapKind kind, int level, const Report& report) {
  const RasterInfo& info = map.opened.info;
  report.note(what(kind) + " " + info.name + ": " + size_text(info) + ", " + map.opened.frame +
              (map.opened.values.empty() ? "" : ", " + map.opened.values) + "; level " +
              std::to_string(level) + ", " + number_text(map.opened.geometry.samples_per_quadrant()) +
              " samples on " + std::to_string(nodes_per_side(level)) + " cells in 90 degrees, filter " +
              name_of(map.filter));
}

void warn_of_gaps(const PlannedLayer& layer, const Report& report) {
  std::vector<MapGeometry> maps;
  for (const PlannedMap& map : layer.maps) maps.push_back(map.opened.geometry);
  const double share = uncovered_share(maps);
  if (share <= 0.0) return;
  report.warning(what(layer.kind) + ": no map covers " + share_text(share) +
                 " of the planet, which becomes " + (layer.kind == MapKind::kHeights ? "height 0" : "black") +
                 "; give a map of the whole planet first, or lay regional data over a planet by globe inset");
}

}  // namespace

int default_level(const MapGeometry& geometry) {
  int level = 0;
  while (level < globe::planet::kMaxLevel && nodes_per_side(level) < geometry.samples_per_quadrant()) ++level;
  return level;
}

Filter default_filter(const MapGeometry& geometry, int level) {
  return geometry.samples_per_quadrant() > nodes_per_side(level) ? Filter::kArea : Filter::kBilinear;
}

int reading_factor(const MapGeometry& geometry, Filter filter, int level) {
  const bool points = geometry.north_shift == 0 || geometry.south_shift == 0;
  if (filter != Filter::kArea || points) return 1;
  const double rows_per_cell = geometry.samples_per_quadrant() / nodes_per_side(level);
  const auto divides = [&](int factor) {
    return geometry.period == 0 || (geometry.period % (2 * factor) == 0 && geometry.height % factor == 0);
  };
  int factor = 1;
  while (rows_per_cell / (2 * factor) >= kEnoughRowsPerCell && divides(2 * factor)) factor *= 2;
  return factor;
}

namespace {

void take_as_thesis(MapGeometry& geometry, const std::string& name) {
  if (geometry.projection || !geometry.is_whole_planet()) {
    throw globe::Error(name, "the thesis converts plain maps of the whole planet only",
                       "leave --as-thesis away");
  }
  geometry.as_thesis = true;
}

}  // namespace

PlannedLayer plan_layer(const std::vector<MapInput>& inputs, MapKind kind, std::optional<int> level,
                        const ConvertOptions& options, const Ellipsoid& ellipsoid, int threads,
                        const Report& report) {
  PlannedLayer layer;
  layer.kind = kind;
  for (const MapInput& input : inputs) {
    PlannedMap map;
    map.opened = open(input, kind, options, ellipsoid, threads, report);
    if (options.as_thesis) take_as_thesis(map.opened.geometry, input.path.string());
    layer.maps.push_back(std::move(map));
  }
  layer.level = level ? *level : level_of(layer.maps, kind, report);
  for (PlannedMap& map : layer.maps) {
    map.filter = options.filter.value_or(default_filter(map.opened.geometry, layer.level));
    map.factor = reading_factor(map.opened.geometry, map.filter, layer.level);
    note(map, kind, layer.level, report);
  }
  warn_of_gaps(layer, report);
  return layer;
}

std::vector<std::string> credits_of(const PlannedLayer& layer) {
  std::vector<std::string> credits;
  for (const PlannedMap& map : layer.maps) {
    const RasterInfo& info = map.opened.info;
    credits.push_back(
        what(layer.kind) + " from " + info.name + " (" + size_text(info) + "), filter " +
        name_of(map.filter) +
        (map.opened.geometry.as_thesis ? ", AS THE THESIS HAS IT: up to 9.74 degrees off in latitude" : ""));
  }
  return credits;
}

std::optional<std::string> datum_of(const PlannedLayer& layer) {
  std::optional<std::string> datum;
  for (const PlannedMap& map : layer.maps) {
    const std::string& name = map.opened.info.vertical_datum;
    if (name.empty()) continue;
    if (datum && *datum != name) return std::nullopt;
    datum = name;
  }
  return datum;
}

std::filesystem::path spool_file(const SpoolFolder& spools, MapKind kind, std::size_t map) {
  if (spools.path.empty()) return {};
  return spools.path / ((kind == MapKind::kHeights ? "height_" : "color_") + std::to_string(map) + ".source");
}

MapStack load_layer(PlannedLayer& layer, MemoryBudget& budget, const Report& report,
                    const std::string& fate_of_voids, const SpoolFolder& spools) {
  MapStack maps;
  for (std::size_t k = 0; k < layer.maps.size(); ++k) {
    PlannedMap& map = layer.maps[k];
    const Spool spool{spool_file(spools, layer.kind, k), spools.always};
    const std::string name = map.opened.info.name;
    auto source =
        std::make_shared<SourceMap>(*map.opened.raster, map.opened.geometry, map.opened.rule, map.factor,
                                    budget, report.stage("reading " + what(layer.kind)), spool);
    map.opened.raster.reset();  // many files stay open otherwise
    if (source->has_voids()) {
      char share[32];
      std::snprintf(share, sizeof share, "%.4g %%", 100.0 * source->void_share());
      report.warning(what(layer.kind) + " " + name + ": " + share + " of the " +
                     (map.opened.geometry.is_whole_planet() ? "surface" : "map") + " is void, " +
                     (layer.maps.size() > 1 ? "showing the maps below or " : "") + fate_of_voids);
    }
    maps.add(std::move(source), map.filter);
  }
  return maps;
}

}  // namespace converters
