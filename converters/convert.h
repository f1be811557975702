#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "converters/job.h"
#include "converters/map_geometry.h"
#include "converters/sampler.h"
#include "converters/team.h"
#include "globe/geo/ellipsoid.h"

namespace converters {

/// A map to convert: a file and what is known of its frame. What is not given is taken from the file, else
/// assumed (longitudes -180 to 180, areas) and said so.
struct MapInput {
  std::filesystem::path path;
  std::optional<Extent> extent;
  std::optional<Registration> registration;
};

struct ConvertOptions {
  std::optional<MapInput> heights;
  std::optional<MapInput> colors;
  std::filesystem::path planet;
  std::optional<int> level;      ///< of the heights; of the colors when there are no heights
  std::optional<Filter> filter;  ///< default: area where the map is finer than the grid, else bilinear
  std::optional<globe::geo::Ellipsoid> ellipsoid;
  Latitude latitude = Latitude::kGeodetic;
  bool as_thesis = false;  ///< rows taken as linear in latitude, for comparison (thesis_mapping.h)
  double scale = 1;        ///< metres = raw * scale + offset
  double offset = 0;
  std::optional<double> nodata;
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

/// Smallest level whose nodes are no farther apart than the map's samples: 2^level >= samples in 90 degrees.
int default_level(const MapGeometry& geometry);

/// Converts maps of a whole planet to a planet folder. The same inputs and options give the same bytes,
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
