#pragma once

#include <cstddef>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "globe/gl/framebuffer.h"
#include "globe/planet/appearance.h"
#include "globe/planet/surface.h"
#include "globe/render/air.h"
#include "globe/render/camera.h"
#include "globe/render/clipmap_textures.h"
#include "globe/render/draw_list.h"
#include "globe/render/view_block.h"

namespace globe::render {

class EffectShaders;
class PatchDrawer;

/// A moment of a scene. What an effect looks like is a function of it: no state is carried from frame to
/// frame, so any frame rate and any pause lead to the same picture.
struct Instant {
  double time_s = 0;                  ///< since the scene began
  glm::dmat3 ecef_from_celestial{1};  ///< from the celestial frame (ICRS axes) to ECEF
};

/// Which program serves a view (EffectProgram).
enum class Serving {
  kItsSet,    ///< the one for its set of active effects, compiled if need be
  kCompiled,  ///< that one if it is there, otherwise one that serves any set
  kAny        ///< the one that serves any set
};

/// What effects share with the renderer that draws them.
struct EffectHost {
  const EffectShaders& shaders;
  const ClipmapTextures& textures;
  const PatchDrawer& patches;  ///< the ground's mesh; holds the patches in view
  const AirSteps& air;
};

/// What effects are told of one view of one frame.
struct EffectView {
  const EffectHost& host;
  const Camera& camera;
  const ViewBlock& block;  ///< bound to uniform block 0
  const planet::Surface& surface;
  const DrawList& patches;  ///< the ground in view
  const gl::Framebuffer& target;
  const Instant& instant;
  glm::dvec3 sun;         ///< unit vector toward it, ECEF
  double height_m;        ///< of the eye above the ellipsoid
  double above_ground_m;  ///< of the eye, at least what a camera counts as; under water at most its depth
  std::optional<double> water_m;  ///< height of the water over or under the eye, where an effect draws water
  int active = 0;                 ///< effects of the view, as EffectShaders has it; when passes are drawn
  Serving serving = Serving::kItsSet;
};

/// Whether an effect has anything to do in a view, and why: for people, a few words.
struct Verdict {
  bool active = false;
  std::string why;
};

/// What an effect adds to the programs of others, by a file that defines some of the functions below (NAME:
/// the effect's name) from a Place (shaders/lib/place.glsl). The file may ask for its uniform block and its
/// textures by the defines NAME_BLOCK and NAME_UNIT, in capitals.
struct EffectShader {
  std::string file;  ///< under shaders/; empty: nothing is added
  /// void NAME_dim(inout vec3 sunlight, inout vec3 skylight, Place place): light that falls on a surface.
  bool dims_light = false;
  /// vec3 NAME_add(vec3 light, Place place): light of a surface, before the air.
  bool adds_light = false;
  /// vec3 NAME_through(vec3 light, vec3 relative_m): light that comes to the eye from a place, after the air;
  /// of the sky `relative_m` is a unit direction times kSkyDistance (shaders/lib/place.glsl).
  bool is_medium = false;
  int textures = 0;  ///< units from NAME_UNIT on
  /// Files under shaders/ that others include, and what they get in their place.
  std::vector<std::pair<std::string, std::string>> replaced;
  std::vector<std::string> defines;  ///< for the files that replace others
};

/// Where an effect's uniform block and textures are bound.
struct Bindings {
  unsigned block = 0;
  unsigned unit = 0;
};

/// When a pass of an effect's own is drawn; later ones lie over earlier ones.
enum class Stage {
  kNone,     ///< it has none
  kHeavens,  ///< beyond the air, added to the sky
  kSurface,  ///< opaque or nearly so, writes depth
  kLayer,    ///< transparent layers over all surfaces
  kLens,     ///< in the camera, over everything; the picture so far can be looked up
};

/// One thing that a scene can call for besides the ground and the plain air (DESIGN section 6).
///
/// Named in no scene, it is never made. In a view that judge() finds it not active in, nothing of it runs: no
/// uniform is set, no texture made, no pass drawn. All of its state follows from the view's Instant. Making
/// one needs no OpenGL.
class Effect {
 public:
  Effect() = default;
  Effect(const Effect&) = delete;
  Effect& operator=(const Effect&) = delete;
  virtual ~Effect() = default;

  virtual EffectShader shader() const { return {}; }
  virtual Stage stage() const { return Stage::kNone; }

  /// Whether there is anything of it to see in a view. Cheap, a function of the view alone.
  virtual Verdict judge(const EffectView& view) const = 0;

  /// Whether it looks otherwise from second to second while nothing else changes.
  virtual bool moves() const { return false; }

  /// The look of the ground, where the effect gives it another; the same all the time.
  virtual std::shared_ptr<const planet::Coloring> coloring() const { return nullptr; }

  /// Height above the ellipsoid of the water that it draws over or under the eye, waves included; nothing
  /// where there is none. Of the view's members water_m is not known yet.
  virtual std::optional<double> water_height_m(const EffectView& /*view*/) const { return std::nullopt; }

  /// Makes what its own passes are drawn with; once, before the first frame.
  virtual void compile(const EffectHost& /*host*/) {}
  /// Has the programs compiled that frames in real time would wait for.
  virtual void warm_up() {}
  /// Before anything of a view is drawn in which it is active: makes what is missing, brings it to the
  /// instant and binds block and textures.
  virtual void prepare(const EffectView& /*view*/, const Bindings& /*bindings*/) {}
  /// Draws its pass into the bound target, light not yet toned, depth reversed. Depth is tested (GL_GEQUAL)
  /// and written, nothing is culled or blended; changed state other than blending, depth mask and depth
  /// function is put back.
  virtual void draw(const EffectView& /*view*/) {}

  /// Draw calls and full passes that draw() makes.
  virtual int passes() const { return stage() == Stage::kNone ? 0 : 1; }
  /// Held at present.
  virtual std::size_t gpu_bytes() const { return 0; }
};

}  // namespace globe::render
