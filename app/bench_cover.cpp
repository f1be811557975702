#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <string>

#include "app/bench.h"
#include "globe/geo/ellipsoid.h"
#include "globe/htm/cone.h"
#include "globe/htm/cover.h"
#include "globe/htm/polygon.h"
#include "globe/region/ellipsoid_cone.h"
#include "globe/region/lat_lon_box.h"

namespace app {
namespace {

using globe::geo::Geodetic;
using globe::htm::CoverSettings;
using globe::htm::dvec3;
using globe::htm::Region;

constexpr int kPlaces = 100;

/// A region at a place, made anew for every cover, as a query does it.
using MakeRegion = std::function<std::unique_ptr<const Region>(const Geodetic&)>;

std::vector<Geodetic> middles_of_regions() {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<Geodetic> places(kPlaces);
  for (Geodetic& place : places) {
    place.lat_deg = std::asin(unit(random)) * 57.29577951308232;
    place.lon_deg = 180.0 * unit(random);
  }
  return places;
}

MakeRegion cone(double radius_deg) {
  return [radius_deg](const Geodetic& at) {
    return std::make_unique<globe::htm::Cone>(globe::geo::normal_from_degrees(at.lat_deg, at.lon_deg),
                                              radius_deg);
  };
}

MakeRegion ellipsoid_cone(double radius_m) {
  return [radius_m](const Geodetic& at) {
    return std::make_unique<globe::region::EllipsoidCone>(globe::geo::kWgs84, at, radius_m);
  };
}

MakeRegion twelve_gon(double radius_deg) {
  return [radius_deg](const Geodetic& at) {
    const dvec3 center = globe::geo::normal_from_degrees(at.lat_deg, at.lon_deg);
    const globe::geo::LocalFrame frame = globe::geo::local_frame(at.lat_deg, at.lon_deg);
    globe::htm::Polygon::Ring ring;
    for (int k = 0; k < 12; ++k) {
      const double r = radius_deg * (k % 2 == 0 ? 1.0 : 0.9) * M_PI / 180.0, azimuth = -M_PI * k / 6.0;
      ring.push_back(glm::normalize(std::cos(r) * center + std::sin(r) * (std::sin(azimuth) * frame.east +
                                                                          std::cos(azimuth) * frame.north)));
    }
    return std::make_unique<globe::htm::Polygon>(globe::htm::Polygon::Rings{ring});
  };
}

MakeRegion box(double width_deg, double height_deg) {
  return [=](const Geodetic& at) {
    const double south = std::min(std::max(at.lat_deg, -90.0), 90.0 - height_deg);
    return std::make_unique<globe::region::LatLonBox>(at.lon_deg, south, at.lon_deg + width_deg,
                                                      south + height_deg);
  };
}

BenchmarkEntry entry(const std::string& name, const MakeRegion& make, const CoverSettings& settings) {
  return {name, [=] {
            return Benchmark{
                name, kPlaces,
                [places = middles_of_regions(), make, settings, ranges = std::make_shared<std::size_t>(0)] {
                  for (const Geodetic& place : places)
                    *ranges += globe::htm::cover(*make(place), settings).size();
                }};
          }};
}

}  // namespace

std::vector<BenchmarkEntry> cover_benchmarks() {
  constexpr std::size_t kNoLimit = 0;
  return {entry("htm.cover.cone_0.01deg.l16", cone(0.01), {16, false, kNoLimit}),
          entry("htm.cover.cone_1deg.l10", cone(1.0), {10, false, kNoLimit}),
          entry("htm.cover.cone_10deg.l8", cone(10.0), {8, false, kNoLimit}),
          entry("htm.cover.cone_1deg.l20.max8", cone(1.0), {20, false, 8}),
          entry("htm.cover.cone_1deg.l20.max64", cone(1.0), {20, false, 64}),
          entry("htm.cover.cone_1deg.l20.max500", cone(1.0), {20, false, 500}),
          entry("htm.cover.12gon_0.01deg.l16", twelve_gon(0.01), {16, false, kNoLimit}),
          entry("htm.cover.12gon_1deg.l10", twelve_gon(1.0), {10, false, kNoLimit}),
          entry("htm.cover.12gon_10deg.l8", twelve_gon(10.0), {8, false, kNoLimit}),
          entry("region.cover.cone_100km.l10", ellipsoid_cone(1e5), {10, false, kNoLimit}),
          entry("region.cover.box_2x1deg.l10", box(2.0, 1.0), {10, false, kNoLimit})};
}

}  // namespace app
