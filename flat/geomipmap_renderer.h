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
#include "flat/terrain.h"
#include "flat/visibility.h"
#include "globe/gl/buffer.h"
#include "globe/gl/program.h"
#include "globe/gl/texture.h"
#include "globe/gl/vertex_array.h"
#include "globe/render/air.h"
#include "globe/render/effect_shaders.h"
#include "globe/render/globe_renderer.h"
#include "globe/render/sky.h"
#include "globe/render/surface_renderer.h"

namespace globe::flat {

/// What is decided once for a renderer.
struct GeomipmapSettings {
  double error_px = 1.0;  ///< most that the mesh may be off on screen; @approximation flat.error
  Morph morph = Morph::kGpu;
  bool lod = true;      ///< false: level 0 everywhere
  bool culling = true;  ///< false: patches out of view are drawn too
  bool shadows = true;
  std::vector<Material> materials;  ///< a pass each; none: the colours alone
  double cloud_cover = 0;     ///< share of the sky whose clouds throw shadows, [0, 1]; 0: none, and no cost
  glm::dvec2 wind{8.0, 3.0};  ///< of the clouds, metres a second east and north
  std::shared_ptr<const Visibility> visibility;  ///< patches it hides are not drawn
  render::Show show = render::Show::kGround;
  bool wireframe = false;
  std::optional<glm::vec3> background;  ///< sRGB in [0, 1]; no sky then
  bool cull_faces = true;
  bool air = true;
  render::AirSteps air_steps{};
};

/// Draws a region by geomipmapping (de Boer 2000) with geomorphing in the vertex shader (Wagner 2003).
///
/// Patches have a vertex buffer as long as they are in view and a while longer. It stays as it is until the
/// patch's level, or which of its neighbours are coarser, changes.
class GeomipmapRenderer : public render::SurfaceRenderer {
 public:
  /// A GL context must be current and stay so.
  /// @param colors  of the posts (post_colors)
  GeomipmapRenderer(std::shared_ptr<const Terrain> terrain, std::vector<glm::vec3> colors,
                    const GeomipmapSettings& settings);

  void begin_frame(const glm::dvec3& position, const glm::dvec3& sun, bool wait, double upload_ms) override;
  void draw_view(const render::Camera& camera, const gl::Framebuffer& target) override;
  void set_instant(const render::Instant& instant) override { instant_ = instant; }
  const render::FrameStats& frame_stats() const override { return stats_; }
  void warm_up(const gl::Framebuffer& target) override;
  double height_above_ground(const glm::dvec3& position, bool wait = true) const override;
  double nearest_drawn(const glm::dvec3& position, bool wait = true) const override;

  const Terrain& terrain() const { return *terrain_; }
  /// Of the view drawn last.
  const std::vector<float>& levels() const { return levels_; }
  /// The patches drawn last.
  const std::vector<std::size_t>& drawn() const { return visible_; }
  /// This program's memory of a patch that is not in view, bytes.
  std::size_t inactive_patch_bytes() const;

 private:
  /// Buffers of a patch in view.
  struct Active {
    int shape = -1;
    std::vector<PatchVertex> vertices;  ///< kept where this program morphs
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
    gl::Program program;
    gl::Texture tile, mask;
    glm::vec4 u_row{0.0f}, v_row{0.0f};
    std::vector<bool> in_patch;
  };

  void make_passes();
  void set_uniforms(const gl::Program& program, const render::Camera& camera) const;
  void find_visible(const render::Camera& camera, const dvec3& eye);
  void make_ready(std::size_t patch, const PatchState& state);
  void upload_heights();
  void draw_passes(const glm::vec4& overlay);
  void draw_patches(const Pass& pass);
  void let_go();

  std::shared_ptr<const Terrain> terrain_;
  std::vector<glm::vec3> colors_;
  GeomipmapSettings settings_;
  std::array<std::size_t, kShapes> first_index_{}, index_count_{};
  std::array<std::size_t, kLevels> first_post_{};
  gl::Buffer posts_, indices_, instances_, heights_, view_;
  gl::VertexArray array_;
  std::vector<Pass> passes_;
  gl::Texture lightmap_, clouds_;
  render::EffectShaders no_effects_;
  std::optional<render::Sky> sky_;
  render::Instant instant_;
  std::optional<dvec3> lit_by_;  ///< sun of the lightmap, ECEF
  dvec3 sun_{0, 0, 1};
  double above_m_ = 1;
  std::size_t frame_ = 0;
  std::vector<float> levels_;
  std::vector<std::unique_ptr<Active>> active_;  ///< by patch
  std::vector<std::size_t> held_;                ///< patches that have one
  std::vector<std::size_t> visible_;
  std::vector<PatchState> states_;  ///< of the visible
  std::vector<std::size_t> height_offsets_;
  render::FrameStats stats_;
};

}  // namespace globe::flat
