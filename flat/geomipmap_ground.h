#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "flat/levels.h"
#include "flat/lightmap.h"
#include "flat/materials.h"
#include "flat/patch_mesh.h"
#include "flat/rim.h"
#include "flat/terrain.h"
#include "flat/visibility.h"
#include "globe/gl/buffer.h"
#include "globe/gl/texture.h"
#include "globe/gl/vertex_array.h"
#include "globe/render/air.h"
#include "globe/render/effect.h"
#include "globe/render/effect_program.h"
#include "globe/render/effect_shaders.h"
#include "globe/render/globe_renderer.h"

namespace globe::flat {

/// How a region's ground is drawn; decided once.
struct GroundSettings {
  double error_px = 1.0;  ///< most that the mesh may be off on screen
  Morph morph = Morph::kGpu;
  bool lod = true;      ///< false: level 0 everywhere
  bool culling = true;  ///< false: patches out of view are drawn too
  bool shadows = true;
  std::vector<Material> materials;  ///< a pass each; none: the colours alone
  double cloud_cover = 0;     ///< share of the sky whose clouds throw shadows, [0, 1]; 0: none, and no cost.
                              ///< REQUIRES: 0 with has_rim
  glm::dvec2 wind{8.0, 3.0};  ///< of the clouds, metres a second east and north
  std::shared_ptr<const Visibility> visibility;  ///< patches it hides are not drawn
  render::Show show = render::Show::kGround;
  bool wireframe = false;
  render::AirSteps air_steps{};
  bool has_rim = false;  ///< it lies in other ground: every view has a rim
};

/// The eye of a view.
struct GroundView {
  const render::Camera& camera;
  const render::Instant& instant;
  int picture_height;
  int active = 0;  ///< effects, as EffectShaders has it
  render::Serving serving = render::Serving::kItsSet;
  const Rim* rim = nullptr;  ///< null without GroundSettings::has_rim
};

/// Draws a region's ground by geomipmapping (de Boer 2000) with geomorphing in the vertex shader (Wagner
/// 2003), into whatever is bound.
///
/// Patches have a vertex buffer as long as they are in view and a while longer. It stays as it is until the
/// patch's level, or which of its neighbours are coarser, changes.
class GeomipmapGround {
 public:
  /// A GL context must be current and stay so.
  /// @param colors   of the posts (post_colors)
  /// @param effects  with parts in its programs; must outlive this
  GeomipmapGround(std::shared_ptr<const Terrain> terrain, std::vector<glm::vec4> colors,
                  const GroundSettings& settings, const render::EffectShaders& effects);

  /// Lights the ground anew if need be.
  /// @param sun    unit vector toward it, ECEF
  /// @param exact  false: light that has hardly changed stays
  void begin_frame(const dvec3& sun, bool exact);
  /// Chooses levels and patches of a view and makes their buffers ready.
  void prepare(const GroundView& view);
  /// Draws them. REQUIRES: view block bound to uniform block 0, begin_ground called.
  void draw(const GroundView& view);

  const Terrain& terrain() const { return *terrain_; }
  /// Of the view prepared last.
  const std::vector<float>& levels() const { return levels_; }
  /// The patches of the view prepared last,
  const std::vector<std::size_t>& visible() const { return visible_; }
  const std::vector<PatchState>& states() const { return states_; }  ///< and how each is drawn
  std::size_t triangles() const { return triangles_; }               ///< drawn last, each once
  std::size_t upload_bytes() const { return upload_bytes_; }         ///< since begin_frame
  std::size_t gpu_bytes() const;
  /// This program's memory of a patch that is not in view, bytes.
  std::size_t inactive_patch_bytes() const;

 private:
  /// Buffers of a patch in view.
  struct Active {
    int shape = -1;
    std::vector<PatchVertex> vertices;  ///< kept where this program morphs, and at a border with a rim
    gl::Buffer buffer;
    std::size_t last_frame = 0;
  };
  /// Mirrors the instance's attributes of shaders/flat/geomipmap.vert.
  struct Instance {
    glm::ivec4 at{0};
    glm::vec4 sides{0.0f};
    float share = 0;
  };

  /// A pass over the ground: the first is opaque, later ones are blended over it.
  struct Pass {
    render::EffectProgram program, collar;
    gl::Texture tile, mask;
    glm::vec4 u_row{0.0f}, v_row{0.0f};
    std::vector<bool> in_patch;
    bool has_material = false;
  };

  void make_passes(const render::EffectShaders& effects);
  void set_uniforms(const gl::Program& program, const GroundView& view) const;
  void find_visible(const render::Camera& camera, const dvec3& eye, double lifted_m);
  void make_ready(std::size_t patch, const PatchState& state);
  void upload_heights();
  void draw_passes(const GroundView& view, const glm::vec4& overlay);
  void upload_rim(const Rim& rim, const glm::ivec2& eye_post);
  void use(const Pass& pass, const gl::Program& program, const glm::vec4& overlay) const;
  void draw_patches(const Pass& pass);
  void let_go();

  std::shared_ptr<const Terrain> terrain_;
  std::vector<glm::vec4> colors_;
  GroundSettings settings_;
  std::array<std::size_t, kShapes> first_index_{}, index_count_{};
  std::array<std::size_t, kLevels> first_post_{};
  gl::Buffer posts_, indices_, instances_, heights_, collar_vertices_;
  gl::VertexArray array_, collar_array_;
  std::size_t collar_count_ = 0;  ///< vertices
  std::vector<Pass> passes_;
  gl::Texture lightmap_, clouds_, lifts_;
  gl::Texture water_;            ///< where a sea lies open; none where nowhere
  std::optional<dvec3> lit_by_;  ///< sun of the lightmap, ECEF
  dvec3 sun_{0, 0, 1};
  std::size_t frame_ = 0;
  std::vector<float> levels_;
  std::vector<std::unique_ptr<Active>> active_;  ///< by patch
  std::vector<std::size_t> held_;                ///< patches that have one
  std::vector<std::size_t> visible_;
  std::vector<PatchState> states_;  ///< of the visible
  std::vector<std::size_t> height_offsets_;
  std::size_t triangles_ = 0, upload_bytes_ = 0;
};

}  // namespace globe::flat
