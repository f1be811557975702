#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "globe/clipmap/morph.h"
#include "globe/clipmap/morphed_patch.h"
#include "globe/clipmap/patch.h"
#include "globe/clipmap/ray.h"
#include "globe/clipmap/stream.h"
#include "globe/planet/surface.h"

namespace globe::clipmap {

/// A point of the drawn surface.
struct DrawnPoint {
  dvec3 position{0.0};    ///< ECEF metres
  double distance_m = 0;  ///< from the ray's origin
  int level = 0;          ///< of the ring it lies in
  double alpha = 0;       ///< morph factor there: 0 the level's own ground, 1 the coarser level's
};

/// The surface that is drawn of a clipmap, in double precision: the triangles of its rings, morphed and
/// joined at their rims as shaders/clipmap.vert does it (HARD-CASES H23).
///
/// It differs from what the GPU draws by the rounding of its positions to fp32, a tenth of a pixel at most
/// (HARD-CASES H1). Vertices are evaluated when a ray first comes near them, and kept. Safe to use from many
/// threads.
class DrawnSurface {
 public:
  /// @param finest  levels of the state above it are left out
  /// @param fade    morph factor the finest level has at least
  DrawnSurface(const Settings& settings, std::shared_ptr<const planet::Surface> surface,
               const std::shared_ptr<const ClipmapState>& state, int finest, float fade);

  /// The first point of the surface on a ray, seen from outside, as faces are culled in the picture. Through
  /// no seam between triangles, patches, levels or diamonds does a ray slip.
  ///
  /// @param nearest_m  what lies nearer is looked through
  std::optional<DrawnPoint> first_hit(const Ray& ray, double nearest_m = 0.0) const;

 private:
  /// A patch of a ring, and all that can be drawn of it within a sphere.
  struct DrawnPatch {
    DrawnPatch(const Patch& of, int at_level, const dvec3& at, double reach)
        : patch(of), level(at_level), centre(at), radius(reach) {}

    Patch patch;
    int level;
    dvec3 centre;
    double radius;
    mutable std::once_flag evaluated;
    mutable std::vector<MorphedVertex> vertices;  ///< in the order of PatchMesh::vertices
  };

  void add_ring(const ClipmapState& state, int level);
  const std::vector<MorphedVertex>& vertices(const DrawnPatch& patch) const;
  std::vector<MorphedVertex> evaluate(const DrawnPatch& patch) const;
  std::optional<DrawnPoint> hit_in(const DrawnPatch& patch, const Ray& ray, double nearest_m) const;

  Settings settings_;
  std::shared_ptr<const planet::Surface> surface_;
  PatchMesh mesh_;
  dvec3 nadir_;  ///< the camera's normal
  int finest_;
  float fade_;
  std::deque<DrawnPatch> patches_;
};

/// A clipmap that is complete for a camera.
struct CompleteState {
  Settings settings;  ///< no light, no colours
  std::shared_ptr<const ClipmapState> state;
  FinestLevel shown;
};
/// @param position  of the camera, ECEF
/// @param away_m    how near it is to ground that is drawn (nearest_drawn)
CompleteState complete_state(const Settings& settings, const planet::Surface& surface, const dvec3& position,
                             double away_m, int max_level);

/// The surface that a complete picture shows from a camera at `position`: what GlobeRenderer::draw draws when
/// it waits. Colours and light are left out.
DrawnSurface complete_surface(const Settings& settings, std::shared_ptr<const planet::Surface> surface,
                              const dvec3& position, int max_level);

}  // namespace globe::clipmap
