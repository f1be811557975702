#include "converters/map_geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "converters/number_text.h"
#include "converters/thesis_mapping.h"
#include "globe/base/angles.h"
#include "globe/base/bit_select.h"
#include "globe/base/error.h"
#include "globe/geo/arctangent.h"
#include "globe/geo/sine_cosine.h"

namespace converters {
namespace {

using globe::kDegree;

constexpr double kNear = 0.01;  ///< samples: how far files round their extents
constexpr double kFar = 1e8;    ///< samples: beyond this nothing is near a raster

SampleCoordinate split(double value) {
  int whole = static_cast<int>(value);
  if (whole > value) --whole;
  return {whole, value - whole};
}

std::string size_text(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

/// Moves a value onto a multiple of half a step when it is meant to be one.
double snapped(double value, double step) {
  const double on_lattice = std::round(2.0 * value / step) * step / 2.0;
  const double off = std::abs(value - on_lattice);
  return off > 1e-9 * step && off < kNear * step ? on_lattice : value;
}

/// How rows go on beyond a pole: 1 or 0 when the outermost row lies half a step or nothing short of it.
int pole_shift(double outermost_deg, double step_deg) {
  const double short_of = (90.0 - outermost_deg) / step_deg;
  return std::abs(short_of - 0.5) < kNear ? 1 : std::abs(short_of) < kNear ? 0 : MapGeometry::kNoPole;
}

/// Turns the columns of a map into ones that go all around when they are meant to.
void close_circle(MapGeometry& map) {
  const double turn = 360.0 / map.step_deg;
  const double whole = std::round(turn);
  if (std::abs(turn - whole) > kNear || map.width < whole) return;
  map.period = static_cast<int>(whole);
  map.step_deg = 360.0 / map.period;
  map.west_deg = snapped(map.west_deg, map.step_deg);
  if (map.period % 2 != 0) return;  // no column lies opposite another
  map.north_shift = pole_shift(map.north_deg, map.row_step_deg);
  map.south_shift = pole_shift((map.height - 1) * map.row_step_deg - map.north_deg, map.row_step_deg);
  if (!map.is_whole_planet()) return;
  map.row_step_deg = 180.0 / (map.height - 1 + 0.5 * (map.north_shift + map.south_shift));
  map.north_deg = 90.0 - 0.5 * map.north_shift * map.row_step_deg;
}

SamplePlace place_at(double x, double y) {
  if (!(std::abs(x) < kFar && std::abs(y) < kFar))
    return {{SamplePlace::kNowhere, 0.0}, {SamplePlace::kNowhere, 0.0}};
  return {split(x), split(y)};
}

SamplePlace place_of(const MapGeometry& geometry, const SamplePoint& point) {
  if (geometry.factor == 1) return place_at(point.x, point.y);
  const double middle = 0.5 * (geometry.factor - 1);
  return place_at((point.x - middle) / geometry.factor, (point.y - middle) / geometry.factor);
}

constexpr std::size_t kAtOnce = 1024;

/// The largest whole number not above a value below 2^51.
GLOBE_INLINE double floor_of(double value) {
  constexpr double kToInteger = 0x1.8p52;  // a sum with it is rounded to an integer
  const double nearest = (value + kToInteger) - kToInteger;
  return nearest - globe::select(globe::mask_of(nearest > value), 1.0, 0.0);
}

/// Sample coordinates of at most kAtOnce directions on an equirectangular map.
GLOBE_FOR_EVERY_VECTOR_WIDTH
void equirectangular_coordinates(const MapGeometry& geometry, const globe::geo::dvec3* directions,
                                 std::size_t count, double* x, double* y) {
  const double stretch =
      geometry.latitude == Latitude::kGeocentric ? geometry.one_minus_f * geometry.one_minus_f : 1.0;
  // All around: [0, 360). Else the turn that is nearest to the middle of the map.
  const double first = geometry.period > 0 ? 0.0 : 0.5 * (geometry.width - 1) * geometry.step_deg - 180.0;
  const double west = geometry.west_deg, north = geometry.north_deg;
  const double step = geometry.step_deg, row_step = geometry.row_step_deg;
  for (std::size_t k = 0; k < count; ++k) {
    const globe::geo::dvec3& u = directions[k];
    const double r = std::sqrt(u.x * u.x + u.y * u.y);
    double east = globe::geo::arctangent(u.y, u.x) - west;
    east -= 360.0 * floor_of((east - first) / 360.0);
    x[k] = east / step;
    y[k] = (north - globe::geo::arctangent(u.z * stretch, r)) / row_step;
  }
}

void find_equirectangular(const MapGeometry& geometry, const globe::geo::dvec3* directions, std::size_t count,
                          SamplePlace* out) {
  std::array<double, kAtOnce> x, y;
  equirectangular_coordinates(geometry, directions, count, x.data(), y.data());
  for (std::size_t k = 0; k < count; ++k) out[k] = place_at(x[k], y[k]);
}

}  // namespace

double MapGeometry::samples_per_quadrant() const {
  if (projection) return projection->samples_per_quadrant() / factor;
  return is_whole_planet() ? period / 4.0 : 90.0 / std::min(step_deg, row_step_deg);
}

MapGeometry whole_planet_geometry(const std::string& name, int width, int height, const Extent& extent,
                                  Registration registration, Latitude latitude,
                                  const globe::geo::Ellipsoid& ellipsoid) {
  const bool point = registration == Registration::kPoint;
  const int cells_down = point ? height - 1 : height;
  const auto refuse = [&](const std::string& why, const std::string& remedy) {
    return globe::Error(name, why, remedy);
  };
  if (std::abs(extent.south + 90.0) > 1e-9 || std::abs(extent.north - 90.0) > 1e-9) {
    throw refuse("latitudes " + number_text(extent.south) + " to " + number_text(extent.north) +
                     " are not the whole planet",
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
    throw refuse(size_text(width, height) + " samples without georeferencing are not a 2:1 map" +
                     (point ? " of points (2n+1 x n+1 or 2n x n+1)" : ""),
                 "give an equirectangular map of the whole planet, or its --extent W,S,E,N");
  }
  if (!whole_turn && !ends_before) {
    throw refuse("longitudes " + number_text(extent.west) + " to " + number_text(extent.east) +
                     " are not a whole turn",
                 "give --extent W,S,E,N such as 0,-90,360,90");
  }
  const double step = 180.0 / cells_down;
  const double offset = point ? 0.0 : 0.5 * step;
  MapGeometry map;
  map.width = width;
  map.height = height;
  map.period = period;
  map.west_deg = extent.west + offset;
  map.north_deg = extent.north - offset;
  map.step_deg = map.row_step_deg = step;
  map.north_shift = map.south_shift = point ? 0 : 1;
  map.latitude = latitude;
  map.one_minus_f = 1.0 - ellipsoid.f;
  return map;
}

MapGeometry equirectangular_geometry(const std::string& name, int width, int height, const Extent& extent,
                                     Registration registration, Latitude latitude,
                                     const globe::geo::Ellipsoid& ellipsoid) {
  const bool point = registration == Registration::kPoint;
  if (point && (width < 2 || height < 2))
    throw globe::Error(name, size_text(width, height) + " points span no extent", "give --registration area");
  const double span = extent.east - extent.west;
  const bool whole_turn = std::abs(span - 360.0) < 1e-9;
  MapGeometry map;
  map.width = width;
  map.height = height;
  map.row_step_deg = (extent.north - extent.south) / (point ? height - 1 : height);
  // Points all around come with the first column repeated at the end, or without.
  const bool ends_before = point && whole_turn && std::abs(span / width - map.row_step_deg) < 1e-9;
  map.step_deg = span / (point && !ends_before ? width - 1 : width);
  map.west_deg = extent.west + (point ? 0.0 : 0.5 * map.step_deg);
  map.north_deg = extent.north - (point ? 0.0 : 0.5 * map.row_step_deg);
  map.latitude = latitude;
  map.one_minus_f = 1.0 - ellipsoid.f;
  const double south_deg = map.north_deg - (height - 1) * map.row_step_deg;
  const double most = 90.0 + kNear * map.row_step_deg;
  if (!(map.step_deg > 0.0 && map.row_step_deg > 0.0 && map.north_deg <= most && south_deg >= -most &&
        span <= 720.0)) {
    throw globe::Error(name,
                       "longitudes " + number_text(extent.west) + " to " + number_text(extent.east) +
                           ", latitudes " + number_text(extent.south) + " to " + number_text(extent.north) +
                           " are no part of a planet",
                       "give its --extent W,S,E,N in degrees, or its --crs");
  }
  close_circle(map);
  return map;
}

MapGeometry projected_geometry(int width, int height, std::shared_ptr<const Projection> projection) {
  MapGeometry map;
  map.width = width;
  map.height = height;
  map.projection = std::move(projection);
  return map;
}

MapGeometry reduced(const MapGeometry& geometry, int factor) {
  MapGeometry result = geometry;
  result.width = (geometry.width + factor - 1) / factor;
  result.height = (geometry.height + factor - 1) / factor;
  result.period /= factor;
  result.west_deg += 0.5 * (factor - 1) * geometry.step_deg;
  result.north_deg -= 0.5 * (factor - 1) * geometry.row_step_deg;
  result.step_deg *= factor;
  result.row_step_deg *= factor;
  result.factor *= factor;
  return result;
}

SamplePlace place_of(const MapGeometry& geometry, const globe::geo::dvec3& u) {
  SamplePlace place;
  find_places(geometry, &u, 1, std::numbers::pi, &place);
  return place;
}

void find_places(const MapGeometry& geometry, const globe::geo::dvec3* directions, std::size_t count,
                 double reach, SamplePlace* out) {
  std::array<SamplePoint, kAtOnce> points;
  for (std::size_t first = 0; first < count; first += kAtOnce) {
    const std::size_t n = std::min(kAtOnce, count - first);
    if (geometry.as_thesis) {
      std::array<globe::geo::dvec3, kAtOnce> moved;
      std::transform(directions + first, directions + first + n, moved.begin(), thesis_direction);
      find_equirectangular(geometry, moved.data(), n, out + first);
      continue;
    }
    if (!geometry.projection) {
      find_equirectangular(geometry, directions + first, n, out + first);
      continue;
    }
    geometry.projection->find(directions + first, n, reach, points.data());
    for (std::size_t k = 0; k < n; ++k) out[first + k] = place_of(geometry, points[k]);
  }
}

bool is_on(const MapGeometry& geometry, const SamplePlace& place) {
  const auto within = [](const SampleCoordinate& at, int count) {
    const double value = at.whole + at.fraction;
    return value >= -0.5 && value <= count - 0.5;
  };
  if (!place.is_somewhere()) return false;
  const bool beyond_pole = place.y.whole < 0 ? geometry.north_shift != MapGeometry::kNoPole
                                             : place.y.whole >= geometry.height - 1 &&
                                                   geometry.south_shift != MapGeometry::kNoPole;
  return (geometry.period > 0 || within(place.x, geometry.width)) &&
         (beyond_pole || within(place.y, geometry.height));
}

double latitude_of(const MapGeometry& geometry, double y) {
  const double lat = std::clamp(geometry.north_deg - y * geometry.row_step_deg, -90.0, 90.0);
  if (geometry.latitude == Latitude::kGeodetic || std::abs(lat) == 90.0) return lat;
  return std::atan(std::tan(lat * kDegree) / (geometry.one_minus_f * geometry.one_minus_f)) / kDegree;
}

GLOBE_FOR_EVERY_VECTOR_WIDTH
void row_weights(const MapGeometry& geometry, const double* y, std::size_t count, double* out) {
  if (geometry.projection || geometry.latitude == Latitude::kGeocentric) {
    for (std::size_t k = 0; k < count; ++k) out[k] = row_weight(geometry, y[k]);
    return;
  }
  const double north = geometry.north_deg, step = geometry.row_step_deg;
  for (std::size_t k = 0; k < count; ++k) {
    const double lat = north - y[k] * step;
    const double above = globe::select(globe::mask_of(lat > 90.0), 90.0, lat);
    out[k] = globe::geo::sine_cosine(globe::select(globe::mask_of(above < -90.0), -90.0, above)).cosine;
  }
}

double row_weight(const MapGeometry& geometry, double y) {
  return geometry.projection ? 1.0 : std::cos(latitude_of(geometry, y) * kDegree);
}

SampleIndex fold(const MapGeometry& geometry, int x, int y) {
  const int last = geometry.height - 1;
  if (y < 0) {
    y = -y - geometry.north_shift;
    x += geometry.period / 2;
  } else if (y > last) {
    y = 2 * last - y + geometry.south_shift;
    x += geometry.period / 2;
  }
  x %= geometry.period;
  return {x < 0 ? x + geometry.period : x, y};
}

bool has_row(const MapGeometry& geometry, int y) {
  return y < 0                  ? geometry.north_shift != MapGeometry::kNoPole
         : y >= geometry.height ? geometry.south_shift != MapGeometry::kNoPole
                                : true;
}

}  // namespace converters
