#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "globe/clipmap/morph.h"
#include "globe/gl/buffer.h"
#include "globe/gl/framebuffer.h"
#include "globe/gl/program.h"
#include "globe/planet/surface.h"
#include "globe/render/admission.h"
#include "globe/render/air.h"
#include "globe/render/camera.h"
#include "globe/render/draw_list.h"
#include "globe/render/effect.h"
#include "globe/render/effect_program.h"
#include "globe/render/effect_shaders.h"
#include "globe/render/light_picture.h"
#include "globe/render/loader.h"
#include "globe/render/patch_drawer.h"
#include "globe/render/region_renderer.h"
#include "globe/render/sky.h"
#include "globe/render/surface_renderer.h"

namespace globe::render {

/// What a picture shows besides the ground as it is.
enum class Show { kGround, kLevels, kPatches, kNormals };

/// What is decided once for a renderer.
struct RenderSettings {
  clipmap::Settings clipmap;
  Show show = Show::kGround;
  bool wireframe = false;
  std::optional<glm::vec3> background;  ///< sRGB in [0, 1]; no sky then
  bool cull_faces = true;
  bool cull_patches = true;
  int max_level = 26;  ///< finest grid level of triangles
  AirSteps air{};
  bool load_ahead = true;  ///< frames that do not wait load what the camera's motion leads to
};

/// What became of an effect in the frame last drawn.
struct EffectState {
  std::string name;
  Verdict verdict;  ///< of the views, the first one in which it was active
  std::size_t gpu_bytes = 0;
  int passes = 0;           ///< of its own in a view in which it is active
  bool in_shaders = false;  ///< the ground's and the sky's programs have a part of it
};

/// Draws a planet's surface: hexagonal clipmaps on HTM (DESIGN section 5), a plain sky, and the effects that
/// it is given.
class GlobeRenderer : public SurfaceRenderer {
 public:
  /// A GL context must be current and stay so.
  /// @param region  what draws a part of the planet in place of this renderer's own ground, if any
  GlobeRenderer(std::shared_ptr<const planet::Surface> surface, const RenderSettings& settings,
                std::vector<NamedEffect> effects = {}, std::unique_ptr<RegionRenderer> region = nullptr);

  void begin_frame(const glm::dvec3& position, const glm::dvec3& sun, bool wait, double upload_ms) override;
  void draw_view(const Camera& camera, const gl::Framebuffer& target) override;
  void set_instant(const Instant& instant) override { instant_ = instant; }
  /// Of the frame begun last, its views so far; in the order of the effects.
  std::vector<EffectState> effect_states() const;
  /// Whether an effect has the picture change while nothing else does; in the frame drawn last.
  bool moves() const;
  /// Whether an effect gives the ground a look of its own (Effect::coloring).
  bool colors_ground(const std::string& name) const;
  /// Switches one of the effects that it was given off, or on again: off it is as one that has nothing to do.
  /// REQUIRES: !colors_ground(name)
  void switch_effect(const std::string& name, bool on);
  /// Shows something else from the next frame on.
  void show_as(Show show, bool wireframe, bool cull_patches);
  /// Of the picture of light that effects with passes are drawn over; 0 without such.
  std::size_t light_bytes() const { return light_ ? light_->gpu_bytes() : 0; }

  const FrameStats& frame_stats() const override { return stats_; }

  /// Loads the base level and has programs compiled, those of the ground for any set of active effects, so
  /// that the first frames of a flight take no longer than others.
  void warm_up(const gl::Framebuffer& target) override;

  /// True while levels are being computed in the background.
  bool is_computing() const { return loader_.is_computing(); }
  /// Returns when none are: for tests and benchmarks, which want no race.
  void await_computing() const { loader_.await_computing(); }

  double height_above_ground(const glm::dvec3& position, bool wait = true) const override;
  /// clipmap::nearest_drawn.
  double nearest_drawn(const glm::dvec3& position, bool wait = true) const override;

  /// The clipmap's textures on the GPU.
  const ClipmapTextures& textures() const { return loader_.textures(); }
  /// What the last frame showed.
  const clipmap::ClipmapState& state() const { return *loader_.state(); }
  /// What draws a part of the planet; null: nothing else does.
  const RegionRenderer* region() const { return region_.get(); }
  const clipmap::Settings& clipmap_settings() const { return settings_.clipmap; }

 private:
  void draw_ground(const DrawList& list);
  void draw_batches(const DrawList& list, const glm::vec4& overlay);
  void draw_region(const Camera& camera, const ViewBlock& view, int picture_height);
  const gl::Program& program_for(const Batch& batch);
  void make_ground_programs();
  EffectHost effect_host() const;
  /// Which effects are active in a view, prepared for it: one bit each.
  int prepare_effects(const EffectView& view);
  void draw_passes(const EffectView& view, Stage stage);

  std::shared_ptr<const planet::Surface> surface_;
  RenderSettings settings_;
  std::vector<NamedEffect> effects_;
  std::vector<bool> switched_off_;  ///< of effects_
  EffectShaders effect_shaders_;
  std::vector<Verdict> verdicts_;                     ///< of effects_, in the frame begun last
  int active_ = 0;                                    ///< effects of the view being drawn
  Serving serving_ = Serving::kItsSet;                ///< of a frame in real time not: it would stall
  std::shared_ptr<const planet::Coloring> coloring_;  ///< the last one of effects_; null: none
  Instant instant_;
  PatchDrawer patches_;
  gl::Buffer view_;
  std::unique_ptr<RegionRenderer> region_;           ///< null: none
  std::optional<LightPicture> light_;                ///< where effects have passes
  std::array<EffectProgram, kLooks.size()> ground_;  ///< by Look, in the order of kLooks
  std::array<EffectProgram, kLooks.size()> around_;  ///< likewise, of patches across the sides of a room
  glm::vec4 eye_in_room_{0.0f};                      ///< of the view being drawn, shaders/clipmap.vert
  std::optional<Sky> sky_;                           ///< none with a background
  Loader loader_;
  Admission admission_;
  glm::dvec3 sun_{1, 0, 0};  ///< of this frame, as the next three
  double above_m_ = 0;       ///< height above ground, at least what a camera counts as
  clipmap::FinestLevel shown_{0, 0};
  FrameStats stats_;
};

}  // namespace globe::render
