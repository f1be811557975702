#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "converters/job.h"
#include "converters/map_input.h"
#include "converters/sampler.h"
#include "converters/team.h"
#include "globe/geo/ellipsoid.h"

namespace converters {

struct ConvertOptions {
  std::vector<MapInput> heights;  ///< later ones lie over earlier ones
  std::vector<MapInput> colors;   ///< likewise
  std::filesystem::path planet;
  std::optional<int> level;      ///< of the heights; of the colors when there are no heights
  std::optional<Filter> filter;  ///< default: area where the map is finer than the grid, else bilinear
  std::optional<globe::geo::Ellipsoid> ellipsoid;
  Latitude latitude = Latitude::kGeodetic;
  Gaps voids = Gaps::kFill;          ///< what the voids of maps get that no earlier map has values for
  bool mark_voids = false;           ///< a layer "void" tells which nodes no map had a value for
  std::string geoid;                 ///< grid of geoid heights to add (geoid.h); "": none
  std::optional<std::string> datum;  ///< vertical datum by name
  bool as_thesis = false;            ///< rows taken as linear in latitude, for comparison (thesis_mapping.h)
  std::vector<std::string> credits;
  std::size_t memory_bytes =
      0;            ///< cap on the program's memory, 0: half the machine's; more goes to scratch on disk
  int threads = 0;  ///< 0: all cores
  bool overwrite = false;
  std::string program_version;  ///< goes into the credits
};

/// What a conversion tells while it runs. Calls may come from several threads, never at once.
struct ConvertListener {
  std::function<void(const std::string&)> note;     ///< choices made and assumptions
  std::function<void(const std::string&)> warning;  ///< things to look at
  std::function<void(const std::string& stage, double fraction)> progress;
};

/// Converts maps to a planet folder. The same inputs and options give the same bytes,
/// whatever the threads, the memory and the way the work was shared. Throws globe::Error; what is done by
/// then stays in PLANET.partial, and the same call goes on from there.
void convert(const ConvertOptions& options, const ConvertListener& listener);

/// The jobs that conversion falls into, in the order of their numbers. They need nothing of one another.
std::vector<Job> list_jobs(const ConvertOptions& options, const ConvertListener& listener);

/// Does one job. The one that is done last finishes the planet, and then it is true. Any number of processes
/// may do so at the same time on a shared file system. Throws globe::UsageError for a number out of range.
bool convert_job(int number, const ConvertOptions& options, const ConvertListener& listener);

/// Converts together with the other members of a team.
void convert_with(Team& team, const ConvertOptions& options, const ConvertListener& listener);

}  // namespace converters
