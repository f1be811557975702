#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "globe/planet/profile.h"

namespace app {

/// What a drawing of a profile says besides the ground itself.
struct ProfilePlot {
  std::string title;     ///< names the two places
  std::string subtitle;  ///< planet, datum, level, ...; the vertical exaggeration is added to it
  bool sea = false;      ///< whether water stands on the ground below height 0
};

/// The picture's size, pixels of a PNG, and where the axes stand in it.
inline constexpr int kPlotWidth = 1600, kPlotHeight = 800;

/// Draws the ground over the distance with gnuplot: kilometres to the right, metres upward, the line of
/// height 0, the highest and the lowest place marked. The file is whole or absent; the same bytes for the
/// same samples and gnuplot.
///
/// @param path  ends in .svg or .png, see require_plot_name
/// @param samples  two or more, the last at a distance > 0
/// Throws Error when there is no gnuplot, the file cannot be written, or it exists and `overwrite` is false.
void draw_profile(const std::filesystem::path& path, std::span<const globe::planet::ProfileSample> samples,
                  const ProfilePlot& plot, bool overwrite);

/// Throws UsageError for a name that does not end in .svg or .png, or that gnuplot could not be told.
void require_plot_name(const std::filesystem::path& path);

}  // namespace app
