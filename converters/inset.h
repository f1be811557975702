#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "converters/convert.h"
#include "converters/map_input.h"

namespace converters {

struct InsetOptions {
  std::filesystem::path planet;
  std::vector<MapInput> heights;  ///< later ones over earlier ones; likewise colors
  std::vector<MapInput> colors;
  std::string name;
  std::optional<int> level;      ///< of the heights; of the colors when there are no heights
  std::optional<Filter> filter;  ///< default: as for conversion
  std::optional<double>
      rim_m;  ///< width of the rim; default: eight times the mean distance of heights from what lies below
  std::vector<std::string> credits;
  std::size_t memory_bytes = 0;  ///< as for conversion; what does not fit is refused
  int threads = 0;               ///< 0: all cores
  bool overwrite = false;        ///< an inset of the same name
  std::string program_version;   ///< goes into the credits
};

/// Lays georeferenced rasters over a planet, as the inset `name` of its heights, its colors or both, above
/// the insets it has; one that replaces another takes its place in the order.
///
/// The level is the smallest whose nodes are no farther apart than the samples of the finest raster. Voids
/// narrower than a cell of the planet's own data are filled from their borders, wider ones show what lies
/// below. The planet is whole at every moment: files come under new names, then planet.json changes at once.
/// The same input gives the same bytes, whatever the threads. Throws globe::Error; then the planet is as it
/// was.
void lay_inset(const InsetOptions& options, const ConvertListener& listener);

}  // namespace converters
