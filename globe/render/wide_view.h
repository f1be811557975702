#pragma once

#include <vector>

#include "globe/gl/framebuffer.h"
#include "globe/gl/program.h"
#include "globe/gl/vertex_array.h"
#include "globe/render/projection.h"
#include "globe/render/surface_renderer.h"

namespace globe::render {

/// Size and field of a picture that no pinhole camera takes.
struct WideFormat {
  Projection projection = Projection::kFisheye;  ///< not kPerspective
  int width = 0;
  int height = 0;
  double fov_deg = 180.0;  ///< along the height
  int samples = 1;         ///< of the faces
  int face_side =
      0;  ///< texels a side of a face; 0: as many as make its middle 1.25 times as fine as the picture
};

/// Draws fisheye pictures and panoramas: the faces of a cube around the eye that they look through, one after
/// the other, each taken up into the picture by the exact mapping of its pixels.
///
/// A pixel's middle decides its face. Faces are drawn beyond their edges, so that all that is averaged for a
/// pixel comes from one, and show the same ground at a border: levels and morphing are functions of the eye's
/// place. Depth is along the ray, near / distance, with the near plane of perspective pictures.
///
/// Memory: one face. Colours are interpolated between a face's texels, depth is that of the nearest: 0.4
/// pixels off at most, besides the rounding of vertices. Cost: the pixels of the faces seen, for a dome of
/// 180 degrees 4 times those of the picture; fewer texels in `face_side` make it cheaper and softer.
class WideView {
 public:
  /// A GL context must be current and stay so.
  explicit WideView(const WideFormat& format);

  /// As SurfaceRenderer::draw, into a picture of one sample. What lies outside the field is `outside` and has
  /// no depth.
  /// @param camera  its field of view and aspect are not looked at
  FrameStats draw(SurfaceRenderer& renderer, const Camera& camera, const glm::dvec3& sun, bool wait,
                  const gl::Framebuffer& target, double upload_ms = SurfaceRenderer::kUploadTime);

  /// As SurfaceRenderer::warm_up.
  void warm_up(SurfaceRenderer& renderer) const { renderer.warm_up(face_); }

  void set_outside(const glm::vec3& color) { outside_ = color; }
  /// Faces that the picture looks through, and texels a side of one.
  std::size_t faces() const { return seen_.size(); }
  int face_side() const { return face_.width(); }

 private:
  WideFormat format_;
  double half_width_ = 1.0;  ///< of a face at distance 1, margin included
  std::vector<int> seen_;    ///< as cube_face of shaders/lib/projection.glsl numbers them
  glm::vec3 outside_{0.0f};
  gl::Framebuffer face_;
  gl::Program program_;
  gl::VertexArray array_;
};

}  // namespace globe::render
