#include "app/flat_region.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <vector>

#include "app/parse_options.h"
#include "app/planet_argument.h"
#include "app/point.h"
#include "app/progress.h"
#include "converters/local_ground.h"
#include "converters/resources.h"
#include "flat/fractal/ground.h"
#include "flat/globe_region.h"
#include "flat/height_grid.h"
#include "globe/base/error.h"
#include "globe/planet/appearance.h"
#include "globe/render/view_block.h"

namespace app {
namespace {

namespace fs = std::filesystem;
namespace flat = globe::flat;
namespace geo = globe::geo;
using flat::kPatchCells;
using glm::dvec3;

constexpr double kPlanetSide = 40'000.0;
constexpr int kPlanetPosts = 1024;  ///< and one
constexpr double kWidest = 4'000'000.0;
constexpr int kEdgePlaces = 64;  ///< that are looked at along a side
constexpr double kKnownShare = 0.99;
constexpr double kSmallest = 0.5;  ///< share of the outline that voids at the rim may leave

/// Half the width and height of a region, metres.
struct HalfSize {
  double east, north;
};

std::optional<double> length_of(const std::string& text, const std::string& option) {
  if (text.empty()) return std::nullopt;
  const double metres = parse_length_m(text);
  if (metres > 0.0 && metres <= kWidest) return metres;
  throw globe::UsageError(option + " " + text, "not a length up to 4000 km", "give one such as 40km");
}

std::optional<geo::Geodetic> center_of(const LocalRegionOptions& options) {
  if (options.center.empty()) return std::nullopt;
  return parse_point(options.center).position;
}

/// The posts of whole patches within half a size around the middle.
flat::PostRect posts_within(const HalfSize& half, double spacing_m, const std::string& name) {
  const auto patches = [&](double metres) {
    return static_cast<int>(std::floor(2.0 * metres / (spacing_m * kPatchCells) + 1e-9));
  };
  const int east = patches(half.east);
  const int north = patches(half.north);
  if (east < 1 || north < 1) {
    throw globe::Error(name, "is smaller than 16 posts a side", "give a finer --spacing or a larger --side");
  }
  return {-std::int64_t{east} * kPatchCells / 2, -std::int64_t{north} * kPatchCells / 2,
          east * kPatchCells + 1, north * kPatchCells + 1, 1};
}

/// The spacing asked for, or one that gives no more than kMostPosts a side.
double spacing_for(const std::optional<double>& asked, double usual_m, const HalfSize& half,
                   const std::string& name) {
  const double longest = 2.0 * std::max(half.east, half.north);
  const double least = longest / (kMostPosts - 1);
  if (asked && *asked < least) {
    char text[96];
    std::snprintf(text, sizeof text, "give %.4g m or more, or a smaller --side", least);
    throw globe::UsageError("--spacing", "makes more than 4097 posts a side", text);
  }
  if (!asked && usual_m < least) {
    std::fprintf(stderr, "globe: warning: %s: drawn with posts %.4g m apart, its samples are %.4g m apart\n",
                 name.c_str(), least, usual_m);
  }
  return asked.value_or(std::max(usual_m, least));
}

/// The largest rectangle around the middle, with the raster's own proportions in the frame, along whose sides
/// nearly all is known.
HalfSize known_size(const converters::LocalGround& ground, const flat::TangentFrame& frame) {
  const auto local = [&](double x, double y) {
    return frame.local_from_geodetic(geo::degrees_from_normal(ground.normal_of(x, y)));
  };
  const double last_x = ground.width() - 1.0;
  const double last_y = ground.height() - 1.0;
  HalfSize outline{0, 0};
  for (const dvec3& corner : {local(0, 0), local(last_x, 0), local(0, last_y), local(last_x, last_y)}) {
    outline.east = std::max(outline.east, std::abs(corner.x));
    outline.north = std::max(outline.north, std::abs(corner.y));
  }
  // Sides of the raster are no straight lines in the frame: the nearest place of each counts.
  HalfSize half = outline;
  const auto narrow = [&](const dvec3& at) {
    if (std::abs(at.x) * outline.north > std::abs(at.y) * outline.east) {
      half.east = std::min(half.east, std::abs(at.x));
    } else {
      half.north = std::min(half.north, std::abs(at.y));
    }
  };
  for (int k = 0; k <= 8; ++k) {
    narrow(local(last_x * k / 8, 0.0));
    narrow(local(last_x * k / 8, last_y));
    narrow(local(0.0, last_y * k / 8));
    narrow(local(last_x, last_y * k / 8));
  }
  const HalfSize widest = half;
  for (double share = 1.0; share > kSmallest; share -= 0.02) {
    half = {widest.east * share, widest.north * share};
    int known = 0;
    for (int k = 0; k < kEdgePlaces; ++k) {
      const double t = 2.0 * k / (kEdgePlaces - 1) - 1.0;
      for (const dvec3& at : {dvec3(half.east, t * half.north, 0), dvec3(-half.east, t * half.north, 0),
                              dvec3(t * half.east, half.north, 0), dvec3(t * half.east, -half.north, 0)})
        known += ground.is_known(frame.normal_at(at.x, at.y, 0.0)) ? 1 : 0;
    }
    if (known >= kKnownShare * 4 * kEdgePlaces) return half;
  }
  return widest;
}

FlatRegion region_of_map(const ViewOptions& options, const LocalRegionOptions& asked) {
  Progress progress(progress_style(options.quiet, false));
  const auto ground = std::make_shared<converters::LocalGround>(
      converters::MapInput{options.planet}, geo::kWgs84, static_cast<std::size_t>(options.memory_mb) << 20,
      converters::thread_count(0), [&](double share) { progress.show("reading heights", share); });
  const double middle_x = 0.5 * (ground->width() - 1), middle_y = 0.5 * (ground->height() - 1);
  const geo::Geodetic middle = geo::degrees_from_normal(ground->normal_of(middle_x, middle_y));
  const geo::Geodetic center = center_of(asked).value_or(middle);
  const flat::TangentFrame frame(geo::kWgs84, center.lat_deg, center.lon_deg);
  HalfSize half{0, 0};
  if (const auto side = length_of(asked.side, "--side")) {
    half = {*side / 2.0, *side / 2.0};
  } else {
    half = known_size(*ground, frame);
  }
  const auto apart = [&](double x, double y) {
    return glm::distance(geo::surface_point(geo::kWgs84, ground->normal_of(middle_x + x, middle_y + y)),
                         geo::surface_point(geo::kWgs84, ground->normal_of(middle_x, middle_y)));
  };
  const double sample_m = std::min(apart(1, 0), apart(0, 1));
  const double spacing = spacing_for(length_of(asked.spacing, "--spacing"), sample_m, half, options.planet);
  const flat::GroundHeights heights = [&](std::span<const dvec3> normals, std::span<float> out) {
    ground->heights(normals, out);
    for (float& height : out) height *= static_cast<float>(options.exaggeration);
  };
  const flat::HeightGrid grid =
      flat::sample_ground(frame, spacing, posts_within(half, spacing, options.planet), heights, 0.005,
                          [&](double share) { progress.show("sampling heights", share); });
  progress.clear();
  if (ground->void_share() > 0.0) {
    std::fprintf(stderr, "globe: warning: %s: %.3g %% of the map is void, filled from around\n",
                 options.planet.c_str(), 100.0 * ground->void_share());
  }
  FlatRegion region;
  region.terrain = std::make_shared<const flat::Terrain>(frame, grid, *grid.extent());
  return region;
}

/// A square of a planet, at the level of detail that its posts need.
struct PartOfPlanet {
  std::string name;  ///< for messages
  geo::Geodetic center;
  double side_m;
  std::optional<double> spacing_m;
};

FlatRegion part_of(const std::shared_ptr<const globe::planet::Surface>& surface, const PartOfPlanet& part,
                   ProgressStyle style) {
  const HalfSize half{part.side_m / 2.0, part.side_m / 2.0};
  // Its corners must lie within half a radius of the middle (TangentFrame::z_at).
  const double widest_m = 0.7 * std::min(surface->ellipsoid().a, surface->ellipsoid().b());
  if (part.side_m > widest_m) {
    char text[96];
    std::snprintf(text, sizeof text, "give a side of %.4g m or less", widest_m);
    throw globe::Error(part.name, "is too wide for the planet", text);
  }
  const double spacing = spacing_for(part.spacing_m, part.side_m / kPlanetPosts, half, part.name);
  const flat::TangentFrame frame(surface->ellipsoid(), part.center.lat_deg, part.center.lon_deg);
  const int level = std::clamp(static_cast<int>(std::ceil(std::log2(surface->root_edge() / spacing))), 0, 26);
  const flat::GroundHeights heights = [&](std::span<const dvec3> normals, std::span<float> out) {
    for (std::size_t k = 0; k < normals.size(); ++k)
      out[k] = static_cast<float>(surface->mesh_height(surface->height(normals[k], level)));
  };
  Progress progress(style);
  const flat::HeightGrid grid =
      flat::sample_ground(frame, spacing, posts_within(half, spacing, part.name), heights, 0.005,
                          [&](double share) { progress.show("sampling heights", share); });
  progress.clear();
  FlatRegion region;
  region.terrain = std::make_shared<const flat::Terrain>(frame, grid, *grid.extent());
  region.body = surface->info().body;
  region.air = globe::render::has_air(surface->info());
  region.level = level;
  region.knowledge = [surface, level](const dvec3& normal, globe::planet::Ground& ground) {
    const globe::planet::Place place = globe::planet::locate(normal, level);
    const globe::planet::Node node{place.d, level, static_cast<int>(std::lround(place.ij.x)),
                                   static_cast<int>(std::lround(place.ij.y))};
    const auto tile = surface->tile(globe::planet::tile_of(node));
    const globe::planet::Ground known = globe::planet::tile_ground(*surface, *tile, node.i, node.j);
    const globe::planet::Ground measured = ground;
    ground = known;
    ground.slope = measured.slope;
    ground.cavity = measured.cavity;
    ground.sin_latitude = measured.sin_latitude;
    ground.edge_m = measured.edge_m;
  };
  return region;
}

FlatRegion region_of_planet(const ViewOptions& options, const LocalRegionOptions& asked,
                            const std::optional<geo::Geodetic>& around) {
  const auto center = asked.center.empty() ? around : center_of(asked);
  if (!center) {
    throw globe::UsageError(options.planet, "nothing says which part of the planet",
                            "give --center LAT,LON, or --at");
  }
  return part_of(open_planet(options),
                 {options.planet, *center, length_of(asked.side, "--side").value_or(kPlanetSide),
                  length_of(asked.spacing, "--spacing")},
                 progress_style(options.quiet, false));
}

/// Around the lattice's origin, wherever on the ellipsoid that is.
FlatRegion region_of_fractal(const ViewOptions& options, const LocalRegionOptions& asked,
                             const std::optional<geo::Geodetic>& around) {
  flat::fractal::Settings settings = fractal_settings(asked.fractal, options.planet);
  if (!asked.spacing.empty()) {
    throw globe::UsageError("--spacing", "fractal ground has posts 1/2^iterations of an area apart",
                            "give --area and --iterations");
  }
  settings.relief_m *= options.exaggeration;  // heights above the base go by it
  settings.base_m *= options.exaggeration;
  const geo::Geodetic center =
      (asked.center.empty() ? around : center_of(asked)).value_or(geo::Geodetic{45.0, 0.0, 0.0});
  const double side = length_of(asked.side, "--side").value_or(settings.area_m);
  const HalfSize half{side / 2.0, side / 2.0};
  const double spacing = settings.spacing_m();
  if (side / spacing > kMostPosts - 1) {
    throw globe::UsageError(options.planet, "makes more than 4097 posts a side",
                            "give a smaller --side or fewer --iterations");
  }
  const flat::fractal::FractalSource source(settings);
  FlatRegion region;
  region.terrain =
      std::make_shared<const flat::Terrain>(flat::TangentFrame(geo::kWgs84, center.lat_deg, center.lon_deg),
                                            source, posts_within(half, spacing, options.planet));
  return region;
}

bool names_planet(const std::string& word) {
  return procedural_seed(word).has_value() || fs::exists(fs::path(word) / "planet.json");
}

}  // namespace

void add_local_region_options(CLI::App& command, LocalRegionOptions& options) {
  command.add_option("--center", options.center,
                     "LAT,LON: the middle of the region (default: of the map; of a planet where --at is)");
  command.add_option(
      "--side", options.side,
      "its width, such as 40km (default: all of the map; 40 km of a planet; an area of fractal ground)");
  command.add_option("--spacing", options.spacing,
                     "between posts, such as 30m (default: between the map's samples; of a planet 1/1024 of "
                     "the side)");
  add_fractal_options(command, options.fractal);
}

FlatRegion open_region(const ViewOptions& options, const LocalRegionOptions& region,
                       const std::optional<geo::Geodetic>& around) {
  if (fractal_seed(options.planet)) return region_of_fractal(options, region, around);
  if (names_planet(options.planet)) return region_of_planet(options, region, around);
  return region_of_map(options, region);
}

std::optional<FlatRegion> region_of(const std::optional<globe::scene::Scene>& scene,
                                    const std::shared_ptr<const globe::planet::Surface>& surface,
                                    bool quiet) {
  if (!scene || !scene->region) return std::nullopt;
  const globe::scene::Region& asked = *scene->region;
  return part_of(surface, {scene->file.string() + ": region", asked.center, asked.side_m, asked.spacing_m},
                 progress_style(quiet, false));
}

std::unique_ptr<globe::render::RegionRenderer> region_in_globe(
    const std::optional<FlatRegion>& region, const std::optional<globe::scene::Scene>& scene,
    const globe::render::RenderSettings& settings) {
  if (!region || !scene->region) return nullptr;
  const globe::scene::Region& asked = *scene->region;
  flat::GroundSettings ground;
  ground.error_px = asked.error_px;
  ground.shadows = asked.shadows;
  if (asked.materials) ground.materials = flat::grass_stone_and_mud(*region->terrain);
  ground.show = settings.show;
  ground.wireframe = settings.wireframe;
  ground.morph = settings.clipmap.morph ? flat::Morph::kGpu : flat::Morph::kOff;
  ground.air_steps = settings.air;
  return std::make_unique<flat::GlobeRegion>(region->terrain, region->knowledge, ground);
}

}  // namespace app
