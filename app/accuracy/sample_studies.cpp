#include <epoxy/gl.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/accuracy/drawing_quality.h"
#include "app/accuracy/remade.h"
#include "app/accuracy/repeated_frame.h"
#include "app/accuracy/samples.h"
#include "app/accuracy/study.h"
#include "globe/gl/program.h"
#include "globe/gl/vertex_array.h"

namespace app::accuracy {
namespace {

constexpr int kSampleSide = kEdgeSide;

/// Share of a pixel's area on the drawn side: the square cut along the line, by the shoelace formula.
double covered(const Edge& edge, const glm::dvec2& corner) {
  const std::array<glm::dvec2, 4> square{corner, corner + glm::dvec2(1, 0), corner + glm::dvec2(1, 1),
                                         corner + glm::dvec2(0, 1)};
  const auto beyond = [&](const glm::dvec2& p) { return glm::dot(p, edge.normal) - edge.offset; };
  std::vector<glm::dvec2> kept;
  for (std::size_t k = 0; k < square.size(); ++k) {
    const glm::dvec2 a = square[k], b = square[(k + 1) % square.size()];
    const double at_a = beyond(a), at_b = beyond(b);
    if (at_a <= 0.0) kept.push_back(a);
    if ((at_a < 0.0 && at_b > 0.0) || (at_a > 0.0 && at_b < 0.0))
      kept.push_back(a + (b - a) * (at_a / (at_a - at_b)));
  }
  double twice = 0.0;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    const glm::dvec2 a = kept[k], b = kept[(k + 1) % kept.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return 0.5 * twice;
}

/// Shares of pixels that the GPU gives edges at any angle, against their areas.
ErrorFigure edge_error(int samples) {
  globe::gl::FramebufferFormat format;
  format.samples = samples;
  const globe::gl::Framebuffer target(kSampleSide, kSampleSide, format);
  globe::gl::ProgramSources sources;
  sources.files = {"accuracy/half_plane.vert", "accuracy/plain.frag"};
  const globe::gl::Program program(sources);
  const globe::gl::VertexArray array = globe::gl::VertexArray::create();
  ErrorSum sum;
  for (const Edge& edge : sample_edges()) {
    target.bind();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    target.clear_color(0.0f, 0.0f, 0.0f, 1.0f);
    array.bind();
    program.use();
    program.set(0, glm::vec4(edge.normal, edge.offset, 0.5 * kSampleSide));
    glDrawArrays(GL_TRIANGLES, 0, 3);
    target.resolve();
    const std::vector<std::uint8_t> picture = target.read_rgba8();
    for (int y = 0; y < kSampleSide; ++y) {
      for (int x = 0; x < kSampleSide; ++x) {
        // The picture's first row is its top.
        const double share = covered(edge, {x - 0.5 * kSampleSide, 0.5 * kSampleSide - 1.0 - y});
        if (share <= 0.0 || share >= 1.0) continue;
        const double shown = picture[4 * static_cast<std::size_t>(y * kSampleSide + x)] / 255.0;
        sum.add(100.0 * (shown - share), [&] {
          char text[64];
          std::snprintf(text, sizeof text, "edge at %.1f degrees, pixel %d,%d",
                        std::atan2(edge.normal.y, edge.normal.x) * 180.0 / std::numbers::pi, x, y);
          return std::string(text);
        });
      }
    }
  }
  return sum.figure();
}

}  // namespace

std::vector<Study> sample_studies(const Scope& scope) {
  const std::shared_ptr<const globe::planet::Surface>& surface = scope.planet;
  const globe::render::Camera camera = judged_views(*surface, kPicture)[3].camera;
  const glm::dvec3 sun = sun_over(*surface, camera);
  Study study{"samples.edges",
              "Samples a pixel",
              "--samples",
              "the area of each pixel on either side of a straight edge",
              "pixels on " + std::to_string(sample_edges().size()) + " edges at any angle",
              "% of a pixel",
              "ms a frame of 1280x720 pixels, from 2 km",
              {}};
  int most = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  for (const int samples : {1, 4}) {
    if (samples > most) continue;
    globe::gl::FramebufferFormat format;
    format.samples = samples;
    const auto frame = remade<RepeatedFrame>(scope.context, surface, globe::render::RenderSettings{},
                                             kPicture.width, kPicture.height, format);
    study.settings.push_back({std::to_string(samples),
                              edge_error(samples),
                              [=] { return frame->get().draw_ms(camera, sun); },
                              samples == 1,
                              {},
                              release_of(frame)});
  }
  return {std::move(study)};
}

}  // namespace app::accuracy
