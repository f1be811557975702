#pragma once

#include <filesystem>
#include <functional>

#include "converters/job.h"
#include "converters/pyramid.h"
#include "converters/sampler.h"
#include "globe/geo/ellipsoid.h"

namespace converters {

/// Where the jobs of a conversion leave what they made.
struct PartFiles {
  std::filesystem::path folder;
  bool outlast_power = false;  ///< a job is done when what it made is on the disk

  /// The tiles of a job, a TIFF as planet/tiff_level.h writes it.
  std::filesystem::path tiles(const Job& job) const;
  /// The level below the finest of a layer ("height", "relief", "void", "color" in linear light) or the
  /// finest of "height_range" and "height_mean": a LevelFile that all jobs write to.
  std::filesystem::path level(const std::string& layer) const;
};

/// Does a job: its tiles at the finest level, and its share of the next coarser level of the layers that are
/// filtered, so that nothing of the finest level is read again. Returns the range of the values (of colors:
/// 0 to 1). `nodes` gives heights in metres, colors in linear light or marks of
/// voids (1; else 0), and may be called for any rectangle.
/// `progress` hears of the share done. Throws globe::Error when the disk is full.
Range run_job(const Job& job, const NodeSource& nodes, const globe::geo::Ellipsoid& ellipsoid,
              const PartFiles& files, const std::function<void(double)>& progress);

}  // namespace converters
