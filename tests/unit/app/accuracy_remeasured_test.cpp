#define IMATH_HALF_NO_LOOKUP_TABLE  // the header alone
#include <Imath/half.h>
#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <array>
#include <boost/geometry.hpp>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "app/accuracy/samples.h"
#include "app/accuracy/vincenty.h"
#include "converters/round_trip.h"
#include "globe/geo/geodesic.h"
#include "globe/htm/cone.h"
#include "globe/htm/trixel.h"
#include "globe/planet/surface.h"

// The errors that `globe accuracy` reports, measured again by other formulas, other libraries or in higher
// precision, over the same places: they agree to 5 %.

namespace app::accuracy {
namespace {

using globe::geo::Geodetic;
using globe::geo::kWgs84;
using globe::htm::dvec3;
using Long = long double;

constexpr Long kLongDegree = std::numbers::pi_v<Long> / 180.0L;
const Scope kQuick{};

const Setting& setting(const std::vector<Study>& studies, const std::string& study, const std::string& name) {
  for (const Study& candidate : studies) {
    if (candidate.name != study) continue;
    for (const Setting& found : candidate.settings)
      if (found.name == name) return found;
  }
  throw std::out_of_range(study + ", " + name);
}

/// The largest and the root mean square of errors as the second method sees them.
class Second {
 public:
  void add(Long error, Long weight = 1.0L) {
    max_ = std::max(max_, std::abs(error));
    squares_ += weight * error * error;
    weights_ += weight;
  }
  Long max() const { return max_; }
  Long rms() const { return std::sqrt(squares_ / weights_); }

 private:
  Long max_ = 0, squares_ = 0, weights_ = 0;
};

void expect_agreement(const Setting& reported, const Second& second) {
  EXPECT_NEAR(reported.error.max / static_cast<double>(second.max()), 1.0, 0.05) << reported.name;
  EXPECT_NEAR(reported.error.rms / static_cast<double>(second.rms()), 1.0, 0.05) << reported.name;
}

using Vec = std::array<Long, 3>;

Long dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vec to_long(const dvec3& u) { return {u.x, u.y, u.z}; }
Vec direction(const Geodetic& place) {
  const Long lat = Long(place.lat_deg) * kLongDegree, lon = Long(place.lon_deg) * kLongDegree;
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}
Geodetic place_of(const dvec3& u) {
  return {std::atan2(u.z, std::hypot(u.x, u.y)) * 180.0 / std::numbers::pi,
          std::atan2(u.y, u.x) * 180.0 / std::numbers::pi};
}

/// The angle at the centre, by Kahan's half angles.
Long angle(const Vec& a, const Vec& b) {
  Long apart = 0, together = 0;
  for (int k = 0; k < 3; ++k) {
    apart += (a[k] - b[k]) * (a[k] - b[k]);
    together += (a[k] + b[k]) * (a[k] + b[k]);
  }
  return 2.0L * std::atan2(std::sqrt(apart), std::sqrt(together));
}

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

/// A trixel's corners and the share that each has in the point where the direction meets its plane.
struct Corners {
  std::array<Geodetic, 3> places;
  std::array<Long, 3> shares;
};

Corners corners_around(const dvec3& u, int level) {
  const globe::htm::Corners corners = globe::htm::corners(globe::htm::trixel_at(u, level));
  Corners result{};
  Long sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec next = to_long(corners[(k + 1) % 3]), last = to_long(corners[(k + 2) % 3]);
    result.places[k] = place_of(corners[k]);
    result.shares[k] = dot(to_long(u), cross(next, last));
    sum += result.shares[k];
  }
  for (Long& share : result.shares) share /= sum;
  return result;
}

Long spline(const std::array<Long, 4>& p, Long t) {
  // By the polynomials of Catmull and Rom's matrix; clamped as ours are.
  const Long s = 1.0L - t;
  const Long value = 0.5L * (-t * s * s * p[0] + (2.0L - 5.0L * t * t + 3.0L * t * t * t) * p[1] +
                             (t + 4.0L * t * t - 3.0L * t * t * t) * p[2] - t * t * s * p[3]);
  const auto [low, high] = std::minmax_element(p.begin(), p.end());
  return std::clamp(value, *low, *high);
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
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
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
}

TEST(AccuracyRemeasured, RoundTripsOfAMapByTheTextbook) {
  const auto [width, truth_width, level] = map_sample(kQuick);
  const converters::Harmonics relief = known_relief();
  const converters::HeightMap map = converters::map_of(relief, width),
                              truth = converters::map_of(relief, truth_width);
  const Long step = 360.0L / width;
  // Heights are alike everywhere on the pole, so rows beyond it are those of the other side.
  const auto pixel = [&](int x, int y) {
    if (y < 0 || y >= map.height()) {
      y = y < 0 ? -1 - y : 2 * map.height() - 1 - y;
      x += width / 2;
    }
    x = ((x % width) + width) % width;
    return Long(map.metres[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                           static_cast<std::size_t>(x)]);
  };
  const auto sample = [&](const Geodetic& place, bool nearest) {
    const Long x = (Long(place.lon_deg) + 180.0L) / step - 0.5L, y = (90.0L - place.lat_deg) / step - 0.5L;
    if (nearest) return pixel(static_cast<int>(std::floor(x + 0.5L)), static_cast<int>(std::floor(y + 0.5L)));
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const Long fx = x - x0, fy = y - y0;
    return (1.0L - fy) * ((1.0L - fx) * pixel(x0, y0) + fx * pixel(x0 + 1, y0)) +
           fy * ((1.0L - fx) * pixel(x0, y0 + 1) + fx * pixel(x0 + 1, y0 + 1));
  };
  const Long truth_step = 360.0L / truth_width;
  std::vector<std::array<std::vector<Long>, 2>> errors(static_cast<std::size_t>(truth.height()));
  tbb::parallel_for(0, truth.height(), [&](int y) {
    auto& row = errors[static_cast<std::size_t>(y)];
    for (int x = 0; x < truth_width; ++x) {
      const double lat = static_cast<double>(90.0L - (y + 0.5L) * truth_step),
                   lon = static_cast<double>((x + 0.5L) * truth_step - 180.0L);
      const Corners corners = corners_around(globe::geo::normal_from_degrees(lat, lon), level);
      const auto most = std::max_element(corners.shares.begin(), corners.shares.end());
      const Long nearest =
          sample(corners.places[static_cast<std::size_t>(most - corners.shares.begin())], true);
      Long linear = 0;
      for (std::size_t c = 0; c < 3; ++c) linear += corners.shares[c] * sample(corners.places[c], false);
      const Long height = truth.metres[static_cast<std::size_t>(y) * static_cast<std::size_t>(truth_width) +
                                       static_cast<std::size_t>(x)];
      row[0].push_back(nearest - height);
      row[1].push_back(linear - height);
    }
  });
  std::array<Second, 2> second;
  for (int y = 0; y < truth.height(); ++y) {
    const Long weight = std::cos((90.0L - (y + 0.5L) * truth_step) * kLongDegree);
    for (std::size_t method = 0; method < 2; ++method)
      for (const Long error : errors[static_cast<std::size_t>(y)][method]) second[method].add(error, weight);
  }
  const std::vector<Study> studies = conversion_studies(kQuick);
  const std::string study = "conversion.filter.l" + std::to_string(level);
  expect_agreement(setting(studies, study, "nearest"), second[0]);
  expect_agreement(setting(studies, study, "bilinear"), second[1]);
}

}  // namespace
}  // namespace app::accuracy
