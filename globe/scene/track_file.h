#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "globe/scene/path_key.h"

namespace globe::scene {

/// Reads a path from a file, told by its ending:
///
/// .kml  the first gx:Tour, else the first gx:Track, else the first LineString
/// .kmz  the same of the first .kml file in it
/// .gpx  the points of all tracks, else of all routes, with their times
/// .csv  columns named lat, lon and alt, and any of time (seconds, or ISO 8601), heading and pitch
///
/// @param agl  whether altitudes count from the ground; nothing: as the file says, for GPX and CSV: no
/// Throws Error, naming file and line, for what makes no path (require_path).
std::vector<PathKey> read_track_file(const std::filesystem::path& file, std::optional<bool> agl);

/// The same of texts. `name` is for messages.
std::vector<PathKey> read_kml(std::string text, const std::string& name, std::optional<bool> agl);

/// A text of KML and where it comes from, for messages.
struct KmlText {
  std::string text;
  std::string name;
};
/// The first .kml file of a KMZ archive. Throws Error, naming the file, when there is none that can be read.
KmlText read_kmz(const std::filesystem::path& file);

std::vector<PathKey> read_gpx(std::string text, const std::string& name, std::optional<bool> agl);
std::vector<PathKey> read_track_csv(const std::string& text, const std::string& name,
                                    std::optional<bool> agl);

}  // namespace globe::scene
