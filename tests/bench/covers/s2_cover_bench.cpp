// S2's covers of the same regions, in the same run as cover_bench.cpp. Built where libs2-dev is installed.

#include <benchmark/benchmark.h>
#include <s2/s2cap.h>
#include <s2/s2cell.h>
#include <s2/s2cell_union.h>
#include <s2/s2loop.h>
#include <s2/s2polygon.h>
#include <s2/s2region_coverer.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "globe/geo/ellipsoid.h"
#include "tests/bench/covers/cover_cases.h"

namespace {

using bench::cover_places;
using bench::CoverPlace;

S2Point point(const glm::dvec3& u) { return {u.x, u.y, u.z}; }

std::unique_ptr<S2Region> cap(const CoverPlace& place) {
  const auto u = globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg);
  return std::make_unique<S2Cap>(point(u), S1Angle::Degrees(place.radius_deg));
}

std::unique_ptr<S2Region> polygon(const CoverPlace& place) {
  std::vector<S2Point> corners;
  for (const glm::dvec3& u : bench::twelve_gon(place)) corners.push_back(point(u));
  return std::make_unique<S2Polygon>(std::make_unique<S2Loop>(corners));
}

/// Ranges of leaf ids after merging cells that follow each other.
double ranges(const std::vector<S2CellId>& cells) {
  double count = 0;
  S2CellId end = S2CellId::None();
  for (const S2CellId& cell : cells) {
    if (cell.range_min() != end) ++count;
    end = cell.range_max().next();
  }
  return count;
}

double area(const std::vector<S2CellId>& cells) {
  double sum = 0;
  for (const S2CellId& cell : cells) sum += S2Cell(cell).ExactArea();
  return sum;
}

using MakeRegion = std::unique_ptr<S2Region> (*)(const CoverPlace&);

double area_of(const S2Region& region) {
  if (const auto* s2_polygon = dynamic_cast<const S2Polygon*>(&region)) return s2_polygon->GetArea();
  return region.GetCapBound().GetArea();
}

void run(benchmark::State& state, MakeRegion make, double radius_deg, int max_cells) {
  S2RegionCoverer::Options options;
  options.set_max_cells(max_cells);
  S2RegionCoverer coverer(options);
  const auto places = cover_places(radius_deg, 0);
  std::vector<S2CellId> cells;
  std::size_t k = 0;
  for (auto _ : state) {
    coverer.GetCovering(*make(places[k]), &cells);
    benchmark::DoNotOptimize(cells.data());
    k = (k + 1) % places.size();
  }
  double range_sum = 0, ratio_sum = 0;
  for (const CoverPlace& place : places) {
    const auto region = make(place);
    coverer.GetCovering(*region, &cells);
    range_sum += ranges(cells);
    ratio_sum += area(cells) / area_of(*region);
  }
  state.counters["ranges"] = range_sum / static_cast<double>(places.size());
  state.counters["area_ratio"] = ratio_sum / static_cast<double>(places.size());
}

struct Shape {
  std::string name;
  MakeRegion make;
};

const bool registered = [] {
  for (const Shape& shape : {Shape{"cone", cap}, Shape{"12gon", polygon}})
    for (const double radius_deg : {0.01, 1.0, 10.0})
      for (const int max_cells : {8, 64, 500}) {
        char name[64];
        std::snprintf(name, sizeof name, "cover_s2.%s.%gdeg.max_cells%d", shape.name.c_str(), radius_deg,
                      max_cells);
        benchmark::RegisterBenchmark(name, run, shape.make, radius_deg, max_cells);
      }
  return true;
}();

}  // namespace
