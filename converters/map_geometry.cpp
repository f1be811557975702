#include "converters/map_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "globe/base/error.h"

namespace converters {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

SampleCoordinate split(double value) {
  const double whole = std::floor(value);
  return {static_cast<int>(whole), value - whole};
}

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

}  // namespace

MapGeometry whole_planet_geometry(const std::string& name, int width, int height, const Extent& extent,
                                  Registration registration, Latitude latitude,
                                  const globe::geo::Ellipsoid& ellipsoid) {
  const bool point = registration == Registration::kPoint;
  const int cells_down = point ? height - 1 : height;
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  const auto refuse = [&](const std::string& why, const std::string& remedy) {
    return globe::Error(name, why, remedy);
  };
  if (std::abs(extent.south + 90.0) > 1e-9 || std::abs(extent.north - 90.0) > 1e-9) {
    throw refuse(
        "latitudes " + text_of(extent.south) + " to " + text_of(extent.north) + " are not the whole planet",
        "give a map from pole to pole");
  }
  const double span = extent.east - extent.west;
  // Rows fix the step; columns are a whole turn, for points with or without the first column repeated at the
  // end.
  const int period = 2 * cells_down;
  const bool whole_turn = std::abs(span - 360.0) < 1e-9;
  const bool repeats = point && whole_turn && width == period + 1;
  const bool ends_before = point && width == period && std::abs(span + 360.0 / period - 360.0) < 1e-6;
  if (cells_down < 1 ||
      !(point ? repeats || ends_before || (whole_turn && width == period) : width == period)) {
    throw refuse(size + " samples are not a 2:1 map" + (point ? " of points (2n+1 x n+1 or 2n x n+1)" : ""),
                 "give an equirectangular map of the whole planet, or its --registration");
  }
  if (!whole_turn && !ends_before) {
    throw refuse(
        "longitudes " + text_of(extent.west) + " to " + text_of(extent.east) + " are not a whole turn",
        "give --extent W,S,E,N such as 0,-90,360,90");
  }
  const double step = 180.0 / cells_down;
  const double offset = point ? 0.0 : 0.5 * step;
  return {width, height,        period,   extent.west + offset, extent.north - offset,
          step,  point ? 0 : 1, latitude, 1.0 - ellipsoid.f};
}

MapGeometry reduced(const MapGeometry& geometry, int factor) {
  MapGeometry result = geometry;
  result.width /= factor;
  result.height /= factor;
  result.period /= factor;
  result.west_deg += 0.5 * (factor - 1) * geometry.step_deg;
  result.north_deg -= 0.5 * (factor - 1) * geometry.step_deg;
  result.step_deg *= factor;
  return result;
}

SamplePlace place_of(const MapGeometry& geometry, const globe::geo::dvec3& u) {
  const double r = std::sqrt(u.x * u.x + u.y * u.y);
  const double stretch =
      geometry.latitude == Latitude::kGeocentric ? geometry.one_minus_f * geometry.one_minus_f : 1.0;
  const double lat = std::atan2(u.z * stretch, r) / kDegree;
  double east = std::atan2(u.y, u.x) / kDegree - geometry.west_deg;
  east -= 360.0 * std::floor(east / 360.0);
  return {split(east / geometry.step_deg), split((geometry.north_deg - lat) / geometry.step_deg)};
}

double latitude_of(const MapGeometry& geometry, double y) {
  const double lat = std::clamp(geometry.north_deg - y * geometry.step_deg, -90.0, 90.0);
  if (geometry.latitude == Latitude::kGeodetic || std::abs(lat) == 90.0) return lat;
  return std::atan(std::tan(lat * kDegree) / (geometry.one_minus_f * geometry.one_minus_f)) / kDegree;
}

SampleIndex fold(const MapGeometry& geometry, int x, int y) {
  const int last = geometry.height - 1;
  if (y < 0) {
    y = -y - geometry.pole_shift;
    x += geometry.period / 2;
  } else if (y > last) {
    y = 2 * last - y + geometry.pole_shift;
    x += geometry.period / 2;
  }
  x %= geometry.period;
  return {x < 0 ? x + geometry.period : x, y};
}

}  // namespace converters
