#include "converters/local_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "converters/interpolate.h"
#include "globe/base/error.h"
#include "globe/planet/grid.h"

namespace converters {
namespace {

using globe::geo::dvec3;

constexpr int kSearchLevel = 8;                ///< of the lattice on which a raster is looked for
constexpr double kSearchReach = 0.0125;        ///< radians, more than from any place to a node of it
constexpr std::size_t kLargestWindow = 16384;  ///< samples that are read for a handful of places

struct Point {
  double x = 0, y = 0;
};

Point point_of(const SamplePlace& place) {
  return {place.x.whole + place.x.fraction, place.y.whole + place.y.fraction};
}

SampleCoordinate clamped(const SampleCoordinate& at, int count) {
  if (at.whole < 0) return {0, 0.0};
  if (at.whole >= count - 1) return {count - 1, 0.0};
  return at;
}

/// A node of the lattice by which the raster lies, the one nearest to its middle.
dvec3 found_near(const MapGeometry& geometry) {
  const int n = globe::planet::nodes_per_side(kSearchLevel);
  dvec3 best(0.0);
  double nearest = std::numeric_limits<double>::infinity();
  std::vector<dvec3> normals(static_cast<std::size_t>(n) + 1);
  std::vector<SamplePlace> places(normals.size());
  for (int d = 0; d < globe::planet::kDiamonds; ++d) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i)
        normals[static_cast<std::size_t>(i)] = globe::planet::node_direction({d, kSearchLevel, i, j});
      find_places(geometry, normals.data(), normals.size(), kSearchReach, places.data());
      for (std::size_t k = 0; k < places.size(); ++k) {
        if (!places[k].is_somewhere()) continue;
        const Point at = point_of(places[k]);
        const double away = std::hypot(at.x - 0.5 * (geometry.width - 1), at.y - 0.5 * (geometry.height - 1));
        if (away >= nearest) continue;
        nearest = away;
        best = normals[k];
      }
    }
  }
  return best;
}

}  // namespace

LocalGround::LocalGround(const MapInput& input, const globe::geo::Ellipsoid& ellipsoid,
                         std::size_t memory_bytes, int threads, const std::function<void(double)>& progress)
    : name_(input.path.string()),
      budget_(std::make_unique<MemoryBudget>(
          MemoryBudget{memory_bytes, std::filesystem::temp_directory_path()})) {
  OpenedMap opened = open_map(input, MapKind::kHeights, {ellipsoid, Latitude::kGeodetic}, threads);
  if (opened.geometry.is_whole_planet()) {
    throw globe::Error(name_, "is taken as a map of the whole planet (" + opened.frame + ")",
                       "make a planet of it by globe convert, and give that with --center");
  }
  frame_ = opened.frame;
  datum_ = opened.info.vertical_datum;
  map_ = std::make_unique<SourceMap>(
      *opened.raster, opened.geometry, opened.rule, 1, *budget_, progress ? progress : [](double) {});
  inside_ = found_near(map_->geometry());
  if (inside_ == dvec3(0.0))
    throw globe::Error(name_, "lies nowhere on the planet (" + frame_ + ")",
                       "say where by --extent or --crs");
}

void LocalGround::heights(std::span<const dvec3> normals, std::span<float> heights_m) const {
  std::vector<SamplePlace> places(normals.size());
  find_places(map_->geometry(), normals.data(), normals.size(), kSearchReach, places.data());
  for (SamplePlace& place : places) {
    if (!place.is_somewhere()) place = {{0, 0.0}, {0, 0.0}};
    place.y = clamped(place.y, map_->geometry().height);
    if (map_->geometry().period == 0) place.x = clamped(place.x, map_->geometry().width);
  }
  heights_at(places, heights_m);
}

/// Places whose samples lie far apart are halved until what is read for them is little.
void LocalGround::heights_at(std::span<const SamplePlace> places, std::span<float> heights_m) const {
  if (places.empty()) return;
  const auto [west, east] = std::minmax_element(
      places.begin(), places.end(), [](const auto& a, const auto& b) { return a.x.whole < b.x.whole; });
  const auto [north, south] = std::minmax_element(
      places.begin(), places.end(), [](const auto& a, const auto& b) { return a.y.whole < b.y.whole; });
  Window window;
  window.x0 = west->x.whole;
  window.y0 = north->y.whole;
  window.width = east->x.whole - west->x.whole + 2;
  window.height = south->y.whole - north->y.whole + 2;
  const auto samples = static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height);
  if (samples > kLargestWindow && places.size() > 1) {
    const std::size_t half = places.size() / 2;
    heights_at(places.first(half), heights_m.first(half));
    heights_at(places.subspan(half), heights_m.subspan(half));
    return;
  }
  map_->read(window);
  for (std::size_t k = 0; k < places.size(); ++k) {
    float height = 0.0f;
    if (bilinear(window, 1, places[k], &height) <= 0.0 && map_->has_voids()) map_->fill(places[k], &height);
    heights_m[k] = height;
  }
}

bool LocalGround::is_known(const dvec3& normal) const {
  SamplePlace place;
  find_places(map_->geometry(), &normal, 1, kSearchReach, &place);
  if (!is_on(map_->geometry(), place)) return false;
  Window window;
  window.x0 = place.x.whole;
  window.y0 = place.y.whole;
  window.width = window.height = 2;
  map_->read(window);
  float height = 0.0f;
  return bilinear(window, 1, place, &height) >= 0.5;
}

dvec3 LocalGround::normal_of(double x, double y) const {
  // Newton's method in the plane that touches the sphere of normals at the last guess.
  constexpr double kStep = 1e-6;  // radians, for slopes
  constexpr double kFarthest = 0.05;
  dvec3 at = inside_;
  for (int round = 0; round < 50; ++round) {
    const dvec3 aside = std::abs(at.z) < 0.9 ? dvec3(0, 0, 1) : dvec3(1, 0, 0);
    const dvec3 e = glm::normalize(glm::cross(aside, at));
    const dvec3 n = glm::cross(at, e);
    const std::array<dvec3, 3> around{at, glm::normalize(at + kStep * e), glm::normalize(at + kStep * n)};
    std::array<SamplePlace, 3> places;
    find_places(map_->geometry(), around.data(), around.size(), 0.5, places.data());
    if (!std::all_of(places.begin(), places.end(), [](const auto& p) { return p.is_somewhere(); })) break;
    const Point here = point_of(places[0]), east = point_of(places[1]), north = point_of(places[2]);
    const double missing_x = x - here.x, missing_y = y - here.y;
    if (std::hypot(missing_x, missing_y) < 1e-3) return at;
    const double a = (east.x - here.x) / kStep, b = (north.x - here.x) / kStep;
    const double c = (east.y - here.y) / kStep, d = (north.y - here.y) / kStep;
    const double determinant = a * d - b * c;
    if (determinant == 0.0) break;
    double to_e = (missing_x * d - b * missing_y) / determinant;
    double to_n = (a * missing_y - missing_x * c) / determinant;
    const double shorten = std::max(1.0, std::hypot(to_e, to_n) / kFarthest);
    to_e /= shorten;
    to_n /= shorten;
    at = glm::normalize(at + to_e * e + to_n * n);
  }
  throw globe::Error(name_, "its projection does not lead back to the planet (" + frame_ + ")",
                     "warp it first, by gdalwarp");
}

}  // namespace converters
