#pragma once

#include <memory>
#include <optional>

#include "flat/geomipmap_ground.h"
#include "flat/lightmap.h"
#include "flat/rim.h"
#include "flat/terrain.h"
#include "globe/render/region_renderer.h"

namespace globe::flat {

/// A region drawn by geomipmapping in a globe. At its rim it goes over into the globe's ground as that is
/// drawn in the view, whichever levels and morphs that has: the region's borders are lifted to it, and
/// between the two lies a collar whose outer edge runs along the very triangles it is drawn of.
class GlobeRegion : public render::RegionRenderer {
 public:
  /// A GL context must be current and stay so.
  /// @param knowledge  what colours are decided from (post_colors)
  /// @param settings   has_rim is set; no clouds of its own, a scene's effects throw their shadows here too
  GlobeRegion(std::shared_ptr<const Terrain> terrain, GroundKnowledge knowledge, GroundSettings settings);

  const render::Room& room() const override { return room_; }
  render::RegionBelow below(const glm::dvec3& position) const override;
  void compile(const render::EffectHost& host, const planet::Coloring* coloring) override;
  void begin_frame(const glm::dvec3& sun, bool wait) override;
  void draw(const render::RegionView& view) override;

  std::size_t triangles() const override { return ground_->triangles(); }
  std::size_t patches() const override { return ground_->visible().size(); }
  std::size_t gpu_bytes() const override { return ground_->gpu_bytes(); }
  std::size_t upload_bytes() const override { return ground_->upload_bytes(); }

  /// Of the view drawn last.
  const Rim& rim() const { return rim_; }

 private:
  void find_rim(const render::RegionView& view);

  std::shared_ptr<const Terrain> terrain_;
  GroundKnowledge knowledge_;
  GroundSettings settings_;
  render::Room room_;
  std::optional<GeomipmapGround> ground_;  ///< from compile() on
  Rim rim_;
  std::shared_ptr<const clipmap::ClipmapState> met_;  ///< the rim is of this
  clipmap::FinestLevel met_at_{-1, 0.0f};             ///< and these
};

}  // namespace globe::flat
