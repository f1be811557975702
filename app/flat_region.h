#pragma once

#include <memory>
#include <optional>
#include <string>

#include "app/fractal_options.h"
#include "app/view_options.h"
#include "flat/geomipmap_ground.h"
#include "flat/lightmap.h"
#include "flat/terrain.h"
#include "globe/render/globe_renderer.h"
#include "globe/render/region_renderer.h"
#include "globe/scene/scene.h"

namespace app {

/// What part of the ground `globe flat` draws, as it is written.
struct LocalRegionOptions {
  std::string center;   ///< LAT,LON
  std::string side;     ///< with a unit
  std::string spacing;  ///< likewise
  FractalOptions fractal;
};
void add_local_region_options(CLI::App& command, LocalRegionOptions& options);

/// A region that is open.
struct FlatRegion {
  std::shared_ptr<const globe::flat::Terrain> terrain;
  globe::flat::GroundKnowledge knowledge;  ///< of its colours
  std::string body = "earth";              ///< as PlanetInfo::body has it
  bool air = true;
  int level = 0;  ///< of the planet, whose nodes are as close as the posts; of a planet only
};

/// Opens the region that the word for it (options.planet) names: a height map of a place, of any kind and
/// projection GDAL reads, about as far as it goes; or a square cut from a planet, around --center or
/// `around`; or one of fractal ground, whose posts are as far apart as its iterations make them.
///
/// A map's posts are as far apart as its samples unless --spacing says otherwise, of both at most kMostPosts
/// a side. Of a planet a region is 40 km wide, 1025 posts a side. Voids are filled from what is around them,
/// which a warning tells. Throws globe::Error or UsageError.
FlatRegion open_region(const ViewOptions& options, const LocalRegionOptions& region,
                       const std::optional<globe::geo::Geodetic>& around);
inline constexpr int kMostPosts = 4097;

/// The part of its planet that a scene's [region] names, of the planet's own ground, insets and all; nothing
/// without. Throws globe::Error.
std::optional<FlatRegion> region_of(const std::optional<globe::scene::Scene>& scene,
                                    const std::shared_ptr<const globe::planet::Surface>& surface, bool quiet);

/// What draws it in the globe; null without.
/// A GL context must be current and stay so.
std::unique_ptr<globe::render::RegionRenderer> region_in_globe(
    const std::optional<FlatRegion>& region, const std::optional<globe::scene::Scene>& scene,
    const globe::render::RenderSettings& settings);

}  // namespace app
