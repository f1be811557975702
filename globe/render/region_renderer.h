#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>

#include "globe/clipmap/morph.h"
#include "globe/clipmap/settings.h"
#include "globe/clipmap/stream.h"
#include "globe/render/camera.h"
#include "globe/render/effect.h"
#include "globe/render/effect_program.h"
#include "globe/render/region_below.h"
#include "globe/render/room.h"

namespace globe::render {

/// What a region is told of one view of one frame.
struct RegionView {
  const Camera& camera;
  const ViewBlock& block;  ///< bound to uniform block 0
  const clipmap::Settings& settings;
  std::shared_ptr<const clipmap::ClipmapState> around;  ///< the globe's own ground,
  clipmap::FinestLevel shown;                           ///< as it is drawn
  int picture_height;
  int active;       ///< effects, as EffectShaders has it
  Serving serving;  ///< which programs
};

/// What draws a part of a globe in place of the globe's own ground, so that at its rim there is neither a gap
/// nor a step. GlobeRenderer has it draw, and leaves room for it.
class RegionRenderer {
 public:
  RegionRenderer() = default;
  RegionRenderer(const RegionRenderer&) = delete;
  RegionRenderer& operator=(const RegionRenderer&) = delete;
  virtual ~RegionRenderer() = default;

  /// The same all the time.
  virtual const Room& room() const = 0;
  /// What it is of the ground under a camera at a place (ECEF).
  virtual RegionBelow below(const glm::dvec3& position) const = 0;

  /// Makes what it draws with, parts of effects included; once, before the first frame.
  /// @param coloring  the look of the ground, where an effect gives it one; null: none
  virtual void compile(const EffectHost& host, const planet::Coloring* coloring) = 0;
  /// @param sun   unit vector toward it, ECEF
  /// @param wait  false: light that has hardly changed may stay
  virtual void begin_frame(const glm::dvec3& sun, bool wait) = 0;
  /// Draws the region into the bound picture, which begin_ground (ground_state.h) has made ready. Whether in
  /// view or not: what is not is not drawn.
  virtual void draw(const RegionView& view) = 0;

  /// Of the view drawn last.
  virtual std::size_t triangles() const = 0;
  virtual std::size_t patches() const = 0;
  virtual std::size_t gpu_bytes() const = 0;
  /// Of the frame begun last.
  virtual std::size_t upload_bytes() const = 0;
};

}  // namespace globe::render
