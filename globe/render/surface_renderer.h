#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

#include "globe/gl/framebuffer.h"
#include "globe/render/camera.h"
#include "globe/render/effect.h"

namespace globe::render {

/// Figures of the frame last drawn.
struct FrameStats {
  std::size_t triangles = 0;
  std::size_t patches = 0;
  std::size_t upload_bytes = 0;
  double upload_ms = 0;  ///< spent on it by this thread
  double cpu_ms = 0;    ///< our own work: heights, levels, what to load, patches; uploads and the driver left
                        ///< out, and all of loading where a frame waits
  int queued_jobs = 0;  ///< levels being computed and uploads that wait
  std::size_t queued_bytes = 0;  ///< of the uploads
  std::size_t gpu_bytes = 0;     ///< of what holds the surface
  int finest_level = 0;
  float fade = 0;           ///< how far that level is still morphed into the one below
  double completeness = 1;  ///< share of the levels wanted that are in place and shown
  bool complete = true;     ///< all of them, and none that came late is still morphing in
};

/// What draws a surface, with the sky behind it, as a camera sees it: the globe's own (globe_renderer.h), or
/// that of a local region (flat/).
class SurfaceRenderer {
 public:
  SurfaceRenderer() = default;
  SurfaceRenderer(const SurfaceRenderer&) = delete;
  SurfaceRenderer& operator=(const SurfaceRenderer&) = delete;
  virtual ~SurfaceRenderer() = default;

  /// What a frame may take for uploads unless it is told otherwise, milliseconds.
  static constexpr double kUploadTime = 4.0;

  /// Draws one frame into the framebuffer.
  ///
  /// @param sun        unit vector toward the sun, ECEF
  /// @param wait       true: everything the view needs is loaded first, so the picture depends on the camera
  ///                   alone. False: what is there is drawn at once; the rest comes over the next frames.
  /// @param upload_ms  time that a frame which does not wait spends on uploads, about; some little piece goes
  ///                   in any case
  FrameStats draw(const Camera& camera, const glm::dvec3& sun, bool wait, const gl::Framebuffer& target,
                  double upload_ms = kUploadTime) {
    begin_frame(camera.position, sun, wait, upload_ms);
    draw_view(camera, target);
    return frame_stats();
  }

  /// The two halves of draw(), for frames that look several ways from one place: first what is shown is
  /// decided and loaded, then each view is drawn, into a framebuffer of its own or one after the other.
  virtual void begin_frame(const glm::dvec3& position, const glm::dvec3& sun, bool wait,
                           double upload_ms) = 0;
  /// REQUIRES: the camera stands where the frame was begun.
  virtual void draw_view(const Camera& camera, const gl::Framebuffer& target) = 0;
  /// The moment that effects show from the next frame on; the scene's beginning until then.
  virtual void set_instant(const Instant& instant) = 0;
  /// Of the frame begun last, its views so far.
  virtual const FrameStats& frame_stats() const = 0;

  /// Has all made that the first frames of a flight would wait for.
  virtual void warm_up(const gl::Framebuffer& target) = 0;

  /// Height of the camera above the ground that is drawn at the finest level under it, metres.
  ///
  /// @param wait  true: of the level it wants, which may have to be made first; false: of what is at hand
  virtual double height_above_ground(const glm::dvec3& position, bool wait = true) const = 0;
  /// How near the camera is to what is drawn under or over it, metres: what the near plane goes by
  /// (near_distance).
  virtual double nearest_drawn(const glm::dvec3& position, bool wait = true) const = 0;
};

}  // namespace globe::render
