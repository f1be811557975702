#include "converters/convert.h"

#include <tbb/global_control.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <thread>

#include "converters/layer_output.h"
#include "converters/output_folder.h"
#include "converters/srgb.h"
#include "globe/base/error.h"

namespace converters {
namespace {

using globe::geo::Ellipsoid;

/// Beyond this many rows a cell, the area filter starts from averaged blocks of samples.
constexpr double kEnoughRowsPerCell = 16.0;

/// Of the memory cap: what the program takes before it holds any map (seen 128 MB, its libraries), decoders
/// and windows.
constexpr std::size_t kReservedBytes = std::size_t{160} << 20;

struct KnownBody {
  const char* name;
  const Ellipsoid& ellipsoid;
  std::vector<const char*> words;  ///< that give it away in a file's name or description
};

const std::vector<KnownBody>& known_bodies() {
  static const std::vector<KnownBody> bodies{
      {"earth", globe::geo::kWgs84, {"earth", "etopo", "gebco", "srtm", "bluemarble", "blue marble"}},
      {"moon", globe::geo::kMoon, {"moon", "lunar", "luna", "gld100", "lola"}},
      {"mars", globe::geo::kMars, {"mars", "martian", "mola", "megt", "megr"}}};
  return bodies;
}

std::string body_of(const Ellipsoid& ellipsoid) {
  for (const KnownBody& body : known_bodies()) {
    if (body.ellipsoid == ellipsoid) return body.name;
  }
  return "other";
}

/// The body a file seems to show, or "".
std::string hinted_body(const RasterInfo& info) {
  std::string text = info.name + " " + info.description;
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  for (const KnownBody& body : known_bodies()) {
    const auto says = [&](const char* word) { return text.find(word) != std::string::npos; };
    if (std::any_of(body.words.begin(), body.words.end(), says)) return body.name;
  }
  return "";
}

const char* name_of(Filter filter) {
  switch (filter) {
    case Filter::kNearest:
      return "nearest";
    case Filter::kBilinear:
      return "bilinear";
    case Filter::kBicubic:
      return "bicubic";
    case Filter::kArea:
      break;
  }
  return "area";
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

/// A map opened and understood, before anything is written.
struct PlannedMap {
  std::unique_ptr<RasterSource> raster;
  MapGeometry geometry;
  ValueRule rule;
  int level;
  Filter filter;
  int factor;  ///< samples averaged on reading, each way
};

int reading_factor(const MapGeometry& geometry, Filter filter, Registration registration, int level) {
  if (filter != Filter::kArea || registration == Registration::kPoint) return 1;
  const double rows_per_cell = geometry.samples_per_quadrant() / globe::planet::nodes_per_side(level);
  int factor = 1;
  while (rows_per_cell / (2 * factor) >= kEnoughRowsPerCell && geometry.width % (4 * factor) == 0 &&
         geometry.height % (2 * factor) == 0) {
    factor *= 2;
  }
  return factor;
}

/// Serialises what the listener hears.
class Report {
 public:
  explicit Report(const ConvertListener& listener) : listener_(listener) {}
  void note(const std::string& text) const {
    const std::lock_guard lock(mutex_);
    if (listener_.note) listener_.note(text);
  }
  void warning(const std::string& text) const {
    const std::lock_guard lock(mutex_);
    if (listener_.warning) listener_.warning(text);
  }
  std::function<void(double)> stage(const std::string& name) const {
    return [this, name](double fraction) {
      const std::lock_guard lock(mutex_);
      if (listener_.progress) listener_.progress(name, fraction);
    };
  }

 private:
  const ConvertListener& listener_;
  mutable std::mutex mutex_;
};

PlannedMap plan(const MapInput& input, MapKind kind, std::optional<int> level, const ConvertOptions& options,
                const Ellipsoid& ellipsoid, int threads, const Report& report) {
  PlannedMap map;
  map.raster = open_image(input.path, threads);
  const RasterInfo& info = map.raster->info();
  const std::string what = kind == MapKind::kHeights ? "heights " : "color ";
  const Extent extent = input.extent.value_or(info.extent.value_or(Extent{}));
  const Registration registration = input.registration.value_or(Registration::kArea);
  map.geometry = whole_planet_geometry(input.path.string(), info.width, info.height, extent, registration,
                                       options.latitude, ellipsoid);
  map.rule.kind = kind;
  if (kind == MapKind::kHeights) {
    map.rule.scale = options.scale;
    map.rule.offset = options.offset;
    map.rule.nodata = options.nodata ? options.nodata : info.nodata;
    if (info.channels > 1)
      report.warning(what + info.name + " has " + std::to_string(info.channels) +
                     " channels; the first is used");
  }
  map.level = level.value_or(default_level(map.geometry));
  const bool finer = map.geometry.samples_per_quadrant() > globe::planet::nodes_per_side(map.level);
  map.filter = options.filter.value_or(finer ? Filter::kArea : Filter::kBilinear);
  map.factor = reading_factor(map.geometry, map.filter, registration, map.level);
  const std::string hint = hinted_body(info);
  if (!hint.empty() && hint != body_of(ellipsoid)) {
    report.warning(what + info.name + " looks like the " + hint + ", but the ellipsoid is that of " +
                   (body_of(ellipsoid) == "other" ? "another body" : "the " + body_of(ellipsoid)) +
                   "; see --ellipsoid");
  }
  report.note(what + info.name + ": " + std::to_string(info.width) + "x" + std::to_string(info.height) +
              ", longitudes " + number(extent.west) + " to " + number(extent.east) +
              (input.extent || info.extent ? "" : " (assumed; --extent)") + ", " +
              (registration == Registration::kArea ? "areas" : "points") +
              (input.registration ? "" : " (assumed; --registration)") + "; level " +
              std::to_string(map.level) + ", " + number(map.geometry.samples_per_quadrant()) +
              " samples on " + std::to_string(globe::planet::nodes_per_side(map.level)) +
              " cells in 90 degrees, filter " + name_of(map.filter));
  return map;
}

std::string credit_of(const PlannedMap& map) {
  const RasterInfo& info = map.raster->info();
  return std::string(map.rule.kind == MapKind::kHeights ? "heights" : "color") + " from " + info.name + " (" +
         std::to_string(info.width) + "x" + std::to_string(info.height) + "), filter " + name_of(map.filter);
}

SourceMap load(PlannedMap& map, MemoryBudget& budget, const Report& report) {
  const std::string what = map.rule.kind == MapKind::kHeights ? "heights" : "color";
  SourceMap source(*map.raster, map.geometry, map.rule, map.factor, budget, report.stage("reading " + what));
  if (source.has_voids()) {
    char share[32];
    std::snprintf(share, sizeof share, "%.4g %%", 100.0 * source.void_share());
    report.warning(what + " " + map.raster->info().name + ": " + share +
                   " of the surface is void, filled from around it");
  }
  return source;
}

NodeGrid<float> sample_heights(const SourceMap& source, const PlannedMap& map, MemoryBudget& budget,
                               const Report& report) {
  NodeGrid<float> grid(map.level, 1, budget);
  const std::function<void(double)> progress = report.stage("sampling heights");
  for (int d = 0; d < globe::planet::kDiamonds; ++d) {
    const RowSink sink = [&, d](int i, int j, int count, const float* values) {
      std::copy_n(values, count, grid.at(d, i, j));
    };
    sample_nodes(source, map.filter, whole_diamond(d, map.level), sink, [&](double fraction) {
      grid.drop_pages();
      progress((d + fraction) / globe::planet::kDiamonds);
    });
  }
  return grid;
}

NodeGrid<std::uint8_t> sample_colors(const SourceMap& source, const PlannedMap& map, MemoryBudget& budget,
                                     const Report& report) {
  const int channels = source.channels();
  NodeGrid<std::uint8_t> grid(map.level, channels, budget);
  const std::function<void(double)> progress = report.stage("sampling color");
  for (int d = 0; d < globe::planet::kDiamonds; ++d) {
    const RowSink sink = [&, d](int i, int j, int count, const float* values) {
      std::transform(values, values + count * channels, grid.at(d, i, j), srgb_byte_from_linear);
    };
    sample_nodes(source, map.filter, whole_diamond(d, map.level), sink, [&](double fraction) {
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
  std::optional<SourceMap> source = load(map, budget, report);
  std::vector<globe::planet::StoredLayer> stored;
  arena.execute([&] {
    std::vector<LayerOutput> layers;
    if (map.rule.kind == MapKind::kHeights) {
      NodeGrid<float> heights = sample_heights(*source, map, budget, report);
      source.reset();
      layers = height_layers(std::move(heights), ellipsoid, budget);
    } else {
      NodeGrid<std::uint8_t> colors = sample_colors(*source, map, budget, report);
      source.reset();
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

int default_level(const MapGeometry& geometry) {
  int level = 0;
  while (globe::planet::nodes_per_side(level) < geometry.samples_per_quadrant()) ++level;
  return level;
}

void convert(const ConvertOptions& options, const ConvertListener& listener) {
  const Report report(listener);
  const int threads = options.threads > 0
                          ? options.threads
                          : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const Ellipsoid ellipsoid = options.ellipsoid.value_or(globe::geo::kWgs84);
  report.note("ellipsoid a = " + number(ellipsoid.a) +
              " m, f = " + (ellipsoid.f == 0.0 ? "0" : "1/" + number(1.0 / ellipsoid.f)) +
              (options.ellipsoid ? "" : " (wgs84 assumed; --ellipsoid)"));
  std::optional<PlannedMap> heights;
  std::optional<PlannedMap> colors;
  if (options.heights)
    heights = plan(*options.heights, MapKind::kHeights, options.level, options, ellipsoid, threads, report);
  if (options.colors) {
    colors = plan(*options.colors, MapKind::kColors, heights ? std::nullopt : options.level, options,
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
