#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "globe/geo/ellipsoid.h"
#include "globe/render/projection.h"
#include "globe/render/wide_view.h"

namespace app {

/// --projection, --fov, --axis and --faces as they are written.
struct OpticsOptions {
  std::string projection = "perspective";
  std::optional<double> fov_deg;
  std::string axis = "zenith";
  int faces = 0;
};

void add_optics_options(CLI::App& command, OpticsOptions& options);

/// Which way a camera looks, degrees.
struct Look {
  double heading_deg = 0;
  double pitch_deg = 0;
  double roll_deg = 0;  ///< clockwise, seen from behind it
};

/// How a camera's surroundings become a picture.
struct Optics {
  globe::render::Projection projection = globe::render::Projection::kPerspective;
  double fov_deg = 60.0;
  bool level =
      false;  ///< the middle of a fisheye is the zenith, a panorama's horizon level, whatever pitch and roll
  int face_side = 0;  ///< WideFormat::face_side

  bool is_wide() const { return projection != globe::render::Projection::kPerspective; }
  /// "WxH" unless told otherwise.
  const char* usual_size() const;
  globe::render::Camera camera(const globe::geo::Ellipsoid& ellipsoid, const globe::geo::Geodetic& place,
                               Look look, double aspect) const;
};

/// Throws UsageError.
Optics optics_of(const OpticsOptions& options);

/// Draws a renderer's frames through some optics.
class Lens {
 public:
  /// A GL context must be current and stay so.
  /// @param samples  a pixel of a perspective picture has, or of the faces of another
  /// @param outside  colour beyond a fisheye's disc
  Lens(const Optics& optics, int width, int height, int samples, const std::optional<glm::vec3>& outside);

  /// Draws into target().
  globe::render::FrameStats draw(globe::render::SurfaceRenderer& renderer,
                                 const globe::render::Camera& camera, const glm::dvec3& sun, bool wait,
                                 double upload_ms = globe::render::SurfaceRenderer::kUploadTime);
  void warm_up(globe::render::SurfaceRenderer& renderer) const;
  const globe::gl::Framebuffer& target() const { return target_; }

 private:
  globe::gl::Framebuffer target_;
  std::optional<globe::render::WideView> wide_;
};

}  // namespace app
