#include "converters/map_input.h"

#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "converters/gdal_source.h"
#include "converters/number_text.h"
#include "globe/base/error.h"

namespace converters {
namespace {

constexpr const char* kOfTheFile = " (as the file says)";

std::string registration_text(Registration registration) {
  return registration == Registration::kArea ? "areas" : "points";
}

std::string extent_text(const Extent& extent) {
  return "longitudes " + number_text(extent.west) + " to " + number_text(extent.east) + ", latitudes " +
         number_text(extent.south) + " to " + number_text(extent.north);
}

/// A coordinate reference system from the words of an option.
void set_crs(Georeference& reference, const std::string& words) {
  OGRSpatialReference crs;
  const char* const safe[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
  char* text = nullptr;
  const char* const format[] = {"FORMAT=WKT2_2018", nullptr};
  if (crs.SetFromUserInput(words.c_str(), safe) != OGRERR_NONE ||
      crs.exportToWkt(&text, format) != OGRERR_NONE) {
    CPLFree(text);
    throw globe::UsageError("--crs", "'" + words + "' is no coordinate reference system",
                            "give one such as EPSG:4326 or '+proj=utm +zone=10'");
  }
  reference.crs = text;
  reference.crs_name = crs.GetName() != nullptr ? crs.GetName() : words;
  CPLFree(text);
}

/// Moves a transform by half a sample when the file is said to count otherwise than it says itself.
void register_as(Georeference& reference, Registration wanted) {
  const Registration said = reference.registration.value_or(Registration::kArea);
  if (said == wanted || !reference.transform) return;
  auto& t = *reference.transform;
  const double half = wanted == Registration::kPoint ? -0.5 : 0.5;
  t[0] += half * (t[1] + t[2]);
  t[3] += half * (t[4] + t[5]);
}

/// Whether coordinates without a system can only be meant as longitudes and latitudes.
bool looks_like_degrees(const GdalSource& raster) {
  if (!raster.georeference().transform) return true;
  const auto& t = *raster.georeference().transform;
  if (t[2] != 0.0 || t[4] != 0.0 || t[1] <= 0.0) return false;
  const double east = t[0] + t[1] * raster.info().width, south = t[3] + t[5] * raster.info().height;
  return t[3] <= 90.0 - t[5] && south >= -90.0 + t[5] && t[0] >= -361.0 && east <= 721.0;
}

/// The geometry of a raster that says where it lies; puts into words how.
MapGeometry placed_geometry(const MapInput& input, const GdalSource& raster, const PlanetFrame& frame,
                            std::string& words) {
  Georeference reference = raster.georeference();
  const RasterInfo& info = raster.info();
  if (input.crs) set_crs(reference, *input.crs);
  if (input.registration) register_as(reference, *input.registration);
  if (reference.crs.empty() && !looks_like_degrees(raster)) {
    throw globe::Error(input.path.string(), "has coordinates, but names no coordinate reference system",
                       "give its --crs (such as EPSG:32610), or its --extent W,S,E,N");
  }
  auto projection =
      std::make_shared<RasterProjection>(input.path.string(), info.width, info.height, reference, frame);
  const std::optional<Extent> extent = projection->as_extent();
  const std::string name =
      reference.crs.empty() ? "degrees (assumed; --crs)" : reference.crs_name + (input.crs ? "" : kOfTheFile);
  words = (extent ? extent_text(*extent) + " in "
                  : std::string(reference.transform ? "in " : "control points in ")) +
          name + ", " +
          (input.registration       ? registration_text(*input.registration)
           : reference.registration ? registration_text(*reference.registration) + kOfTheFile
                                    : "areas (assumed; --registration)");
  if (!extent) return projected_geometry(info.width, info.height, std::move(projection));
  return equirectangular_geometry(input.path.string(), info.width, info.height, *extent, Registration::kArea,
                                  frame.latitude, frame.ellipsoid);
}

MapGeometry geometry_of(const MapInput& input, const RasterSource& raster, const GdalSource* placed,
                        const PlanetFrame& frame, std::string& words) {
  const RasterInfo& info = raster.info();
  if (!input.extent && placed != nullptr) return placed_geometry(input, *placed, frame, words);
  const Registration registration = input.registration.value_or(Registration::kArea);
  const Extent extent = input.extent.value_or(Extent{});
  words = extent_text(extent) + (input.extent ? "" : " (assumed; --extent)") + ", " +
          registration_text(registration) + (input.registration ? "" : " (assumed; --registration)");
  if (input.extent) {
    return equirectangular_geometry(input.path.string(), info.width, info.height, extent, registration,
                                    frame.latitude, frame.ellipsoid);
  }
  return whole_planet_geometry(input.path.string(), info.width, info.height, extent, registration,
                               frame.latitude, frame.ellipsoid);
}

/// Scale, offset and unit of heights, and what to tell of them.
void set_values(const MapInput& input, const RasterInfo& info, OpenedMap& map) {
  const double scale = input.scale.value_or(info.scale), offset = input.offset.value_or(info.offset);
  const std::string unit = input.unit.value_or(info.unit.empty() ? "m" : info.unit);
  const std::optional<double> metres = metres_of_unit(unit);
  map.rule.scale = scale * metres.value_or(1.0);
  map.rule.offset = offset * metres.value_or(1.0);
  map.rule.nodata = input.nodata ? input.nodata : info.nodata;
  const auto who = [](bool given) { return given ? "" : kOfTheFile; };
  map.values = input.unit          ? unit
               : info.unit.empty() ? "m (assumed; --units)"
               : metres            ? info.unit + kOfTheFile
                                   : "m (the file's unit '" + info.unit + "' is none of length; --units)";
  if (scale != 1.0) map.values += ", scale " + number_text(scale) + who(input.scale.has_value());
  if (offset != 0.0) map.values += ", offset " + number_text(offset) + who(input.offset.has_value());
  if (map.rule.nodata)
    map.values += ", no data " + number_text(*map.rule.nodata) + who(input.nodata.has_value());
}

}  // namespace

OpenedMap open_map(const MapInput& input, MapKind kind, const PlanetFrame& frame, int threads) {
  const std::string path = input.path.string();
  if (!is_subdataset(path) && !std::filesystem::is_regular_file(input.path))
    throw globe::Error(path, "no such file", "check the name");
  OpenedMap map;
  map.rule.kind = kind;
  std::unique_ptr<GdalSource> by_gdal =
      GdalSource::open(input.path, {kind == MapKind::kHeights, input.nodata}, threads);
  const bool placed = by_gdal && (by_gdal->georeference().transform || by_gdal->georeference().has_points);
  const GdalSource* placed_raster = placed ? by_gdal.get() : nullptr;
  if (placed || (by_gdal && (!by_gdal->is_plain_type() || is_subdataset(path)))) {
    map.raster = std::move(by_gdal);
  } else {
    try {
      map.raster = open_image(input.path, threads);
    } catch (const globe::Error&) {
      if (!by_gdal) throw;
      map.raster = std::move(by_gdal);
    }
  }
  map.info = map.raster->info();
  map.geometry = geometry_of(input, *map.raster, placed_raster, frame, map.frame);
  if (kind == MapKind::kHeights) set_values(input, map.info, map);
  return map;
}

std::optional<double> metres_of_unit(const std::string& unit) {
  constexpr double kFoot = 0.3048, kSurveyFoot = 1200.0 / 3937.0;
  struct Spelling {
    const char* name;
    double metres;
  };
  static constexpr std::array<Spelling, 33> kSpellings{{{"m", 1},
                                                        {"metre", 1},
                                                        {"metres", 1},
                                                        {"meter", 1},
                                                        {"meters", 1},
                                                        {"mm", 1e-3},
                                                        {"millimetre", 1e-3},
                                                        {"millimeter", 1e-3},
                                                        {"cm", 1e-2},
                                                        {"centimetre", 1e-2},
                                                        {"centimetres", 1e-2},
                                                        {"centimeter", 1e-2},
                                                        {"centimeters", 1e-2},
                                                        {"dm", 0.1},
                                                        {"decimetre", 0.1},
                                                        {"decimeter", 0.1},
                                                        {"km", 1e3},
                                                        {"kilometre", 1e3},
                                                        {"kilometres", 1e3},
                                                        {"kilometer", 1e3},
                                                        {"kilometers", 1e3},
                                                        {"ft", kFoot},
                                                        {"foot", kFoot},
                                                        {"feet", kFoot},
                                                        {"international foot", kFoot},
                                                        {"us survey foot", kSurveyFoot},
                                                        {"us survey feet", kSurveyFoot},
                                                        {"foot_us", kSurveyFoot},
                                                        {"us_survey_foot", kSurveyFoot},
                                                        {"us-ft", kSurveyFoot},
                                                        {"ft_us", kSurveyFoot},
                                                        {"ftus", kSurveyFoot},
                                                        {"usft", kSurveyFoot}}};
  std::string name = unit;
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = std::find_if(kSpellings.begin(), kSpellings.end(),
                                  [&](const Spelling& spelling) { return name == spelling.name; });
  return found == kSpellings.end() ? std::nullopt : std::optional(found->metres);
}

}  // namespace converters
