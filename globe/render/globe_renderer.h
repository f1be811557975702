#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "globe/clipmap/patch.h"
#include "globe/clipmap/stream.h"
#include "globe/gl/buffer.h"
#include "globe/gl/framebuffer.h"
#include "globe/gl/program.h"
#include "globe/gl/vertex_array.h"
#include "globe/planet/surface.h"
#include "globe/render/camera.h"
#include "globe/render/clipmap_textures.h"
#include "globe/render/draw_list.h"
#include "globe/render/sky.h"

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
};

/// Figures of the frame last drawn.
struct FrameStats {
  std::size_t triangles = 0;
  std::size_t patches = 0;
  std::size_t upload_bytes = 0;
  double cpu_ms = 0;  ///< choosing levels and patches: our own work, loading and the driver's left out
  int queued_jobs = 0;
  int finest_level = 0;
  bool complete = true;
};

/// Draws a planet's surface: hexagonal clipmaps on HTM (DESIGN section 5) and a plain sky.
class GlobeRenderer {
 public:
  /// A GL context must be current and stay so.
  GlobeRenderer(std::shared_ptr<const planet::Surface> surface, const RenderSettings& settings);

  /// Draws one frame into the framebuffer.
  ///
  /// @param sun   unit vector toward the sun, ECEF
  /// @param wait  true: everything the view needs is loaded first, so the picture depends on the camera
  /// alone. False: what is
  ///              there is drawn at once; the rest comes over the next frames.
  FrameStats draw(const Camera& camera, const glm::dvec3& sun, bool wait, const gl::Framebuffer& target);

  /// Loads the base level and has every program compiled, so that the first frames of a flight take no longer
  /// than others.
  void warm_up(const gl::Framebuffer& target);

  /// True while levels are being computed in the background.
  bool is_loading() const { return stream_ != nullptr && stream_->pending() > 0; }

  /// Height of the camera above the ground that is drawn at the finest level under it, metres.
  ///
  /// @param wait  true: of the level it wants, which may have to be synthesised first; false: of what is at
  /// hand
  double height_above_ground(const glm::dvec3& position, bool wait = true) const;

  std::size_t gpu_bytes() const { return textures_.bytes(); }
  std::size_t gpu_layer_bytes() const { return textures_.layer_bytes(); }
  int gpu_layers() const { return textures_.layers(); }
  const clipmap::Settings& clipmap_settings() const { return settings_.clipmap; }

 private:
  /// Brings the state as far toward the target as is allowed; returns the bytes uploaded.
  std::size_t load(const clipmap::Target& target, bool wait);
  void draw_ground(const DrawList& list, FrameStats& stats);
  void draw_batches(const DrawList& list, const glm::vec4& overlay);

  std::shared_ptr<const planet::Surface> surface_;
  RenderSettings settings_;
  clipmap::PatchMesh mesh_;
  std::array<std::size_t, 8> index_offset_{};
  gl::Buffer vertices_, indices_, instances_, view_, slots_;
  gl::VertexArray ground_array_;
  std::array<gl::Program, kLooks.size()> ground_;  ///< by Look, in the order of kLooks
  std::optional<Sky> sky_;                         ///< none with a background
  ClipmapTextures textures_;
  std::shared_ptr<const clipmap::ClipmapState> state_;
  float shown_fade_ = 0.0f;  ///< of the finest level last frame, to let late arrivals morph in
  int shown_finest_ = 0;
  std::unique_ptr<clipmap::Stream> stream_;  ///< made by the first frame that does not wait
};

}  // namespace globe::render
