#include <OpenImageIO/imageio.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "app/bench.h"
#include "converters/convert.h"
#include "globe/clipmap/level_data.h"
#include "globe/clipmap/shading_nodes.h"
#include "globe/geo/ellipsoid.h"
#include "globe/htm/trixel.h"
#include "globe/planet/directions.h"
#include "globe/planet/surface.h"

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

Benchmark id_from_degrees() {
  return {"htm.id_from_degrees.l20", kPoints, [places = random_places(), sink = std::make_shared<Sink>()] {
            for (const auto& place : places) {
              const Trixel t =
                  globe::htm::trixel_at(globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg), 20);
              sink->sum += static_cast<double>(t.id & 1u);
            }
          }};
}

Benchmark id_from_degrees_batch() {
  return {"htm.id_from_degrees.l20.batch", kPoints,
          [places = random_places(), result = std::make_shared<std::vector<Trixel>>(kPoints, Trixel{8})] {
            globe::htm::trixels_at(normals_of(places), 20, *result);
          }};
}

Benchmark corners() {
  std::vector<Trixel> trixels;
  for (const dvec3& u : normals_of(random_places())) trixels.push_back(globe::htm::trixel_at(u, 20));
  return {"htm.corners.l20", kPoints, [trixels, sink = std::make_shared<Sink>()] {
            for (const Trixel& t : trixels) sink->sum += globe::htm::corners(t)[0].x;
          }};
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
Benchmark strip_update() {
  auto surface = planet::Surface::builtin(1);
  const clipmap::Settings settings = clipmap::Settings::for_detail(64);
  const dvec3 u = globe::geo::normal_from_degrees(20.0, 30.0);
  clipmap::GridPoint point = clipmap::nadir(u, 16);
  auto from = std::make_shared<clipmap::LevelUpdate>(
      clipmap::update_level(settings, *surface, clipmap::make_region(settings, point), {}, nullptr));
  point.at.i += settings.unit() * clipmap::kSubcell;
  const clipmap::Region moved = clipmap::make_region(settings, point);
  clipmap::update_level(settings, *surface, moved, {}, from->data.get());
  return {"clipmap.strip_update.l16", 1,
          [=] { clipmap::update_level(settings, *surface, moved, {}, from->data.get()); }};
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
  constexpr int kWidth = 2160;
  constexpr int kHeight = 1080;
  const auto folder = std::make_shared<std::filesystem::path>(std::filesystem::temp_directory_path() /
                                                              ("globe-bench-" + std::to_string(getpid())));
  std::filesystem::create_directories(*folder);
  const std::shared_ptr<void> remover(nullptr, [folder](void*) { std::filesystem::remove_all(*folder); });
  std::vector<float> heights(static_cast<std::size_t>(kWidth) * kHeight);
  for (std::size_t k = 0; k < heights.size(); ++k)
    heights[k] = static_cast<float>(std::sin(static_cast<double>(k) * 1e-3) * 3000.0);
  auto output = OIIO::ImageOutput::create("map.tif");
  output->open((*folder / "map.tif").string(), OIIO::ImageSpec(kWidth, kHeight, 1, OIIO::TypeDesc::FLOAT));
  output->write_image(OIIO::TypeDesc::FLOAT, heights.data());
  output->close();
  converters::ConvertOptions options;
  options.heights = converters::MapInput{*folder / "map.tif", {}, {}};
  options.planet = *folder / "planet";
  options.level = 10;
  options.filter = converters::Filter::kBilinear;
  options.ellipsoid = globe::geo::kWgs84;
  options.overwrite = true;
  const converters::ConvertListener quiet{[](const std::string&) {}, [](const std::string&) {},
                                          [](const std::string&, double) {}};
  return {"convert.bilinear", double(kWidth) * kHeight, [=] {
            static_cast<void>(remover);
            converters::convert(options, quiet);
          }};
}

}  // namespace

std::vector<BenchmarkEntry> geometry_benchmarks() {
  return {{"htm.id_from_degrees.l20", id_from_degrees},
          {"htm.id_from_degrees.l20.batch", id_from_degrees_batch},
          {"htm.corners.l20", corners},
          {"planet.directions.tile", vertex_positions},
          {"planet.ground_tile.l12", [] { return ground_tile(12); }},
          {"planet.ground_tile.l22", [] { return ground_tile(22); }},
          {"clipmap.strip_update.l16", strip_update},
          {"convert.bilinear", convert_bilinear}};
}

}  // namespace app
