#include "app/region_options.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <vector>

#include "app/parse_options.h"
#include "app/point.h"
#include "globe/base/error.h"
#include "globe/geo/geojson.h"
#include "globe/htm/complement.h"
#include "globe/htm/cone.h"
#include "globe/htm/polygon.h"
#include "globe/region/ellipsoid_cone.h"
#include "globe/region/lat_lon_box.h"
#include "globe/region/map_polygon.h"

namespace app {
namespace {

using globe::UsageError;
using globe::geo::Ellipsoid;
using globe::geo::Geodetic;
using globe::geo::Geometry;
using globe::htm::Region;
using RegionPointer = std::shared_ptr<const Region>;

constexpr const char* kHowToCone = "give LAT,LON,RADIUS such as 48.2,16.4,50km or 48.2,16.4,0.5deg";

struct AngleUnit {
  std::string_view name;
  double degrees;
};
constexpr std::array<AngleUnit, 3> kAngleUnits{
    {{"deg", 1.0}, {"arcmin", 1.0 / 60.0}, {"arcsec", 1.0 / 3600.0}}};

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") + 1 - first);
}

/// Splits "POINT,RADIUS" (or "POINT RADIUS"); the radius may hold a space before its unit.
std::pair<std::string, std::string> point_and_radius(const std::string& text) {
  const std::string all = trimmed(text);
  std::size_t cut = all.find_last_of(", ");
  if (cut == std::string::npos)
    throw UsageError("--cone", "'" + text + "' is not LAT,LON,RADIUS", kHowToCone);
  const bool unit_alone = std::isalpha(static_cast<unsigned char>(all[cut + 1])) != 0;
  if (unit_alone) cut = all.find_last_of(", ", all.find_last_not_of(' ', cut));
  if (cut == std::string::npos || cut == 0)
    throw UsageError("--cone", "'" + text + "' is not LAT,LON,RADIUS", kHowToCone);
  std::string point = trimmed(all.substr(0, cut));
  if (point.ends_with(',')) point.pop_back();
  return {point, trimmed(all.substr(cut + 1))};
}

RegionPointer make_cone(const RegionOptions& options, const Ellipsoid& ellipsoid) {
  const auto [place, radius_text] = point_and_radius(options.cone);
  const Geodetic at = parse_point(place).position;
  const Radius radius = parse_radius("--cone", radius_text, kHowToCone);
  const auto center = globe::geo::normal_from_degrees(at.lat_deg, at.lon_deg);
  if (radius.is_angle) return std::make_shared<globe::htm::Cone>(center, radius.value);
  if (ellipsoid.f != 0.0) return std::make_shared<globe::region::EllipsoidCone>(ellipsoid, at, radius.value);
  const double radius_deg = radius.value / ellipsoid.a * (180.0 / std::numbers::pi);
  return std::make_shared<globe::htm::Cone>(center, std::min(radius_deg, 180.0));
}

bool is_file_name(const std::string& text) {
  const auto ends_with = [&](std::string_view ending) {
    return text.size() > ending.size() &&
           std::equal(ending.rbegin(), ending.rend(), text.rbegin(),
                      [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
  };
  std::error_code ignored;
  return ends_with(".geojson") || ends_with(".json") || std::filesystem::exists(text, ignored);
}

std::vector<Geometry::Rings> polygons_of_file(const std::string& path) {
  std::vector<Geometry::Rings> polygons;
  globe::geo::visit_geojson(std::filesystem::path(path), [&](globe::geo::Feature&& feature) {
    for (Geometry::Rings& rings : feature.geometry.polygons) polygons.push_back(std::move(rings));
  });
  if (polygons.empty())
    throw UsageError("--polygon", path + " has no polygon in it", "give a file of polygons");
  return polygons;
}

/// The longitude of "LAT,LON" or "LAT LON" as written, when both are plain numbers: an edge of a map from 170
/// to 190 is not one from 170 to -170.
std::optional<double> plain_longitude(const std::string& word) {
  const std::size_t comma = word.find_first_of(", ");
  return comma == std::string::npos ? std::nullopt : parse_number(trimmed(word.substr(comma + 1)));
}

/// "LAT,LON LAT,LON ...", or places of any form with semicolons between them, as one ring.
Geometry::Line ring_of_text(const std::string& text) {
  const bool semicolons = text.find(';') != std::string::npos;
  Geometry::Line ring;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t end = std::min(text.find_first_of(semicolons ? ";" : " \t\n", at), text.size());
    const std::string word = trimmed(text.substr(at, end - at));
    at = end + 1;
    if (word.empty()) continue;
    ring.push_back(parse_point(word).position);
    if (const auto lon = plain_longitude(word)) ring.back().lon_deg = *lon;
  }
  return ring;
}

RegionPointer make_great_circle_polygon(const std::vector<Geometry::Rings>& polygons) {
  std::vector<globe::htm::Polygon::Rings> normals;
  for (const Geometry::Rings& rings : polygons) {
    normals.emplace_back();
    for (const Geometry::Line& ring : rings) {
      normals.back().emplace_back();
      for (const Geodetic& at : ring)
        normals.back().back().push_back(globe::geo::normal_from_degrees(at.lat_deg, at.lon_deg));
    }
  }
  return std::make_shared<globe::htm::Polygon>(normals);
}

RegionPointer make_map_polygon(const std::vector<Geometry::Rings>& polygons) {
  std::vector<globe::region::MapPolygon::Rings> maps;
  for (const Geometry::Rings& rings : polygons) {
    maps.emplace_back();
    for (const Geometry::Line& ring : rings) {
      maps.back().emplace_back();
      for (const Geodetic& at : ring) maps.back().back().push_back({at.lat_deg, at.lon_deg});
    }
  }
  return std::make_shared<globe::region::MapPolygon>(maps);
}

RegionPointer make_polygon(const RegionOptions& options) {
  std::vector<Geometry::Rings> polygons;
  if (is_file_name(options.polygon)) {
    polygons = polygons_of_file(options.polygon);
  } else {
    polygons.push_back({ring_of_text(options.polygon)});
  }
  return options.edges == "map" ? make_map_polygon(polygons) : make_great_circle_polygon(polygons);
}

RegionPointer make_box(const RegionOptions& options) {
  std::array<double, 4> sides{};
  std::size_t count = 0;
  std::string_view rest = options.box;
  for (bool more = true; more; ++count) {
    const std::size_t comma = rest.find(',');
    const auto number = parse_number(trimmed(std::string(rest.substr(0, comma))));
    if (!number || count == sides.size()) {
      throw UsageError("--box", "'" + options.box + "' is not W,S,E,N",
                       "give four numbers of degrees such as 5.9,45.8,10.5,47.8");
    }
    sides[count] = *number;
    more = comma != std::string_view::npos;
    if (more) rest.remove_prefix(comma + 1);
  }
  if (count != sides.size()) {
    throw UsageError("--box", "'" + options.box + "' is not W,S,E,N",
                     "give four numbers of degrees such as 5.9,45.8,10.5,47.8");
  }
  return std::make_shared<globe::region::LatLonBox>(sides[0], sides[1], sides[2], sides[3]);
}

}  // namespace

Radius parse_radius(const std::string& option, const std::string& text, const std::string& how_to) {
  Radius radius{};
  const std::size_t digits = text.find_last_of("0123456789.") + 1;
  const std::size_t letters = text.find_first_not_of(' ', digits);
  const std::string_view unit = letters == std::string::npos ? "" : std::string_view(text).substr(letters);
  const auto angle = std::find_if(kAngleUnits.begin(), kAngleUnits.end(),
                                  [&](const AngleUnit& known) { return known.name == unit; });
  if (angle != kAngleUnits.end()) {
    const auto number = parse_number(text.substr(0, digits));
    if (!number) throw UsageError(option, "the radius '" + text + "' is not a number", how_to);
    radius = {*number * angle->degrees, true};
  } else {
    try {
      radius = {parse_length_m(text), false};
    } catch (const UsageError&) {
      throw UsageError(
          option, "the radius '" + text + "' is not a number of m, km, ft, mi, nmi, deg, arcmin or arcsec",
          how_to);
    }
  }
  if (!std::isfinite(radius.value) || radius.value < 0.0 || (radius.is_angle && radius.value > 180.0)) {
    throw UsageError(
        option,
        "the radius '" + text + "' is not in 0 to " + (radius.is_angle ? "180 degrees" : "half the globe"),
        how_to);
  }
  return radius;
}

void add_region_options(CLI::App& command, RegionOptions& options) {
  CLI::Option* cone = command.add_option("--cone", options.cone,
                                         "LAT,LON,RADIUS; RADIUS in m (also without a unit), km, ft, mi, "
                                         "nmi: geodesic distance on the ellipsoid; "
                                         "in deg, arcmin, arcsec: angle between normals");
  CLI::Option* polygon = command.add_option(
      "--polygon", options.polygon,
      "\"LAT,LON LAT,LON ...\" (or places of any form with ; between), or a GeoJSON file; the "
      "smaller side is inside, with --edges map what the ring surrounds on the map");
  CLI::Option* box = command.add_option("--box", options.box,
                                        "W,S,E,N: between meridians and parallels; W > E runs across 180");
  cone->excludes(polygon)->excludes(box);
  polygon->excludes(box);
  command
      .add_option("--edges", options.edges,
                  "of the polygon: great circles, or map: straight in latitude and longitude (RFC 7946)")
      ->capture_default_str()
      ->check(CLI::IsMember({"great-circle", "map"}));
  command.add_flag("--complement", options.complement, "all that is not in the region");
}

RegionPointer make_region(const RegionOptions& options, const Ellipsoid& ellipsoid) {
  RegionPointer region = !options.cone.empty()  ? make_cone(options, ellipsoid)
                         : !options.box.empty() ? make_box(options)
                                                : make_polygon(options);
  if (options.complement) region = std::make_shared<globe::htm::Complement>(std::move(region));
  return region;
}

void refuse_missing_region(const std::string& command) {
  throw UsageError(command, "no region is given", "give --cone, --polygon or --box");
}

}  // namespace app
