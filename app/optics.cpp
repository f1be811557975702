#include "app/optics.h"

#include "app/records.h"
#include "globe/base/error.h"

namespace app {

namespace render = globe::render;
using globe::UsageError;
using render::Projection;

void add_optics_options(CLI::App& command, OpticsOptions& options) {
  command
      .add_option("--projection", options.projection,
                  "perspective, fisheye (equidistant, for domes) or equirectangular (panoramas)")
      ->capture_default_str()
      ->check(CLI::IsMember({"perspective", "fisheye", "equirectangular"}));
  command.add_option("--fov", options.fov_deg,
                     "vertical field of view, degrees (default: 60; of fisheyes and panoramas 180)");
  command
      .add_option(
          "--axis", options.axis,
          "of fisheyes and panoramas: zenith (the zenith in the middle of the dome and the heading at "
          "its lower rim, the horizon of a panorama level), or look (the middle is where --look looks)")
      ->capture_default_str()
      ->check(CLI::IsMember({"zenith", "look"}));
  command
      .add_option(
          "--faces", options.faces,
          "of fisheyes and panoramas: pixels a side of the cube's faces that they are made of (default: "
          "a little finer than the picture)")
      ->check(CLI::Range(16, 16384));
}

Optics optics_of(const OpticsOptions& options) {
  Optics optics;
  const auto projection = render::projection_by_name(options.projection);
  if (!projection)
    throw UsageError("--projection " + options.projection, "no such projection",
                     "give perspective, fisheye or equirectangular");
  optics.projection = *projection;
  optics.fov_deg = options.fov_deg.value_or(render::usual_fov_deg(*projection));
  const double widest = render::widest_fov_deg(*projection);
  if (!(optics.fov_deg >= 0.01 && optics.fov_deg <= widest)) {
    throw UsageError("--fov " + number_text(optics.fov_deg, std::nullopt),
                     "not 0.01 to " + number_text(widest, std::nullopt) + " degrees, what " +
                         options.projection + " can show",
                     *projection == Projection::kPerspective
                         ? "give less, or --projection fisheye or equirectangular"
                         : "give less");
  }
  optics.level = optics.is_wide() && options.axis == "zenith";
  optics.face_side = options.faces;
  return optics;
}

const char* Optics::usual_size() const {
  return projection == Projection::kPerspective ? "1280x720"
         : projection == Projection::kFisheye   ? "1024x1024"
                                                : "2048x1024";
}

render::Camera Optics::camera(const globe::geo::Ellipsoid& ellipsoid, const globe::geo::Geodetic& place,
                              Look look, double aspect) const {
  if (level) look = {look.heading_deg, projection == Projection::kFisheye ? 90.0 : 0.0};
  return render::rolled(
      render::make_camera(ellipsoid, place, look.heading_deg, look.pitch_deg, fov_deg, aspect),
      look.roll_deg);
}

Lens::Lens(const Optics& optics, int width, int height, int samples,
           const std::optional<glm::vec3>& outside) {
  globe::gl::FramebufferFormat format;
  if (optics.is_wide()) {
    wide_.emplace(
        render::WideFormat{optics.projection, width, height, optics.fov_deg, samples, optics.face_side});
    wide_->set_outside(outside.value_or(glm::vec3(0.0f)));
  } else {
    format.samples = samples;
  }
  target_ = globe::gl::Framebuffer(width, height, format);
}

render::FrameStats Lens::draw(render::SurfaceRenderer& renderer, const render::Camera& camera,
                              const glm::dvec3& sun, bool wait, double upload_ms) {
  return wide_ ? wide_->draw(renderer, camera, sun, wait, target_, upload_ms)
               : renderer.draw(camera, sun, wait, target_, upload_ms);
}

void Lens::warm_up(render::SurfaceRenderer& renderer) const {
  if (wide_) {
    wide_->warm_up(renderer);
  } else {
    renderer.warm_up(target_);
  }
}

}  // namespace app
