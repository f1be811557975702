#pragma once

#include <optional>
#include <string>
#include <vector>

#include "converters/convert.h"
#include "converters/map_input.h"
#include "converters/map_stack.h"
#include "converters/report.h"

namespace converters {

/// A map of a layer, before anything is written.
struct PlannedMap {
  OpenedMap opened;
  Filter filter = Filter::kBilinear;
  int factor = 1;  ///< samples averaged on reading, each way
};

/// The maps of a layer, opened and understood; later ones lie over earlier ones.
struct PlannedLayer {
  MapKind kind = MapKind::kHeights;
  int level = 0;
  std::vector<PlannedMap> maps;
};

/// Smallest level whose nodes are no farther apart than the map's samples: 2^level >= samples in 90 degrees.
int default_level(const MapGeometry& geometry);

/// Opens the maps of a layer and settles how they are converted; tells the report what was chosen, assumed
/// and taken from the files. Without a level it is that of the finest map of the whole planet, or, when there
/// is none, of the finest map, but no more than kMostLevelOfParts. Throws globe::Error when a map cannot be
/// used.
inline constexpr int kMostLevelOfParts = 11;
PlannedLayer plan_layer(const std::vector<MapInput>& inputs, MapKind kind, std::optional<int> level,
                        const ConvertOptions& options, const globe::geo::Ellipsoid& ellipsoid, int threads,
                        const Report& report);

/// How a map with samples this dense is sampled at a level.
Filter default_filter(const MapGeometry& geometry, int level);
int reading_factor(const MapGeometry& geometry, Filter filter, int level);

/// Lines of provenance for the planet's credits.
std::vector<std::string> credits_of(const PlannedLayer& layer);

/// The vertical datum that the files of the heights name, when those that name one agree.
std::optional<std::string> datum_of(const PlannedLayer& layer);

/// Reads the maps to their end; what is decoded may go to spools of a folder (see Spool).
struct SpoolFolder {
  std::filesystem::path path;
  bool always = false;
};
/// @param fate_of_voids  what the warning of voids says becomes of them
MapStack load_layer(PlannedLayer& layer, MemoryBudget& budget, const Report& report,
                    const std::string& fate_of_voids, const SpoolFolder& spools = {});

/// Where load_layer leaves the samples of a layer's map.
std::filesystem::path spool_file(const SpoolFolder& spools, MapKind kind, std::size_t map);

}  // namespace converters
