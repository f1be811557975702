#pragma once

#include "globe/clipmap/settings.h"
#include "globe/planet/surface.h"

namespace globe::render {

/// What a region in a globe is of the ground under a camera.
struct RegionBelow {
  /// How far that ground is the region's own: 0 where it does not lie under the camera, 1 where it does,
  /// beside its rim between the two, as the one ground goes over into the other.
  double share = 0;
  double above_m = 0;  ///< height above the region's own; counts where share > 0
};

/// Height of a camera above the ground that is drawn under it, metres: the globe's own
/// (clipmap::height_above_ground, which says what the parameters are), a region's, or a blend of the two.
double height_above_ground(const clipmap::Settings& settings, const planet::Surface& surface,
                           const glm::dvec3& position, int max_level, bool wait, const RegionBelow& region);

}  // namespace globe::render
