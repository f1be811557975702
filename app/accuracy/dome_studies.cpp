#include <epoxy/gl.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <utility>

#include "app/accuracy/drawing_quality.h"
#include "app/accuracy/remade.h"
#include "app/accuracy/repeated_frame.h"
#include "app/accuracy/study.h"
#include "globe/render/wide_view.h"

namespace app::accuracy {
namespace {

namespace render = globe::render;

constexpr int kDomeSide = 512;  ///< of the dome's picture, pixels
constexpr int kFiner = 4;       ///< pixels of the reference in one of the picture, across and down

using DrawnGround = std::shared_ptr<Remade<render::GlobeRenderer>>;  ///< what all domes show

/// A dome drawn from one place again and again.
class Dome {
 public:
  Dome(std::shared_ptr<globe::gl::Context> context, DrawnGround ground, int side, int face_side,
       render::Camera camera, const glm::dvec3& sun)
      : context_(std::move(context)),
        ground_(std::move(ground)),
        view_({render::Projection::kFisheye, side, side, 180.0, 1, face_side}),
        target_(side, side),
        camera_(std::move(camera)),
        sun_(sun) {
    draw_ms();
  }

  double draw_ms() {
    glFinish();
    const auto begin = std::chrono::steady_clock::now();
    view_.draw(ground_->get(), camera_, sun_, true, target_);
    glFinish();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  }
  std::vector<std::uint8_t> picture() const { return target_.read_rgba8(); }
  int face_side() const { return view_.face_side(); }

 private:
  std::shared_ptr<globe::gl::Context> context_;  ///< outlives what is made in it
  DrawnGround ground_;
  render::WideView view_;
  globe::gl::Framebuffer target_;
  render::Camera camera_;
  glm::dvec3 sun_;
};

/// Each pixel the mean of those of a picture kFiner times as large.
std::vector<double> means(const std::vector<std::uint8_t>& fine) {
  std::vector<double> result(std::size_t{kDomeSide} * kDomeSide * 4);
  constexpr int kLarge = kDomeSide * kFiner;
  for (int y = 0; y < kLarge; ++y)
    for (int x = 0; x < kLarge; ++x)
      for (int c = 0; c < 4; ++c)
        result[static_cast<std::size_t>((y / kFiner * kDomeSide + x / kFiner) * 4 + c)] +=
            fine[static_cast<std::size_t>((y * kLarge + x) * 4 + c)] / double(kFiner * kFiner);
  return result;
}

}  // namespace

std::vector<Study> dome_studies(const Scope& scope) {
  const render::Camera camera = judged_views(*scope.planet, {})[3].camera;
  const glm::dvec3 sun = sun_over(*scope.planet, camera);
  const DrawnGround ground = remade<render::GlobeRenderer>(scope.planet, render::RenderSettings{});
  const std::vector<double> truth =
      means(Dome(scope.context, ground, kDomeSide * kFiner, 0, camera, sun).picture());
  Study study{"domes.faces",
              "Texels of the cube that a dome's picture is made of",
              "--faces",
              "the mean of 16 pixels of a picture four times as large",
              "the pixels of a fisheye of 180 degrees, 512x512, from 2 km toward the mountains",
              "steps of 255",
              "ms a frame",
              {}};
  const int usual = Dome(scope.context, ground, kDomeSide, 0, camera, sun).face_side();
  for (const int side : {usual / 2, usual * 3 / 4, usual, usual * 2}) {
    const auto dome = remade<Dome>(scope.context, ground, kDomeSide, side, camera, sun);
    const std::vector<std::uint8_t> drawn = dome->get().picture();
    dome->release();
    ErrorSum sum;
    for (std::size_t k = 0; k < drawn.size(); ++k) {
      if (k % 4 == 3) continue;  // opaque
      sum.add(drawn[k] - truth[k], [&] {
        const auto pixel = static_cast<int>(k / 4);
        return "pixel " + std::to_string(pixel % kDomeSide) + "," + std::to_string(pixel / kDomeSide);
      });
    }
    study.settings.push_back({std::to_string(side) + " a side",
                              sum.figure(),
                              [=] { return dome->get().draw_ms(); },
                              side == usual,
                              {},
                              [=] {
                                dome->release();
                                ground->release();
                              }});
  }
  ground->release();
  return {std::move(study)};
}

}  // namespace app::accuracy
