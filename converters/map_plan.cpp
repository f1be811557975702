#include "converters/map_plan.h"

#include <cstdio>

#include "converters/body.h"
#include "converters/number_text.h"
#include "globe/planet/grid.h"

namespace converters {
namespace {

using globe::geo::Ellipsoid;

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

int reading_factor(const MapGeometry& geometry, Filter filter, Registration registration, int level) {
  if (filter != Filter::kArea || registration == Registration::kPoint) return 1;
  const double rows_per_cell = geometry.samples_per_quadrant() / globe::planet::nodes_per_side(level);
  int factor = 1;
  while (rows_per_cell / (2 * factor) >= kEnoughRowsPerCell && geometry.width % (4 * factor) == 0 &&
         geometry.height % (2 * factor) == 0) {
    factor *= 2;
  }
  return factor;
}

}  // namespace

int default_level(const MapGeometry& geometry) {
  int level = 0;
  while (globe::planet::nodes_per_side(level) < geometry.samples_per_quadrant()) ++level;
  return level;
}

PlannedMap plan_map(const MapInput& input, MapKind kind, std::optional<int> level,
                    const ConvertOptions& options, const Ellipsoid& ellipsoid, int threads,
                    const Report& report) {
  PlannedMap map;
  map.raster = open_image(input.path, threads);
  const RasterInfo& info = map.raster->info();
  const std::string what = kind == MapKind::kHeights ? "heights " : "color ";
  const Extent extent = input.extent.value_or(info.extent.value_or(Extent{}));
  const Registration registration = input.registration.value_or(Registration::kArea);
  map.geometry = whole_planet_geometry(input.path.string(), info.width, info.height, extent, registration,
                                       options.latitude, ellipsoid);
  map.geometry.as_thesis = options.as_thesis;
  map.rule.kind = kind;
  if (kind == MapKind::kHeights) {
    map.rule.scale = options.scale;
    map.rule.offset = options.offset;
    map.rule.nodata = options.nodata ? options.nodata : info.nodata;
    if (info.channels > 1)
      report.warning(what + info.name + " has " + std::to_string(info.channels) +
                     " channels; the first is used");
  }
  map.level = level.value_or(default_level(map.geometry));
  const bool finer = map.geometry.samples_per_quadrant() > globe::planet::nodes_per_side(map.level);
  map.filter = options.filter.value_or(finer ? Filter::kArea : Filter::kBilinear);
  map.factor = reading_factor(map.geometry, map.filter, registration, map.level);
  const std::string hint = hinted_body(info);
  if (!hint.empty() && hint != body_of(ellipsoid)) {
    report.warning(what + info.name + " looks like the " + hint + ", but the ellipsoid is that of " +
                   (body_of(ellipsoid) == "other" ? "another body" : "the " + body_of(ellipsoid)) +
                   "; see --ellipsoid");
  }
  report.note(what + info.name + ": " + std::to_string(info.width) + "x" + std::to_string(info.height) +
              ", longitudes " + number_text(extent.west) + " to " + number_text(extent.east) +
              (input.extent || info.extent ? "" : " (assumed; --extent)") + ", " +
              (registration == Registration::kArea ? "areas" : "points") +
              (input.registration ? "" : " (assumed; --registration)") + "; level " +
              std::to_string(map.level) + ", " + number_text(map.geometry.samples_per_quadrant()) +
              " samples on " + std::to_string(globe::planet::nodes_per_side(map.level)) +
              " cells in 90 degrees, filter " + name_of(map.filter));
  return map;
}

std::string credit_of(const PlannedMap& map) {
  const RasterInfo& info = map.raster->info();
  return std::string(map.rule.kind == MapKind::kHeights ? "heights" : "color") + " from " + info.name + " (" +
         std::to_string(info.width) + "x" + std::to_string(info.height) + "), filter " + name_of(map.filter) +
         (map.geometry.as_thesis ? ", AS THE THESIS HAS IT: up to 9.74 degrees off in latitude" : "");
}

SourceMap load_map(PlannedMap& map, MemoryBudget& budget, const Report& report) {
  const std::string what = map.rule.kind == MapKind::kHeights ? "heights" : "color";
  SourceMap source(*map.raster, map.geometry, map.rule, map.factor, budget, report.stage("reading " + what));
  if (source.has_voids()) {
    char share[32];
    std::snprintf(share, sizeof share, "%.4g %%", 100.0 * source.void_share());
    report.warning(what + " " + map.raster->info().name + ": " + share +
                   " of the surface is void, filled from around it");
  }
  return source;
}

}  // namespace converters
