#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "flat/geomipmap_ground.h"
#include "flat/terrain.h"
#include "globe/gl/buffer.h"
#include "globe/render/effect_shaders.h"
#include "globe/render/sky.h"
#include "globe/render/surface_renderer.h"

namespace globe::flat {

/// What is decided once for a renderer.
struct GeomipmapSettings : GroundSettings {
  std::optional<glm::vec3> background;  ///< sRGB in [0, 1]; no sky then
  bool cull_faces = true;
  bool air = true;
};

/// Draws a region alone, with nothing around it but the sky.
class GeomipmapRenderer : public render::SurfaceRenderer {
 public:
  /// A GL context must be current and stay so.
  /// @param colors  of the posts (post_colors)
  GeomipmapRenderer(std::shared_ptr<const Terrain> terrain, std::vector<glm::vec4> colors,
                    const GeomipmapSettings& settings);

  void begin_frame(const glm::dvec3& position, const glm::dvec3& sun, bool wait, double upload_ms) override;
  void draw_view(const render::Camera& camera, const gl::Framebuffer& target) override;
  void set_instant(const render::Instant& instant) override { instant_ = instant; }
  const render::FrameStats& frame_stats() const override { return stats_; }
  void warm_up(const gl::Framebuffer& target) override;
  double height_above_ground(const glm::dvec3& position, bool wait = true) const override;
  double nearest_drawn(const glm::dvec3& position, bool wait = true) const override;

  const Terrain& terrain() const { return ground_.terrain(); }
  /// Of the view drawn last.
  const std::vector<float>& levels() const { return ground_.levels(); }
  /// The patches drawn last.
  const std::vector<std::size_t>& drawn() const { return ground_.visible(); }
  std::size_t inactive_patch_bytes() const { return ground_.inactive_patch_bytes(); }

 private:
  render::EffectShaders no_effects_;
  GeomipmapGround ground_;
  std::optional<glm::vec3> background_;
  bool cull_faces_, air_;
  gl::Buffer view_;
  std::optional<render::Sky> sky_;
  render::Instant instant_;
  dvec3 sun_{0, 0, 1};
  double above_m_ = 1;
  render::FrameStats stats_;
};

}  // namespace globe::flat
