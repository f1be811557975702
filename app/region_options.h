#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "globe/geo/ellipsoid.h"
#include "globe/htm/region.h"

namespace app {

/// --cone, --polygon, --box, --edges and --complement, as `cover`, `find` and `summary` take them
/// (COMMANDS.md, Questions).
struct RegionOptions {
  std::string cone;     ///< LAT,LON,RADIUS
  std::string polygon;  ///< "LAT,LON LAT,LON ..." or a GeoJSON file
  std::string box;      ///< W,S,E,N
  std::string edges = "great-circle";
  bool complement = false;

  /// Whether one of the three is given.
  bool any() const { return !cone.empty() || !polygon.empty() || !box.empty(); }
};

/// Adds the options. At most one of --cone, --polygon and --box is taken; whether none will do is up to the
/// command.
void add_region_options(CLI::App& command, RegionOptions& options);

/// A RADIUS as it is written.
struct Radius {
  double value = 0;       ///< metres, or degrees; at least 0, of degrees at most 180
  bool is_angle = false;  ///< degrees between normals; else metres on the ellipsoid
};

/// Reads a RADIUS in m (also without a unit), km, ft, mi, nmi, deg, arcmin or arcsec.
/// @param option  for messages, such as --cone
/// @param how_to  what to do about a radius that is none
/// Throws globe::UsageError.
Radius parse_radius(const std::string& option, const std::string& text, const std::string& how_to);

/// The region that the options name. A RADIUS with a length unit, or with none, is a geodesic distance on
/// this ellipsoid (none: metres); with an angle unit it is measured on the sphere of normals.
/// REQUIRES: options.any(). Throws globe::UsageError for what cannot be understood, globe::Error for a file
/// that cannot be read.
std::shared_ptr<const globe::htm::Region> make_region(
    const RegionOptions& options, const globe::geo::Ellipsoid& ellipsoid = globe::geo::kWgs84);

/// The three region options' usage error when none is given: "give --cone, --polygon or --box".
[[noreturn]] void refuse_missing_region(const std::string& command);

}  // namespace app
