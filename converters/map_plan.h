#pragma once

#include <memory>
#include <optional>
#include <string>

#include "converters/convert.h"
#include "converters/report.h"
#include "converters/source_map.h"

namespace converters {

/// A map opened and understood, before anything is written.
struct PlannedMap {
  std::unique_ptr<RasterSource> raster;
  MapGeometry geometry;
  ValueRule rule;
  int level;
  Filter filter;
  int factor;  ///< samples averaged on reading, each way
};

/// Opens a map and settles how it is converted; tells the report what was chosen and assumed. Throws
/// globe::Error when it is no map of the whole planet.
PlannedMap plan_map(const MapInput& input, MapKind kind, std::optional<int> level,
                    const ConvertOptions& options, const globe::geo::Ellipsoid& ellipsoid, int threads,
                    const Report& report);

/// A line of provenance for the planet's credits.
std::string credit_of(const PlannedMap& map);

/// Reads the map to its end.
SourceMap load_map(PlannedMap& map, MemoryBudget& budget, const Report& report);

}  // namespace converters
