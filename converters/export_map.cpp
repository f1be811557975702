#include "converters/export_map.h"

#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "converters/resources.h"
#include "globe/base/error.h"
#include "globe/base/pending_file.h"
#include "globe/planet/inset_stack.h"

namespace converters {
namespace {

using globe::UsageError;
using globe::planet::nodes_per_side;
using globe::planet::Surface;
using SurfacePointer = std::shared_ptr<const Surface>;

constexpr int kMaxMapSide = 1 << 21;  ///< pixels
constexpr double kEnoughCells = 4.0;  ///< a pixel: the mean of 4 x 4 places, or more
constexpr int kTokensAThread = 4;     ///< blocks on their way for each thread

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

double cells_a_pixel(double step_deg, int level) { return step_deg / 90.0 * nodes_per_side(level); }

MapWindow window_of(const ExportOptions& options, int level) {
  const Extent& extent = options.extent;
  const double wide = extent.east - extent.west;
  const double high = extent.north - extent.south;
  if (!(wide > 0.0 && wide <= 360.0 && high > 0.0 && extent.north <= 90.0 && extent.south >= -90.0)) {
    throw UsageError("--extent", "not a part of the planet", "give W,S,E,N in degrees such as 0,-90,360,90");
  }
  const double pixels_a_degree = nodes_per_side(level) / 90.0;
  const auto pixels = [&](double degrees) {
    return std::max(1.0, std::ceil(degrees * pixels_a_degree - 1e-6));
  };
  const double width = options.size ? options.size->width : pixels(wide);
  const double height = options.size ? options.size->height : pixels(high);
  if (!(width >= 1.0 && height >= 1.0 && width <= kMaxMapSide && height <= kMaxMapSide)) {
    throw UsageError("--size", number(width) + "x" + number(height) + " pixels cannot be written",
                     "give a smaller --size or --extent");
  }
  return {extent.west,
          extent.north,
          wide / width,
          high / height,
          static_cast<int>(width),
          static_cast<int>(height)};
}

/// A block of pixels between the stages.
struct Block {
  int x0, y0, nx, ny;
  std::vector<float> values;
};

/// Sets pixels to the map's nodata value where `surface` was filled.
void hide_filled(const Surface& surface, const MapDescription& map, int level, Block& block) {
  float* value = block.values.data();
  for (int y = block.y0; y < block.y0 + block.ny; ++y) {
    for (int x = block.x0; x < block.x0 + block.nx; ++x, ++value) {
      const auto u =
          globe::geo::normal_from_degrees(map.window.latitude(y + 0.5), map.window.longitude(x + 0.5));
      if (surface.is_filled(u, level)) *value = static_cast<float>(*map.nodata);
    }
  }
}

void write_blocks(const Surface& surface, int level, const MapSampler& sampler, const MapDescription& map,
                  MapWriter& writer, std::size_t blocks_at_once,
                  const std::function<void(double)>& progress) {
  const MapWindow& window = map.window;
  const int across = (window.width + writer.block_width() - 1) / writer.block_width();
  const int down = (window.height + writer.block_height() - 1) / writer.block_height();
  const std::int64_t count = std::int64_t{across} * down;
  std::int64_t next = 0, done = 0;
  const auto cut = [&](tbb::flow_control& flow) {
    Block block{};
    if (next == count) {
      flow.stop();
      return block;
    }
    block.x0 = static_cast<int>(next % across) * writer.block_width();
    block.y0 = static_cast<int>(next / across) * writer.block_height();
    block.nx = std::min(writer.block_width(), window.width - block.x0);
    block.ny = std::min(writer.block_height(), window.height - block.y0);
    ++next;
    return block;
  };
  const auto sample = [&](Block block) {
    block.values.resize(static_cast<std::size_t>(block.nx) * static_cast<std::size_t>(block.ny) *
                        static_cast<std::size_t>(map.channels()));
    sampler.sample(block.x0, block.y0, block.nx, block.ny, block.values.data());
    if (map.nodata) hide_filled(surface, map, level, block);
    return block;
  };
  const auto write = [&](const Block& block) {
    writer.write(block.x0, block.y0, block.nx, block.ny, block.values.data());
    progress(double(++done) / double(count));
  };
  tbb::parallel_pipeline(blocks_at_once,
                         tbb::make_filter<void, Block>(tbb::filter_mode::serial_in_order, cut) &
                             tbb::make_filter<Block, Block>(tbb::filter_mode::parallel, sample) &
                             tbb::make_filter<Block, void>(tbb::filter_mode::serial_in_order, write));
}

/// What the map is made of.
struct MapPlan {
  MapDescription map;
  int level;       ///< the one asked for
  int read_level;  ///< the one that pixels come from
  Sampling sampling;
};

MapContent content_of(const Surface& surface, const ExportOptions& options) {
  if (options.content) return *options.content;
  const bool picture = options.output.extension() == ".png";
  const bool has_colors = surface.has_colors() || !surface.has_data();
  return (picture && has_colors) || !surface.has_heights() ? MapContent::kColors : MapContent::kHeights;
}

void require_marks(const Surface& surface, MapContent content, const ExportOptions& options) {
  if (content != MapContent::kHeights || options.output.extension() != ".tif")
    throw UsageError("--nodata", "only a GeoTIFF of heights can say it", "write a .tif of heights");
  if (surface.dataset() == nullptr || surface.dataset()->layer("void") == nullptr) {
    throw globe::Error(surface.info().name, "it is not known which heights are filled",
                       "convert the maps with --voids mark, or leave out --nodata");
  }
}

MapPlan plan(const Surface& surface, const ExportOptions& options) {
  const std::string name = surface.info().name;
  MapPlan plan{};
  plan.map.content = content_of(surface, options);
  const bool heights = plan.map.content == MapContent::kHeights;
  if (heights && !surface.has_heights())
    throw globe::Error(name, "the planet has no heights", "export --layer color");
  if (!heights && surface.has_data() && !surface.has_colors())
    throw globe::Error(name, "the planet has no colors", "export --layer height");
  if (options.nodata) require_marks(surface, plan.map.content, options);
  plan.map.nodata = options.nodata;
  plan.level = options.level ? *options.level : default_level(surface, plan.map.content, options.extent);
  plan.map.window = window_of(options, plan.level);
  const MapWindow& window = plan.map.window;
  const bool coarser = cells_a_pixel(std::max(window.step_x_deg, window.step_y_deg), plan.level) > 1.0 + 1e-9;
  plan.sampling = options.sampling.value_or(coarser ? Sampling::kArea : Sampling::kLinear);
  plan.read_level = plan.sampling == Sampling::kArea ? area_level(window, plan.level) : plan.level;
  plan.map.ellipsoid = surface.ellipsoid();
  plan.map.body = surface.info().body;
  plan.map.vertical_datum = surface.info().vertical_datum;
  plan.map.credits = surface.info().credits;
  return plan;
}

const char* name_of(Sampling sampling) {
  switch (sampling) {
    case Sampling::kNearest:
      return "nearest";
    case Sampling::kLinear:
      return "linear";
    case Sampling::kCubic:
      return "cubic";
    case Sampling::kArea:
      break;
  }
  return "area";
}

std::string description(const Surface& surface, const MapPlan& plan) {
  const MapWindow& window = plan.map.window;
  const bool heights = plan.map.content == MapContent::kHeights;
  std::string text = std::string(heights ? "heights" : "colors") + " of " + surface.info().name +
                     ": longitudes " + number(window.west_deg) + " to " +
                     number(window.longitude(window.width)) + ", latitudes " +
                     number(window.latitude(window.height)) + " to " + number(window.north_deg) + ", " +
                     std::to_string(window.width) + "x" + std::to_string(window.height) + " pixels of " +
                     number(window.step_x_deg) + " x " + number(window.step_y_deg) + " degrees, level " +
                     std::to_string(plan.read_level) + ", filter " + name_of(plan.sampling);
  if (heights) text += "; vertical datum " + surface.info().vertical_datum;
  return text;
}

HeightKind kind_of(const MapPlan& plan, const ExportOptions& options) {
  if (plan.read_level < plan.level) return HeightKind::kFiltered;
  return options.level ? HeightKind::kSynthesised : HeightKind::kData;
}

/// The metres that 16 bits span.
std::pair<double, double> range_of(const Surface& surface, const ExportOptions& options) {
  if (options.range) return *options.range;
  if (!surface.has_data()) return {-globe::planet::kBuiltinRelief_m, globe::planet::kBuiltinRelief_m};
  const globe::planet::LayerInfo* layer = surface.dataset()->layer("height");
  return {layer->min, layer->max > layer->min ? layer->max : layer->min + 1.0};
}

}  // namespace

int default_level(const Surface& surface, MapContent content, const Extent& extent) {
  if (!surface.has_data()) return surface.data_level();
  const bool colors = content == MapContent::kColors;
  int level = colors ? surface.dataset()->layer("color")->level : surface.data_level();
  if (surface.insets().empty() || extent == Extent{}) return level;
  constexpr int kPlaces = 32;  // each way
  for (int y = 0; y < kPlaces; ++y) {
    const double lat = extent.south + (extent.north - extent.south) * (y + 0.5) / kPlaces;
    for (int x = 0; x < kPlaces; ++x) {
      const double lon = extent.west + (extent.east - extent.west) * (x + 0.5) / kPlaces;
      const globe::planet::dvec3 u = globe::geo::normal_from_degrees(lat, lon);
      level = std::max(level, colors ? surface.color_level_at(u) : surface.data_at(u).level);
    }
  }
  return level;
}

int area_level(const MapWindow& window, int finest_level) {
  const double step_deg = std::min(window.step_x_deg, window.step_y_deg);
  int level = finest_level;
  while (level > 0 && cells_a_pixel(step_deg, level - 1) >= kEnoughCells) --level;
  return level;
}

void export_map(const SurfacePointer& surface, const ExportOptions& options,
                const ConvertListener& listener) {
  const auto note = [&](const std::string& text) {
    if (listener.note) listener.note(text);
  };
  require_map_name(options.output);
  MapPlan plan = converters::plan(*surface, options);
  const bool heights = plan.map.content == MapContent::kHeights;
  note(description(*surface, plan));
  if (heights && options.output.extension() == ".png") {
    std::tie(plan.map.low_m, plan.map.high_m) = range_of(*surface, options);
    note("16 bits span " + number(plan.map.low_m) + " to " + number(plan.map.high_m) + " m: metres = " +
         number(plan.map.low_m) + " + value / 65535 * " + number(plan.map.high_m - plan.map.low_m));
  }
  const int threads = thread_count(options.threads);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  globe::PendingFile file(options.output, options.overwrite);
  const std::unique_ptr<MapWriter> writer = make_map_writer(file.temporary(), plan.map, threads);
  const std::unique_ptr<NodeValues> values =
      heights ? node_heights(surface, plan.read_level, kind_of(plan, options))
              : node_colors(surface, plan.read_level);
  const MapSampler sampler(*values, plan.sampling, plan.map.window);
  const std::size_t block_bytes = sizeof(float) * static_cast<std::size_t>(writer->block_width()) *
                                  static_cast<std::size_t>(writer->block_height()) *
                                  static_cast<std::size_t>(plan.map.channels());
  std::size_t blocks_at_once = static_cast<std::size_t>(kTokensAThread * threads);
  if (options.memory_bytes > 0)
    blocks_at_once = std::clamp(options.memory_bytes / block_bytes, std::size_t{1}, blocks_at_once);
  tbb::task_arena arena(threads);
  arena.execute([&] {
    write_blocks(*surface, plan.read_level, sampler, plan.map, *writer, blocks_at_once, [&](double fraction) {
      if (listener.progress) listener.progress("writing the map", fraction);
    });
  });
  writer->finish();
  file.publish();
}

}  // namespace converters
