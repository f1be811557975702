#include "converters/inset.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <set>

#include "converters/inset_footprint.h"
#include "converters/inset_output.h"
#include "converters/inset_shape.h"
#include "converters/map_plan.h"
#include "converters/number_text.h"
#include "converters/report.h"
#include "converters/resources.h"
#include "globe/base/error.h"
#include "globe/planet/planet_file.h"
#include "globe/planet/surface.h"

namespace converters {
namespace {

namespace fs = std::filesystem;
using globe::planet::InsetBlock;
using globe::planet::LayerInfo;
using globe::planet::PlanetFile;
using globe::planet::StoredInset;

constexpr float kNoData = std::numeric_limits<float>::quiet_NaN();
constexpr int kFinestInset = 24;        ///< nodes 60 cm apart on the Earth
constexpr std::size_t kNodeBytes = 40;  ///< working memory of a node, at the most

/// The rasters of one layer, and where they go.
struct InsetPlan {
  std::string layer;
  int below = 0;  ///< level of the planet's own
  PlannedLayer maps;
};

const LayerInfo* find_layer(const PlanetFile& planet, const std::string& name) {
  const auto found = std::find_if(planet.info.layers.begin(), planet.info.layers.end(),
                                  [&](const LayerInfo& layer) { return layer.name == name; });
  return found == planet.info.layers.end() ? nullptr : &*found;
}

InsetPlan plan_inset(const InsetOptions& options, const PlanetFile& planet, MapKind kind,
                     std::optional<int> level, int threads, const Report& report) {
  const bool heights = kind == MapKind::kHeights;
  InsetPlan plan{heights ? "height" : "color", 0, {}};
  const LayerInfo* below = find_layer(planet, plan.layer);
  if (below == nullptr) {
    throw globe::Error(
        options.planet.string(),
        std::string("the planet has no ") + (heights ? "heights" : "colors") + " to lay them over",
        std::string("convert it with ") + (heights ? "a height map" : "--color"));
  }
  plan.below = below->level;
  plan.maps.kind = kind;
  int fits = 0;
  for (const MapInput& input : heights ? options.heights : options.colors) {
    PlannedMap map;
    map.opened = open_map(input, kind, {planet.info.ellipsoid, Latitude::kGeodetic}, threads);
    if (map.opened.geometry.is_whole_planet()) {
      throw globe::Error(input.path.string(),
                         "is taken as a map of the whole planet (" + map.opened.frame + ")",
                         "make a planet of it by globe convert, or say where it lies by --extent or --crs");
    }
    fits = std::max(fits, default_level(map.opened.geometry));
    plan.maps.maps.push_back(std::move(map));
  }
  plan.maps.level = level.value_or(fits);
  const int coarsest = std::max(plan.below, globe::planet::kCoarsestInset);
  if (plan.maps.level < coarsest || plan.maps.level > kFinestInset) {
    const std::string which =
        "level " + std::to_string(plan.maps.level) + (level ? "" : ", which fits its samples,");
    if (plan.maps.level > kFinestInset)
      throw globe::Error(plan.layer, which + " is finer than insets can be",
                         "give --level " + std::to_string(kFinestInset) + " or less");
    throw globe::Error(
        plan.layer,
        which + " is coarser than " + (coarsest == plan.below ? "the planet's own" : "insets can be") + ", " +
            std::to_string(coarsest),
        "give data finer than the planet, or --level " + std::to_string(coarsest) + " or more");
  }
  for (PlannedMap& map : plan.maps.maps) {
    map.filter = options.filter.value_or(default_filter(map.opened.geometry, plan.maps.level));
    map.factor = reading_factor(map.opened.geometry, map.filter, plan.maps.level);
    const RasterInfo& info = map.opened.info;
    report.note(plan.layer + " " + info.name + ": " + std::to_string(info.width) + "x" +
                std::to_string(info.height) + ", " + map.opened.frame +
                (map.opened.values.empty() ? "" : ", " + map.opened.values) + "; level " +
                std::to_string(plan.maps.level));
  }
  return plan;
}

/// Samples the maps at the nodes of their footprint; tiles without data do not come to be.
std::vector<InsetGrid<float>> sample_maps(const MapStack& maps, int level,
                                          const std::vector<InsetBlock>& blocks,
                                          const std::function<void(double)>& progress) {
  const auto channels = static_cast<std::size_t>(maps.channels());
  std::vector<InsetGrid<float>> grids;
  for (std::size_t c = 0; c < channels; ++c) grids.emplace_back(level, bounds_of(blocks), kNoData);
  struct Sampled {
    std::vector<float> values, weights;
  };
  constexpr std::size_t kAtOnce = 512;
  for (std::size_t first = 0; first < blocks.size(); first += kAtOnce) {
    std::vector<Sampled> batch(std::min(kAtOnce, blocks.size() - first));
    tbb::parallel_for(std::size_t{0}, batch.size(), [&](std::size_t k) {
      const InsetBlock& block = blocks[first + k];
      const NodeRect rect{
          block.d, level, block.i0, block.j0, block.i1 - block.i0 + 1, block.j1 - block.j0 + 1};
      const auto count = static_cast<std::size_t>(rect.ni) * static_cast<std::size_t>(rect.nj);
      batch[k].values.resize(count * channels);
      batch[k].weights.resize(count);
      sample_rect(maps, rect, Gaps::kZero, batch[k].values.data(), batch[k].weights.data());
    });
    for (std::size_t k = 0; k < batch.size(); ++k) {
      const InsetBlock& block = blocks[first + k];
      std::size_t at = 0;
      for (int j = block.j0; j <= block.j1; ++j) {
        for (int i = block.i0; i <= block.i1; ++i, ++at) {
          const bool known = batch[k].weights[at] >= 0.5F;
          for (std::size_t c = 0; c < channels; ++c)
            grids[c].set(block.d, i, j, known ? batch[k].values[at * channels + c] : kNoData);
        }
      }
    }
    progress(static_cast<double>(first + batch.size()) / static_cast<double>(blocks.size()));
  }
  return grids;
}

/// Nodes. Of heights so wide that the blend adds a slope of 1 in 5 where they lie as far from what is below
/// them as on average; of colors a sixteenth of the width of the data. At most a quarter of that width.
int fitting_rim(const fs::path& folder, const InsetPlan& plan, const InsetGrid<float>& values,
                std::size_t data, double edge_m) {
  constexpr double kRunOverRise = 8.0;
  const double width = std::sqrt(static_cast<double>(data));
  double rim = std::min(width / 16.0, 256.0);
  if (plan.layer == "height") {
    const auto surface = globe::planet::Surface::from_dataset(std::make_shared<const globe::planet::Dataset>(
        globe::planet::Dataset::open(folder, std::size_t{32} << 20)));
    double squares = 0.0;
    std::size_t count = 0, passed = 0;
    const std::size_t step = data / 20000 + 1;
    for_each_vertex(values, [&](const globe::planet::Node& node) {
      const float height = values.get(node);
      if (std::isnan(height) || passed++ % step != 0) return;
      squares += std::pow(static_cast<double>(height) - surface->data_height(node), 2.0);
      ++count;
    });
    rim = std::max(16.0, kRunOverRise * std::sqrt(squares / static_cast<double>(count)) / edge_m);
  }
  return static_cast<int>(std::clamp(std::min(rim, width / 4.0), 8.0, 4096.0));
}

StoredInset make_layer(const InsetOptions& options, const PlanetFile& planet, InsetPlan& plan,
                       std::size_t memory_bytes, std::vector<fs::path>& made, const Report& report) {
  const int level = plan.maps.level;
  std::vector<MapGeometry> geometries;
  for (const PlannedMap& map : plan.maps.maps) geometries.push_back(map.opened.geometry);
  const std::vector<InsetBlock> blocks = footprint_blocks(geometries, level, globe::planet::kInsetMargin + 2);
  if (blocks.size() * kNodeBytes * InsetGrid<float>::kTile * InsetGrid<float>::kTile > memory_bytes) {
    throw globe::Error(options.name,
                       "its nodes at level " + std::to_string(level) + " need more than the " +
                           std::to_string(memory_bytes >> 20) + " MB of memory allowed",
                       "take fewer or coarser data, a lower --level, or more --memory");
  }
  MemoryBudget budget{memory_bytes / 2, options.planet};
  const MapStack maps =
      load_layer(plan.maps, budget, report, "filled where narrow, else showing the ground below");
  std::vector<InsetGrid<float>> grids =
      sample_maps(maps, level, blocks, report.stage(plan.layer + " sampling"));
  std::size_t data = 0;
  for_each_vertex(grids.front(), [&](const globe::planet::Node& node) {
    data += std::isnan(grids.front().get(node)) ? 0 : 1;
  });
  if (data == 0)
    throw globe::Error(options.name, "no node of the planet lies in its data", "look at the file");
  const double edge_m = std::ldexp(planet.info.ellipsoid.mean_radius() * std::numbers::pi / 2.0, -level);
  ShapeRule rule;
  rule.rim = options.rim_m ? static_cast<int>(std::lround(std::clamp(*options.rim_m / edge_m, 4.0, 4096.0)))
                           : fitting_rim(options.planet, plan, grids.front(), data, edge_m);
  rule.widest_gap = std::ldexp(1.0, level - plan.below);
  ShapeReport shape;
  const InsetSamples samples = shape_inset(std::move(grids), rule, shape);
  report.note(
      plan.layer + " " + options.name + ": " + std::to_string(shape.data) + " nodes " +
      number_text(std::round(edge_m * 100.0) / 100.0) + " m apart, rim " +
      number_text(std::round(shape.rim * edge_m)) + " m" +
      (shape.filled > 0 ? ", " + std::to_string(shape.filled) + " nodes of narrow voids filled" : "") +
      (shape.open > 0 ? ", " + std::to_string(shape.open) + " nodes of wide voids left open" : ""));
  InsetOutput output = write_inset(options.planet, options.name, plan.layer, samples, planet.info.tile_size);
  made.insert(made.end(), output.made.begin(), output.made.end());
  return std::move(output.stored);
}

/// Takes the place of an inset of the same name over the same layer, else the topmost.
void put(PlanetFile& planet, StoredInset inset) {
  const auto old = std::find_if(planet.insets.begin(), planet.insets.end(), [&](const StoredInset& other) {
    return other.info.name == inset.info.name && other.info.layer == inset.info.layer;
  });
  if (old == planet.insets.end()) {
    planet.insets.push_back(std::move(inset));
  } else {
    *old = std::move(inset);
  }
}

std::set<std::string> inset_file_names(const PlanetFile& planet) {
  std::set<std::string> names;
  for (const StoredInset& inset : planet.insets) {
    for (const auto& block : inset.files)
      for (const auto& file : block) names.insert(file.name);
  }
  return names;
}

std::string credit_prefix(const std::string& name) { return "inset " + name + ": "; }

}  // namespace

void lay_inset(const InsetOptions& options, const ConvertListener& listener) {
  const Report report(listener);
  if (!globe::planet::is_inset_name(options.name)) {
    throw globe::UsageError("--name " + options.name, "is no name for an inset",
                            "give letters, digits, '.', '_' and '-', not data nor synthesised");
  }
  globe::planet::Dataset::open(options.planet, 0);  // every file whole, or one clear line
  const PlanetLock lock(options.planet);
  PlanetFile planet = globe::planet::read_planet_file(options.planet);
  const bool taken = std::any_of(planet.insets.begin(), planet.insets.end(),
                                 [&](const StoredInset& inset) { return inset.info.name == options.name; });
  if (taken && !options.overwrite)
    throw globe::Error(options.planet.string(), "it has an inset " + options.name + " already",
                       "give another --name, or --overwrite");
  const int threads = thread_count(options.threads);
  const tbb::global_control cap(tbb::global_control::max_allowed_parallelism,
                                static_cast<std::size_t>(threads));
  const std::size_t memory = memory_cap(options.memory_bytes);

  std::vector<InsetPlan> plans;
  if (!options.heights.empty())
    plans.push_back(plan_inset(options, planet, MapKind::kHeights, options.level, threads, report));
  if (!options.colors.empty()) {
    plans.push_back(plan_inset(options, planet, MapKind::kColors,
                               options.heights.empty() ? options.level : std::nullopt, threads, report));
  }
  const std::set<std::string> before = inset_file_names(planet);
  std::erase_if(planet.info.credits,
                [&](const std::string& credit) { return credit.starts_with(credit_prefix(options.name)); });
  std::vector<std::string> layers;
  std::vector<fs::path> made;
  try {
    for (InsetPlan& plan : plans) {
      put(planet, make_layer(options, planet, plan, memory, made, report));
      layers.push_back(plan.layer);
      for (const std::string& credit : credits_of(plan.maps))
        planet.info.credits.push_back(credit_prefix(options.name) + credit);
    }
    std::erase_if(planet.insets, [&](const StoredInset& inset) {
      return inset.info.name == options.name &&
             std::count(layers.begin(), layers.end(), inset.info.layer) == 0;
    });
    for (const std::string& credit : options.credits)
      planet.info.credits.push_back(credit_prefix(options.name) + credit);
    planet.info.credits.push_back(credit_prefix(options.name) + options.program_version);
    globe::planet::write_planet_file(options.planet, planet);
  } catch (...) {
    const std::set<std::string> listed = inset_file_names(globe::planet::read_planet_file(options.planet));
    std::error_code ignored;
    for (const fs::path& file : made)
      if (!listed.contains(file.filename().string())) fs::remove(file, ignored);
    throw;
  }
  const std::set<std::string> after = inset_file_names(planet);
  std::error_code ignored;
  for (const std::string& name : before)
    if (!after.contains(name)) fs::remove(options.planet / name, ignored);
}

}  // namespace converters
