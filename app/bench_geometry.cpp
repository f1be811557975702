#include <OpenImageIO/imageio.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "app/bench.h"
#include "converters/convert.h"
#include "globe/base/temporary_folder.h"
#include "globe/clipmap/level_data.h"
#include "globe/clipmap/shading_nodes.h"
#include "globe/geo/ellipsoid.h"
#include "globe/htm/trixel.h"
#include "globe/planet/cell.h"
#include "globe/planet/directions.h"
#include "globe/planet/surface.h"
#include "globe/planet/trixels.h"

namespace app {
namespace {

using globe::htm::dvec3;
using globe::htm::Trixel;
namespace clipmap = globe::clipmap;
namespace planet = globe::planet;

constexpr int kPoints = 10000;

std::vector<globe::geo::Geodetic> random_places() {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<globe::geo::Geodetic> places(kPoints);
  for (auto& place : places) {
    place.lat_deg = std::asin(unit(random)) * 57.29577951308232;
    place.lon_deg = 180.0 * unit(random);
  }
  return places;
}

std::vector<dvec3> normals_of(const std::vector<globe::geo::Geodetic>& places) {
  std::vector<dvec3> normals;
  normals.reserve(places.size());
  for (const auto& place : places)
    normals.push_back(globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg));
  return normals;
}

/// Where results go so that no work is left out.
struct Sink {
  double sum = 0;
};

/// A benchmark of kPoints items: `work` for each of them, one by one.
template <typename Item, typename Work>
Benchmark one_by_one(const std::string& name, std::vector<Item> items, Work work) {
  return {name, kPoints, [items = std::move(items), work, sink = std::make_shared<Sink>()] {
            for (const Item& item : items) sink->sum += work(item);
          }};
}

double parity(Trixel t) { return static_cast<double>(t.id & 1U); }

std::vector<Trixel> random_trixels() {
  std::vector<Trixel> trixels;
  for (const dvec3& u : normals_of(random_places())) trixels.push_back(globe::htm::trixel_at(u, 20));
  return trixels;
}

Benchmark id_from_degrees() {
  return one_by_one("htm.id_from_degrees.l20", random_places(), [](const globe::geo::Geodetic& place) {
    return parity(globe::htm::trixel_at(globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg), 20));
  });
}

Benchmark id_from_degrees_batch() {
  std::vector<double> lat_deg, lon_deg;
  for (const auto& place : random_places()) {
    lat_deg.push_back(place.lat_deg);
    lon_deg.push_back(place.lon_deg);
  }
  return {"htm.id_from_degrees.l20.batch", kPoints,
          [lat_deg, lon_deg, result = std::make_shared<std::vector<Trixel>>(kPoints)] {
            planet::trixels_from_degrees(lat_deg, lon_deg, 20, *result);
          }};
}

Benchmark id_from_vectors() {
  return one_by_one("htm.id_from_vectors.l20", normals_of(random_places()),
                    [](const dvec3& u) { return parity(globe::htm::trixel_at(u, 20)); });
}

Benchmark id_from_vectors_batch() {
  return {"htm.id_from_vectors.l20.batch", kPoints,
          [normals = normals_of(random_places()), result = std::make_shared<std::vector<Trixel>>(kPoints)] {
            globe::htm::trixels_at(normals, 20, *result);
          }};
}

/// The definition that the fast ways are proven to agree with.
Benchmark id_by_walk() {
  return one_by_one("htm.id_by_walk.l20", normals_of(random_places()),
                    [](const dvec3& u) { return parity(globe::htm::trixel_by_walk(u, 20)); });
}

Benchmark corners() {
  return one_by_one("htm.corners.l20", random_trixels(),
                    [](Trixel t) { return globe::htm::corners(t)[0].x; });
}

Benchmark center() {
  return one_by_one("htm.center.l20", random_trixels(), [](Trixel t) { return globe::htm::center(t).x; });
}

Benchmark neighbors() {
  return one_by_one("htm.neighbors.l20", random_trixels(),
                    [](Trixel t) { return parity(globe::htm::neighbors(t)[0]); });
}

Benchmark cell() {
  return one_by_one("planet.cell_from_trixel.l20", random_trixels(),
                    [](Trixel t) { return double(planet::cell_from_trixel(t).i); });
}

Benchmark vertex_positions() {
  const planet::TileId id{1, 16, 300, 500};
  return {"planet.directions.tile", planet::kTileCells * planet::kTileCells,
          [id, sink = std::make_shared<Sink>()] {
            const planet::TileValues<dvec3> directions = planet::node_directions(id, 0);
            sink->sum += directions.at(id.first_i() + 7, id.first_j() + 9).x;
          }};
}

/// The nodes that come in when the camera has moved by one step of level 16, tiles under them already made.
Benchmark strip_update(const std::string& name, clipmap::Windows windows) {
  auto surface = planet::Surface::builtin(1);
  clipmap::Settings settings = clipmap::Settings::for_detail(64);
  settings.windows = windows;
  const dvec3 u = globe::geo::normal_from_degrees(20.0, 30.0);
  clipmap::GridPoint point = clipmap::nadir(u, 16);
  auto from = std::make_shared<clipmap::LevelUpdate>(
      clipmap::update_level(settings, *surface, clipmap::make_region(settings, point), {}, nullptr));
  point.at.i += settings.unit() * clipmap::kSubcell;
  const clipmap::Region moved = clipmap::make_region(settings, point);
  clipmap::update_level(settings, *surface, moved, {}, from->data.get());
  return {name, 1, [=] { clipmap::update_level(settings, *surface, moved, {}, from->data.get()); }};
}

/// The vertices of a level filled from nothing, tiles under them already made.
Benchmark vertex_fill(clipmap::Positions positions) {
  auto surface = planet::Surface::builtin(1);
  clipmap::Settings settings = clipmap::Settings::for_detail(64);
  settings.positions = positions;
  const clipmap::Region region =
      clipmap::make_region(settings, clipmap::nadir(globe::geo::normal_from_degrees(20.0, 30.0), 16));
  const dvec3 anchor = clipmap::level_anchor(settings, *surface, region);
  const auto fill = [=] {
    for (int d = 0; d < planet::kDiamonds; ++d) {
      const auto& nodes = region.nodes[static_cast<std::size_t>(d)];
      if (!nodes.empty()) clipmap::make_vertex_block(settings, *surface, 16, d, nodes, anchor);
    }
  };
  fill();
  return {"clipmap.vertex_fill.l16." + std::string(clipmap::name_of(positions)), 1, fill};
}

/// A tile of synthesised ground whose parent is at hand.
Benchmark ground_tile(int level) {
  return {"planet.ground_tile.l" + std::to_string(level), planet::kTileCells * planet::kTileCells,
          [level, round = std::make_shared<int>(0), surface = planet::Surface::builtin(1)] {
            const int t = (1 << (level - 7)) + 4 * (*round)++;
            surface->tile({1, level, t, t});
          }};
}

/// Conversion of a height map of 2160x1080 to level 10, bilinear, on all cores: source pixels a second.
Benchmark convert_bilinear() {
  constexpr int kMapWidth = 2160;
  constexpr int kMapHeight = 1080;
  const auto folder = std::make_shared<const globe::TemporaryFolder>("globe-bench");
  std::vector<float> heights(static_cast<std::size_t>(kMapWidth) * kMapHeight);
  for (std::size_t k = 0; k < heights.size(); ++k)
    heights[k] = static_cast<float>(std::sin(static_cast<double>(k) * 1e-3) * 3000.0);
  auto output = OIIO::ImageOutput::create("map.tif");
  output->open((*folder / "map.tif").string(),
               OIIO::ImageSpec(kMapWidth, kMapHeight, 1, OIIO::TypeDesc::FLOAT));
  output->write_image(OIIO::TypeDesc::FLOAT, heights.data());
  output->close();
  converters::ConvertOptions options;
  options.heights = {converters::MapInput{*folder / "map.tif", {}, {}}};
  options.planet = *folder / "planet";
  options.level = 10;
  options.filter = converters::Filter::kBilinear;
  options.ellipsoid = globe::geo::kWgs84;
  options.overwrite = true;
  const converters::ConvertListener quiet{[](const std::string&) {}, [](const std::string&) {},
                                          [](const std::string&, double) {}};
  return {"convert.bilinear", double(kMapWidth) * kMapHeight, [=] {
            static_cast<void>(folder);
            converters::convert(options, quiet);
          }};
}

}  // namespace

std::vector<BenchmarkEntry> geometry_benchmarks() {
  return {{"htm.id_from_degrees.l20", id_from_degrees},
          {"htm.id_from_degrees.l20.batch", id_from_degrees_batch},
          {"htm.id_from_vectors.l20", id_from_vectors},
          {"htm.id_from_vectors.l20.batch", id_from_vectors_batch},
          {"htm.id_by_walk.l20", id_by_walk},
          {"htm.corners.l20", corners},
          {"htm.center.l20", center},
          {"htm.neighbors.l20", neighbors},
          {"planet.cell_from_trixel.l20", cell},
          {"planet.directions.tile", vertex_positions},
          {"planet.ground_tile.l12", [] { return ground_tile(12); }},
          {"planet.ground_tile.l22", [] { return ground_tile(22); }},
          {"clipmap.strip_update.l16",
           [] { return strip_update("clipmap.strip_update.l16", clipmap::Windows::kPlain); }},
          {"clipmap.strip_update.l16.hexagon",
           [] { return strip_update("clipmap.strip_update.l16.hexagon", clipmap::Windows::kHexagon); }},
          {"clipmap.vertex_fill.l16.exact", [] { return vertex_fill(clipmap::Positions::kExact); }},
          {"clipmap.vertex_fill.l16.quadratic", [] { return vertex_fill(clipmap::Positions::kQuadratic); }},
          {"clipmap.vertex_fill.l16.chord", [] { return vertex_fill(clipmap::Positions::kChord); }},
          {"clipmap.vertex_fill.l16.float32", [] { return vertex_fill(clipmap::Positions::kFloat32); }},
          {"convert.bilinear", convert_bilinear}};
}

}  // namespace app
