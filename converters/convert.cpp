#include "converters/convert.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <thread>

#include "converters/body.h"
#include "converters/layer_output.h"
#include "converters/map_plan.h"
#include "converters/number_text.h"
#include "converters/output_folder.h"
#include "converters/report.h"
#include "converters/srgb.h"

namespace converters {
namespace {

using globe::geo::Ellipsoid;

/// Of the memory cap: what the program takes before it holds any map (seen 128 MB, its libraries), decoders
/// and windows.
constexpr std::size_t kReservedBytes = std::size_t{160} << 20;

NodeGrid<float> sample_heights(const MapStack& maps, const PlannedMap& map, MemoryBudget& budget,
                               const Report& report) {
  NodeGrid<float> grid(map.level, 1, budget);
  const std::function<void(double)> progress = report.stage("sampling heights");
  for (int d = 0; d < globe::planet::kDiamonds; ++d) {
    const RowSink sink = [&, d](int i, int j, int count, const float* values, const float*) {
      std::copy_n(values, count, grid.at(d, i, j));
    };
    sample_nodes(maps, whole_diamond(d, map.level), Gaps::kFill, sink, [&](double fraction) {
      grid.drop_pages();
      progress((d + fraction) / globe::planet::kDiamonds);
    });
  }
  return grid;
}

NodeGrid<std::uint8_t> sample_colors(const MapStack& maps, const PlannedMap& map, MemoryBudget& budget,
                                     const Report& report) {
  const int channels = maps.channels();
  NodeGrid<std::uint8_t> grid(map.level, channels, budget);
  const std::function<void(double)> progress = report.stage("sampling color");
  for (int d = 0; d < globe::planet::kDiamonds; ++d) {
    const RowSink sink = [&, d](int i, int j, int count, const float* values, const float*) {
      std::transform(values, values + count * channels, grid.at(d, i, j), srgb_byte_from_linear);
    };
    sample_nodes(maps, whole_diamond(d, map.level), Gaps::kFill, sink, [&](double fraction) {
      grid.drop_pages();
      progress((d + fraction) / globe::planet::kDiamonds);
    });
  }
  return grid;
}

/// The layers of one map, written into the folder. Reading stays outside the arena: OpenImageIO has threads
/// of its own, which do not go well with tasks that wait.
std::vector<globe::planet::StoredLayer> convert_map(PlannedMap& map, const Ellipsoid& ellipsoid,
                                                    tbb::task_arena& arena, MemoryBudget& budget,
                                                    const Report& report) {
  MapStack maps;
  maps.add(std::make_shared<SourceMap>(load_map(map, budget, report)), map.filter);
  std::vector<globe::planet::StoredLayer> stored;
  arena.execute([&] {
    std::vector<LayerOutput> layers;
    if (map.rule.kind == MapKind::kHeights) {
      NodeGrid<float> heights = sample_heights(maps, map, budget, report);
      maps = {};
      layers = height_layers(std::move(heights), ellipsoid, budget);
    } else {
      NodeGrid<std::uint8_t> colors = sample_colors(maps, map, budget, report);
      maps = {};
      layers.push_back(color_layer(std::move(colors), budget));
    }
    const std::string what = map.rule.kind == MapKind::kHeights ? "heights" : "color";
    stored = write_layers(layers, budget.scratch_folder, report.stage("writing " + what));
  });
  return stored;
}

void append(std::vector<globe::planet::StoredLayer>& to, std::vector<globe::planet::StoredLayer> from) {
  to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

std::size_t default_memory() {
  return static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::size_t>(::sysconf(_SC_PAGESIZE)) / 2;
}

}  // namespace

void convert(const ConvertOptions& options, const ConvertListener& listener) {
  const Report report(listener);
  const int threads = options.threads > 0
                          ? options.threads
                          : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const Ellipsoid ellipsoid = options.ellipsoid.value_or(globe::geo::kWgs84);
  report.note("ellipsoid a = " + number_text(ellipsoid.a) +
              " m, f = " + (ellipsoid.f == 0.0 ? "0" : "1/" + number_text(1.0 / ellipsoid.f)) +
              (options.ellipsoid ? "" : " (wgs84 assumed; --ellipsoid)"));
  std::optional<PlannedMap> heights;
  std::optional<PlannedMap> colors;
  if (options.heights)
    heights =
        plan_map(*options.heights, MapKind::kHeights, options.level, options, ellipsoid, threads, report);
  if (options.colors) {
    colors = plan_map(*options.colors, MapKind::kColors, heights ? std::nullopt : options.level, options,
                      ellipsoid, threads, report);
  }

  OutputFolder output(options.planet, options.overwrite);
  const std::size_t cap = options.memory_bytes > 0 ? options.memory_bytes : default_memory();
  MemoryBudget budget{cap - std::min(cap, kReservedBytes), output.path()};
  globe::planet::PlanetFile file;
  const std::filesystem::path name =
      options.planet.has_filename() ? options.planet : options.planet.parent_path();
  file.info.name = name.filename().string();
  file.info.body = body_of(ellipsoid);
  file.info.ellipsoid = ellipsoid;
  file.info.vertical_datum = "unknown";
  file.info.tile_size = kTileSize;
  file.info.credits = options.credits;

  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  for (std::optional<PlannedMap>* map : {&heights, &colors}) {
    if (!*map) continue;
    append(file.layers, convert_map(**map, ellipsoid, arena, budget, report));
    file.info.credits.push_back(credit_of(**map));
  }
  file.info.credits.push_back("converted by " + options.program_version);
  globe::planet::write_planet_file(output.path(), std::move(file));
  output.finish();
}

}  // namespace converters
