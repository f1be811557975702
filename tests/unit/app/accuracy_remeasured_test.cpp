#define IMATH_HALF_NO_LOOKUP_TABLE  // the header alone
#include <Imath/half.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <array>
#include <boost/geometry.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "app/accuracy/samples.h"
#include "app/accuracy/vincenty.h"
#include "globe/geo/arctangent.h"
#include "globe/geo/geodesic.h"
#include "globe/htm/cone.h"
#include "globe/htm/cover.h"
#include "globe/htm/trixel.h"
#include "globe/planet/surface.h"
#include "tests/second_method.h"

// The errors that `globe accuracy` reports, measured again by other formulas, other libraries or in higher
// precision, over the same places: they agree to 5 %.

namespace app::accuracy {
namespace {

using namespace second;
using globe::geo::Geodetic;
using globe::geo::kWgs84;
using globe::htm::dvec3;

const Scope kQuick{};

TEST(AccuracyRemeasured, DistancesOnTheEllipsoidByBoostAndTheSeriesOfGeographicLib) {
  namespace bg = boost::geometry;
  using Point = bg::model::point<double, 2, bg::cs::geographic<bg::radian>>;
  const bg::strategy::distance::vincenty<bg::srs::spheroid<double>> boost_vincenty(
      bg::srs::spheroid<double>(kWgs84.a, kWgs84.b()));
  const GeographicLib::Geodesic series(kWgs84.a, kWgs84.f);
  Second sphere, vincenty_method;
  for (const PlacePair& pair : geodesic_pairs(kQuick)) {
    double truth = 0;
    series.Inverse(pair.a.lat_deg, pair.a.lon_deg, pair.b.lat_deg, pair.b.lon_deg, truth);
    sphere.add(Long(kWgs84.mean_radius()) * angle(direction(pair.a), direction(pair.b)) - truth);
    if (!vincenty(kWgs84, pair.a, pair.b)) continue;  // those that do not settle have no error
    const double degree = std::numbers::pi / 180.0;
    const Point a(pair.a.lon_deg * degree, pair.a.lat_deg * degree),
        b(pair.b.lon_deg * degree, pair.b.lat_deg * degree);
    vincenty_method.add(bg::distance(a, b, boost_vincenty) - truth);
  }
  const std::vector<Study> studies = geodesic_studies(kQuick);
  expect_agreement(setting(studies, "geodesics.ellipsoid", "great circle"), sphere);
  expect_agreement(setting(studies, "geodesics.ellipsoid", "Vincenty"), vincenty_method);
}

TEST(AccuracyRemeasured, DistancesOnTheSphereByHalfAngles) {
  const Long radius = kWgs84.mean_radius();
  const globe::geo::GeodesicSolver solver(globe::geo::Ellipsoid{kWgs84.mean_radius(), 0.0});
  const double degree = std::numbers::pi / 180.0;
  Second arc_cosine, haversine, karney;
  for (const PlacePair& pair : geodesic_pairs(kQuick)) {
    const Long truth = radius * angle(direction(pair.a), direction(pair.b));
    const double a = pair.a.lat_deg * degree, b = pair.b.lat_deg * degree;
    const double cosine = std::sin(a) * std::sin(b) +
                          std::cos(a) * std::cos(b) * std::cos((pair.b.lon_deg - pair.a.lon_deg) * degree);
    arc_cosine.add(kWgs84.mean_radius() * std::acos(std::clamp(cosine, -1.0, 1.0)) - truth);
    const double y = std::sin((pair.b.lat_deg - pair.a.lat_deg) * degree / 2.0),
                 x = std::sin((pair.b.lon_deg - pair.a.lon_deg) * degree / 2.0);
    haversine.add(2.0 * kWgs84.mean_radius() *
                      std::asin(std::sqrt(std::min(y * y + std::cos(a) * std::cos(b) * x * x, 1.0))) -
                  truth);
    karney.add(solver.inverse(pair.a, pair.b).s12_m - truth);
  }
  const std::vector<Study> studies = geodesic_studies(kQuick);
  expect_agreement(setting(studies, "geodesics.sphere", "arc cosine"), arc_cosine);
  expect_agreement(setting(studies, "geodesics.sphere", "haversine"), haversine);
  expect_agreement(setting(studies, "geodesics.sphere", "Karney, f = 0"), karney);
}

TEST(AccuracyRemeasured, PlacesOnTheSphereByGeographicLib) {
  const GeographicLib::Geocentric earth(kWgs84.a, kWgs84.f), ball(kWgs84.mean_radius(), 0.0);
  Second sphere;
  const auto look = [&](const Geodetic& place) {
    Vec p{}, q{};
    double x = 0, y = 0, z = 0;
    earth.Forward(place.lat_deg, place.lon_deg, 0.0, x, y, z);
    p = {x, y, z};
    ball.Forward(place.lat_deg, place.lon_deg, 0.0, x, y, z);
    q = {x, y, z};
    sphere.add(std::sqrt((p[0] - q[0]) * (p[0] - q[0]) + (p[1] - q[1]) * (p[1] - q[1]) +
                         (p[2] - q[2]) * (p[2] - q[2])));
  };
  for (const PlacePair& pair : geodesic_pairs(kQuick)) look(pair.a);
  for (const double lat : {-90.0, 0.0, 90.0}) look({lat, 45.0});
  expect_agreement(setting(geodesic_studies(kQuick), "geodesics.shape", "sphere"), sphere);
}

TEST(AccuracyRemeasured, HeightsBetweenNodesFromTheFunctionAtTheCornersOfHtm) {
  namespace planet = globe::planet;
  constexpr int kLevel = 6;
  const converters::Harmonics relief = known_relief();
  const auto height = [&](const Geodetic& place) {
    return static_cast<Long>(static_cast<float>(relief.at(place.lat_deg, place.lon_deg)));
  };
  const std::vector<Geodetic> places = height_places(kQuick);
  struct Errors {
    Long nearest, linear, cubic;
  };
  std::vector<Errors> errors(places.size());
  tbb::parallel_for(std::size_t{0}, places.size(), [&](std::size_t k) {
    const dvec3 u = globe::geo::normal_from_degrees(places[k].lat_deg, places[k].lon_deg);
    const Long truth = relief.at(places[k].lat_deg, places[k].lon_deg);
    const Corners corners = corners_around(u, kLevel);
    Long linear = 0;
    for (std::size_t c = 0; c < 3; ++c) linear += corners.shares[c] * height(corners.places[c]);
    const auto nearest = std::max_element(corners.shares.begin(), corners.shares.end());
    const Geodetic corner = corners.places[static_cast<std::size_t>(nearest - corners.shares.begin())];
    const planet::Place at = planet::locate(u, kLevel);
    const int last = planet::nodes_per_side(kLevel) - 1;
    const int i0 = std::min(static_cast<int>(at.ij.x), last), j0 = std::min(static_cast<int>(at.ij.y), last);
    std::array<Long, 4> rows{};
    for (int j = 0; j < 4; ++j) {
      std::array<Long, 4> row{};
      for (int i = 0; i < 4; ++i) {
        const planet::Node node{at.d, kLevel, i0 + i - 1, j0 + j - 1};
        row[static_cast<std::size_t>(i)] = height(place_of(planet::node_direction(planet::fold(node))));
      }
      rows[static_cast<std::size_t>(j)] = spline(row, Long(at.ij.x) - i0);
    }
    errors[k] = {height(corner) - truth, linear - truth, spline(rows, Long(at.ij.y) - j0) - truth};
  });
  Second nearest, linear, cubic;
  for (const Errors& error : errors) {
    nearest.add(error.nearest);
    linear.add(error.linear);
    cubic.add(error.cubic);
  }
  const std::vector<Study> studies = height_studies(kQuick);
  expect_agreement(setting(studies, "heights.interpolation.l6", "nearest"), nearest);
  expect_agreement(setting(studies, "heights.interpolation.l6", "linear"), linear);
  expect_agreement(setting(studies, "heights.interpolation.l6", "cubic"), cubic);
}

TEST(AccuracyRemeasured, StoredHeightsByImathAndInLongDouble) {
  constexpr int kLevel = 8;
  const auto surface = globe::planet::Surface::builtin(1);
  std::vector<double> heights;
  const int n = globe::planet::nodes_per_side(kLevel);
  for (int d = 0; d < globe::planet::kDiamonds; ++d)
    for (int j = 0; j < n; j += 2)
      for (int i = 0; i < n; i += 2) heights.push_back(surface->height({d, kLevel, i, j}));
  const auto ends = std::minmax_element(heights.begin(), heights.end());
  const auto low = ends.first, high = ends.second;
  Second byte, half, word, whole;
  for (const double h : heights) {
    const auto steps = [&](Long most) {
      const Long step = (Long(*high) - *low) / most;
      return *low + std::floor((h - *low) / step + 0.5L) * step - h;
    };
    byte.add(steps(255.0L));
    word.add(steps(65535.0L));
    half.add(Long(static_cast<float>(Imath::half(static_cast<float>(h)))) - h);
    whole.add(Long(static_cast<float>(h)) - h);
  }
  const std::vector<Study> studies = storage_studies(kQuick);
  expect_agreement(setting(studies, "storage.heights", "8 bits over the range"), byte);
  expect_agreement(setting(studies, "storage.heights", "16 bits over the range"), word);
  expect_agreement(setting(studies, "storage.heights", "half float"), half);
  expect_agreement(setting(studies, "storage.heights", "float"), whole);
}

/// Area on the unit sphere, by L'Huilier's theorem.
Long area(const globe::htm::Corners& corners) {
  const Long a = angle(to_long(corners[1]), to_long(corners[2])),
             b = angle(to_long(corners[2]), to_long(corners[0])),
             c = angle(to_long(corners[0]), to_long(corners[1]));
  const Long s = (a + b + c) / 2.0L;
  return 4.0L * std::atan(std::sqrt(std::max(0.0L, std::tan(s / 2.0L) * std::tan((s - a) / 2.0L) *
                                                       std::tan((s - b) / 2.0L) * std::tan((s - c) / 2.0L))));
}

/// Distance of a direction from a side, as an angle.
Long distance_to_side(const Vec& u, const Vec& a, const Vec& b) {
  const Vec normal = cross(a, b);
  if (dot(cross(normal, a), u) > 0.0L && dot(cross(normal, b), u) < 0.0L)
    return std::asin(std::abs(dot(normal, u)) / std::sqrt(dot(normal, normal)));
  return std::min(angle(u, a), angle(u, b));
}

/// Area of the trixels of a level that have a point within `radius` of u, found by distances alone.
Long touched_area(globe::htm::Trixel trixel, int level, const Vec& u, Long radius) {
  const globe::htm::Corners corners = globe::htm::corners(trixel);
  Long nearest = 4.0L;
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec a = to_long(corners[k]), b = to_long(corners[(k + 1) % 3]);
    inside = inside && dot(cross(a, b), u) >= 0.0L;
    nearest = std::min(nearest, distance_to_side(u, a, b));
  }
  if (!inside && nearest > radius) return 0.0L;
  if (globe::htm::level(trixel) == level) return area(corners);
  Long sum = 0;
  for (int k = 0; k < 4; ++k) sum += touched_area(globe::htm::child(trixel, k), level, u, radius);
  return sum;
}

TEST(AccuracyRemeasured, CoversByDistancesAndLHuilier) {
  const Long radius = Long(kConeRadius_deg) * kLongDegree;
  const Long cap = 4.0L * std::numbers::pi_v<Long> * std::sin(radius / 2.0L) * std::sin(radius / 2.0L);
  const std::vector<dvec3> centres = cone_centres(kQuick);
  const std::vector<Study> studies = cover_studies(kQuick);
  for (const int level : {6, 8, 10}) {
    Second excess;
    for (const dvec3& centre : centres) {
      Long sum = 0;
      for (std::uint64_t root = 8; root < 16; ++root)
        sum += touched_area(globe::htm::Trixel{root}, level, to_long(centre), radius);
      excess.add(100.0L * (sum / cap - 1.0L));
    }
    expect_agreement(setting(studies, "covers.level", "level " + std::to_string(level)), excess);
  }
  for (const std::size_t limit : {4U, 32U, 256U}) {
    Second excess;
    for (const dvec3& centre : centres) {
      Long sum = 0;
      for (const globe::htm::IdRange& range :
           globe::htm::cover(globe::htm::Cone(centre, kConeRadius_deg), {.level = 20, .max_ranges = limit}))
        globe::htm::for_each_whole_trixel(
            20, range, [&](globe::htm::Trixel trixel) { sum += area(globe::htm::corners(trixel)); });
      excess.add(100.0L * (sum / cap - 1.0L));
    }
    expect_agreement(setting(studies, "covers.ranges", std::to_string(limit) + " ranges"), excess);
  }
}

using Fine = boost::multiprecision::cpp_bin_float_50;

/// Metres on the Earth between a direction and one in fifty digits.
Long metres_off(const std::array<Fine, 3>& truth, const dvec3& found) {
  const Fine x = truth[0] - found.x, y = truth[1] - found.y, z = truth[2] - found.z;
  return static_cast<Long>(sqrt(x * x + y * y + z * z)) * Long(kWgs84.a);
}

TEST(AccuracyRemeasured, DirectionsAndLongitudesInFiftyDigits) {
  const std::vector<Study> studies = geometry_studies(kQuick);
  const Fine degree = boost::math::constants::pi<Fine>() / 180;
  const auto normal_in = [](auto lat, auto lon) {
    return dvec3(std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat));
  };
  Second in_float, in_double, polynomials, longitude_float, longitude_double, longitude;
  for (const Geodetic& place : height_places(kQuick)) {
    const Fine lat = place.lat_deg * degree, lon = place.lon_deg * degree;
    const std::array<Fine, 3> truth{cos(lat) * cos(lon), cos(lat) * sin(lon), sin(lat)};
    const dvec3 u = globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg);
    const double degree_double = std::numbers::pi / 180.0;
    const float degree_float = std::numbers::pi_v<float> / 180.0F;
    in_float.add(metres_off(truth, normal_in(static_cast<float>(place.lat_deg) * degree_float,
                                             static_cast<float>(place.lon_deg) * degree_float)));
    in_double.add(metres_off(truth, normal_in(place.lat_deg * degree_double, place.lon_deg * degree_double)));
    polynomials.add(metres_off(truth, u));
    const Fine turn = atan2(Fine(u.y), Fine(u.x));
    const auto off = [&](double found_deg) {
      return static_cast<Long>((found_deg * degree - turn) * kWgs84.a);
    };
    longitude_float.add(off(static_cast<double>(std::atan2(static_cast<float>(u.y), static_cast<float>(u.x)) *
                                                180.0F / std::numbers::pi_v<float>)));
    longitude_double.add(off(std::atan2(u.y, u.x) * 180.0 / std::numbers::pi));
    longitude.add(off(globe::geo::arctangent(u.y, u.x)));
  }
  expect_agreement(setting(studies, "geometry.sine_cosine", "the C library's, float"), in_float);
  expect_agreement(setting(studies, "geometry.sine_cosine", "the C library's, double"), in_double);
  expect_agreement(setting(studies, "geometry.sine_cosine", "our polynomials"), polynomials);
  expect_agreement(setting(studies, "geometry.arctangent", "the C library's, float"), longitude_float);
  expect_agreement(setting(studies, "geometry.arctangent", "the C library's, double"), longitude_double);
  expect_agreement(setting(studies, "geometry.arctangent", "our rational function"), longitude);
}

}  // namespace
}  // namespace app::accuracy
