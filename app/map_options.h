#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "converters/map_input.h"

namespace app {

/// What a command line says of maps, in place of what their files say; one text for each time an option is
/// given.
struct MapOptions {
  std::vector<std::string> extents, registrations, systems, nodata, scales, offsets, units;
};

void add_map_options(CLI::App& command, MapOptions& options);

/// Gives the maps what is said of them: an option given once is for all height maps (for all color maps when
/// there are no height maps); twice, when there are both, for the height maps, then for the color maps; or it
/// comes once for each map, height maps first. "auto" leaves a map to its file. Throws globe::UsageError.
void apply_map_options(const MapOptions& options, std::vector<converters::MapInput>& heights,
                       std::vector<converters::MapInput>& colors);

std::vector<converters::MapInput> maps_of(const std::vector<std::string>& paths);

}  // namespace app
