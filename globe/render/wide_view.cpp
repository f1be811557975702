#include "globe/render/wide_view.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <numbers>

namespace globe::render {
namespace {

constexpr int kFaces = 6;
constexpr int kLeastSide = 16;
constexpr double kTexelsAPixel = 1.25;  ///< in the middle of a face, along either side
constexpr int kGrid = 512;  ///< rows and columns of a picture that are asked which face they look through

/// A face's right, up and forward in the camera's axes (right, up, forward).
struct Face {
  dvec3 right, up, forward;
};
constexpr std::array<Face, kFaces> face_axes() {
  return {{{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}},
           {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},
           {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
           {{1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
           {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
           {{-1, 0, 0}, {0, 1, 0}, {0, 0, -1}}}};
}

double pixel_radians(const WideFormat& format) {
  return format.fov_deg * std::numbers::pi / 180.0 / format.height;
}

/// Texels on either side of a face beyond its edge: a pixel there, at a corner three times as wide in texels
/// as in the middle, is averaged over 3/4 of itself, and each look-up takes half a texel more.
int margin(double texels_a_pixel) { return static_cast<int>(std::ceil(0.375 * 3.0 * texels_a_pixel)) + 2; }

/// Every face that any pixel of the picture may look through.
std::vector<int> faces_seen(const WideFormat& format) {
  Camera camera;
  camera.forward = dvec3(0, 0, 1);
  camera.right = dvec3(1, 0, 0);
  camera.up = dvec3(0, 1, 0);
  camera.fov_y_deg = format.fov_deg;
  camera.aspect = static_cast<double>(format.width) / format.height;
  const int columns = std::min(format.width, kGrid), rows = std::min(format.height, kGrid);
  // A face between two points that are asked comes as near to one of them as this.
  const double slack = 2.0 * pixel_radians(format) * std::max(format.width, format.height) / kGrid;
  std::array<bool, kFaces> seen{};
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      const auto direction = direction_through(
          format.projection, camera, static_cast<double>(column) / columns, static_cast<double>(row) / rows);
      if (!direction) continue;
      const double most = std::max({std::abs(direction->x), std::abs(direction->y), std::abs(direction->z)});
      for (std::size_t k = 0; k < seen.size(); ++k)
        seen[k] = seen[k] || glm::dot(*direction, face_axes()[k].forward) >= most - slack;
    }
  }
  std::vector<int> faces;
  for (int k = 0; k < kFaces; ++k) {
    if (seen[static_cast<std::size_t>(k)]) faces.push_back(k);
  }
  return faces;
}

gl::Program program_for(Projection projection) {
  gl::ProgramSources sources;
  sources.files = {"wide_view.vert", "wide_view.frag"};
  if (projection == Projection::kFisheye) sources.defines = {"FISHEYE"};
  return gl::Program(sources);
}

/// Texels of a face between its edges.
int inner_side(const WideFormat& format) {
  if (format.face_side > 0) return std::max(format.face_side, kLeastSide);
  return std::max(static_cast<int>(std::ceil(2.0 * kTexelsAPixel / pixel_radians(format))), kLeastSide);
}

}  // namespace

WideView::WideView(const WideFormat& format)
    : format_(format),
      seen_(faces_seen(format)),
      program_(program_for(format.projection)),
      array_(gl::VertexArray::create()) {
  const int inner = inner_side(format);
  const int side = inner + 2 * margin(0.5 * inner * pixel_radians(format));
  half_width_ = static_cast<double>(side) / inner;
  gl::FramebufferFormat face;
  face.samples = format.samples;
  face_ = gl::Framebuffer(side, side, face);
  face_.set_color_filter(GL_LINEAR);
}

FrameStats WideView::draw(SurfaceRenderer& renderer, const Camera& camera, const glm::dvec3& sun, bool wait,
                          const gl::Framebuffer& target, double upload_ms) {
  renderer.begin_frame(camera.position, sun, wait, upload_ms);
  target.clear_color(outside_.r, outside_.g, outside_.b, 1.0f);
  glDepthMask(GL_TRUE);
  target.clear_depth(0.0f);
  for (const int k : seen_) {
    const Face axes = face_axes()[static_cast<std::size_t>(k)];
    const auto world = [&](const dvec3& v) {
      return camera.right * v.x + camera.up * v.y + camera.forward * v.z;
    };
    Camera through = camera;
    through.right = world(axes.right);
    through.up = world(axes.up);
    through.forward = world(axes.forward);
    through.fov_y_deg = 360.0 / std::numbers::pi * std::atan(half_width_);
    through.aspect = 1.0;
    renderer.draw_view(through, face_);
    face_.resolve();

    target.bind();
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glDepthMask(GL_TRUE);
    array_.bind();
    face_.color().bind(0);
    face_.depth().bind(1);
    program_.use();
    const double half_fov = 0.5 * format_.fov_deg * std::numbers::pi / 180.0;
    const double pixel = 2.0 / format_.height;
    program_.set(0, glm::vec4(half_fov, static_cast<double>(format_.width) / format_.height, pixel, pixel));
    program_.set(1, glm::vec4(static_cast<float>(k), static_cast<float>(half_width_), 0.0f, 0.0f));
    program_.set(2, glm::transpose(glm::mat3(axes.right, axes.up, axes.forward)));
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }
  return renderer.frame_stats();
}

}  // namespace globe::render
