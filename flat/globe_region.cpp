#include "flat/globe_region.h"

#include <cassert>
#include <utility>

#include "globe/clipmap/cut.h"

namespace globe::flat {
namespace {

const render::Instant kNoMoment;  ///< nothing of a region in a globe moves by itself

}  // namespace

GlobeRegion::GlobeRegion(std::shared_ptr<const Terrain> terrain, GroundKnowledge knowledge,
                         GroundSettings settings)
    : terrain_(std::move(terrain)),
      knowledge_(std::move(knowledge)),
      settings_(std::move(settings)),
      room_(room_of(*terrain_)) {
  assert(settings_.cloud_cover == 0.0);
  settings_.has_rim = true;
}

render::RegionBelow GlobeRegion::below(const glm::dvec3& position) const {
  return region_below(*terrain_, position);
}

void GlobeRegion::compile(const render::EffectHost& host, const planet::Coloring* coloring) {
  ground_.emplace(terrain_, post_colors(*terrain_, knowledge_, coloring), settings_, host.shaders);
}

void GlobeRegion::begin_frame(const glm::dvec3& sun, bool wait) { ground_->begin_frame(sun, wait); }

void GlobeRegion::find_rim(const render::RegionView& view) {
  if (met_ == view.around && met_at_.level == view.shown.level && met_at_.fade == view.shown.fade) return;
  met_ = view.around;
  met_at_ = view.shown;
  rim_ = make_rim(*terrain_, [&](const clipmap::CuttingPlane& plane) {
    return clipmap::cut(view.settings, *view.around, view.shown, plane);
  });
}

void GlobeRegion::draw(const render::RegionView& view) {
  find_rim(view);
  const GroundView seen{view.camera, kNoMoment, view.picture_height, view.active, view.serving, &rim_};
  ground_->prepare(seen);
  ground_->draw(seen);
}

}  // namespace globe::flat
