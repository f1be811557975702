#pragma once

#include <optional>
#include <vector>

#include "globe/clipmap/drawn_surface.h"
#include "globe/clipmap/ground_below.h"
#include "tests/render/ground/views.h"

namespace views {

inline constexpr int kPictureWidth = 320;
inline constexpr int kPictureHeight = 180;
inline constexpr double kHeightError_m = 0.01;  ///< beside the pixel's footprint
inline constexpr double kSampled = 0.1;  ///< pixels: the GPU samples no farther from a pixel's middle (H1)

/// What a picture shows, by its depth.
class DepthPicture {
 public:
  DepthPicture(GlobeRenderer& renderer, const globe::gl::Framebuffer& frame, const Surface& surface,
               const Camera& camera)
      : camera_(camera), ellipsoid_(surface.ellipsoid()) {
    renderer.draw(camera, views::midnight(camera), true, frame);
    depth_ = frame.read_depth();
    near_m_ =
        globe::render::near_distance(ellipsoid_, std::max(renderer.height_above_ground(camera.position),
                                                          globe::clipmap::least_above_ground(ellipsoid_)));
  }

  /// What heights may differ by beside a pixel's footprint.
  double height_error_m() const { return kHeightError_m * globe::geo::small_body_scale(ellipsoid_); }

  const Camera& camera() const { return camera_; }

  /// Through the middle of a pixel.
  dvec3 direction(double x, double y) const {
    return globe::render::direction_through(camera_, (x + 0.5) / kPictureWidth, (y + 0.5) / kPictureHeight);
  }

  /// Height of the ground in a pixel; nothing where there is sky.
  std::optional<double> height(int x, int y) const {
    const auto depth = static_cast<double>(depth_[static_cast<std::size_t>(y * kPictureWidth + x)]);
    if (depth == 0.0) return std::nullopt;
    const dvec3 ray = direction(x, y);
    const dvec3 at = camera_.position + ray * (near_m_ / depth / glm::dot(ray, camera_.forward));
    return globe::geo::geodetic_from_ecef(ellipsoid_, at).h_m;
  }

  /// The same of a surface, a little off the pixel's middle; with the width of a pixel there.
  struct Picked {
    double height_m, footprint_m;
    globe::clipmap::DrawnPoint point;
  };
  std::optional<Picked> pick(const globe::clipmap::DrawnSurface& surface, double x, double y) const {
    const dvec3 ray = direction(x, y);
    const auto hit = surface.first_hit({camera_.position, ray}, near_m_ / glm::dot(ray, camera_.forward));
    if (!hit) return std::nullopt;
    return Picked{globe::geo::geodetic_from_ecef(ellipsoid_, hit->position).h_m,
                  hit->distance_m * 2.0 * camera_.tan_y() / kPictureHeight, *hit};
  }

  /// Whether a surface has the picture's ground in a pixel: within the pixel's footprint and a centimetre,
  /// for a ray as near to the pixel's middle as the GPU samples. On a ridge the first may pass over it.
  bool agrees(const globe::clipmap::DrawnSurface& surface, int x, int y) const {
    const auto shown = height(x, y);
    for (const double dy : {0.0, -kSampled, kSampled}) {
      for (const double dx : {0.0, -kSampled, kSampled}) {
        const auto picked = pick(surface, x + dx, y + dy);
        if (!picked && !shown) return true;
        if (picked && shown && std::abs(picked->height_m - *shown) <= picked->footprint_m + height_error_m())
          return true;
      }
    }
    return false;
  }

 private:
  Camera camera_;
  globe::geo::Ellipsoid ellipsoid_;
  std::vector<float> depth_;
  double near_m_ = 0;
};

}  // namespace views
