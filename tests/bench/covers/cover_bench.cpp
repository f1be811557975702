// Covers: time, ranges and excess area, beside S2's where libs2-dev is installed. Each figure is a mean over
// the same eight places.

#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>
#include <string>

#include "globe/geo/area.h"
#include "globe/htm/cone.h"
#include "globe/htm/cover.h"
#include "globe/htm/polygon.h"
#include "globe/htm/trixel.h"
#include "tests/bench/covers/cover_cases.h"

namespace {

using bench::cover_places;
using bench::CoverPlace;
using globe::htm::cover;
using globe::htm::CoverSettings;
using globe::htm::IdRange;
using globe::htm::Region;

using RegionPointer = std::shared_ptr<const Region>;

constexpr globe::geo::Ellipsoid kUnitSphere{1.0, 0.0};

double area(const std::vector<IdRange>& ranges, int level) {
  double sum = 0;
  for (const IdRange& range : ranges)
    globe::htm::for_each_whole_trixel(level, range, [&](globe::htm::Trixel t) {
      sum += globe::geo::surface_area(kUnitSphere, globe::htm::corners(t));
    });
  return sum;
}

RegionPointer cone(const CoverPlace& place) {
  return std::make_shared<globe::htm::Cone>(globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg),
                                            place.radius_deg);
}

RegionPointer polygon(const CoverPlace& place) {
  return std::make_shared<globe::htm::Polygon>(globe::htm::Polygon::Rings{bench::twelve_gon(place)});
}

double cone_area(const CoverPlace& place) {
  const double s = std::sin(place.radius_deg * M_PI / 360.0);
  return 4.0 * M_PI * s * s;
}

double polygon_area(const CoverPlace& place) {
  const auto corners = bench::twelve_gon(place);
  const glm::dvec3 center = globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg);
  double sum = 0;
  for (std::size_t k = 0; k < corners.size(); ++k)
    sum += globe::geo::surface_area(kUnitSphere, {center, corners[k], corners[(k + 1) % corners.size()]});
  return sum;
}

using MakeRegion = RegionPointer (*)(const CoverPlace&);
using AreaOf = double (*)(const CoverPlace&);

/// One cover an iteration, region made anew as a query does it.
void run(benchmark::State& state, MakeRegion make, AreaOf area_of, double radius_deg,
         CoverSettings settings) {
  const auto places = cover_places(radius_deg, settings.level);
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(cover(*make(places[k]), settings));
    k = (k + 1) % places.size();
  }
  double ranges = 0, ratio = 0;
  for (const CoverPlace& place : places) {
    const auto result = cover(*make(place), settings);
    ranges += static_cast<double>(result.size());
    ratio += area(result, settings.level) / area_of(place);
  }
  state.counters["ranges"] = ranges / static_cast<double>(places.size());
  state.counters["area_ratio"] = ratio / static_cast<double>(places.size());
}

const bool registered = [] {
  struct Shape {
    std::string name;
    MakeRegion make;
    AreaOf area;
  };
  struct Size {
    std::string name;
    double radius_deg;
    int level;
  };
  for (const Shape& shape : {Shape{"cone", cone, cone_area}, Shape{"12gon", polygon, polygon_area}}) {
    for (const Size& size : {Size{"0.01deg", 0.01, 16}, Size{"1deg", 1.0, 10}, Size{"10deg", 10.0, 8}}) {
      const std::string name = "cover." + shape.name + "." + size.name;
      const auto add = [&](const std::string& what, CoverSettings settings) {
        benchmark::RegisterBenchmark((name + what).c_str(), run, shape.make, shape.area, size.radius_deg,
                                     settings);
      };
      add(".full.l" + std::to_string(size.level), {size.level, false, 0});
      add(".inner.l" + std::to_string(size.level), {size.level, true, 0});
      for (const std::size_t budget : {4, 8, 18, 64, 117, 500})
        add(".max" + std::to_string(budget) + ".l20", {20, false, budget});
    }
  }
  return true;
}();

}  // namespace
