#include <cstdint>

#include "app/accuracy/drawing_quality.h"
#include "app/accuracy/remade.h"
#include "app/accuracy/repeated_frame.h"
#include "app/accuracy/study.h"

namespace app::accuracy {
namespace {

using globe::clipmap::Windows;

}  // namespace

std::vector<Study> window_studies(const Scope& scope) {
  const std::shared_ptr<const globe::planet::Surface>& surface = scope.planet;
  const std::vector<JudgedView> views = judged_views(*surface, kPicture);
  Study memory{"windows.memory",
               "How windows lie in textures, against memory",
               "--window",
               "the bytes of the picture with plain windows",
               "every pixel of 1280x720, from orbit, of the limb, from 100 km, 2 km and eye height",
               "steps of 255",
               "MB of textures, from 2 km",
               {}};
  Study frames = memory;
  frames.name = "windows.frame";
  frames.title = "How windows lie in textures, against time";
  frames.cost_unit = "ms a frame, from 2 km";
  std::vector<std::vector<std::uint8_t>> plain;
  for (const auto& [name, kind] :
       {std::pair{"plain", Windows::kPlain}, std::pair{"hexagon", Windows::kHexagon}}) {
    globe::render::RenderSettings ground;
    ground.clipmap.windows = kind;
    const auto frame = remade<RepeatedFrame>(scope.context, surface, ground, kPicture.width, kPicture.height);
    const auto camera = views[3].camera;
    const glm::dvec3 sun = sun_over(*surface, camera);
    frame->get().draw_ms(camera, sun);
    const auto bytes = static_cast<double>(frame->get().stats().gpu_bytes);
    ErrorSum sum;
    for (std::size_t v = 0; v < views.size(); ++v) {
      frame->get().draw_ms(views[v].camera, sun_over(*surface, views[v].camera));
      const std::vector<std::uint8_t> picture = frame->get().target().read_rgba8();
      if (kind == Windows::kPlain) plain.push_back(picture);
      for (std::size_t k = 0; k < picture.size(); ++k)
        sum.add(picture[k] - plain[v][k], [&] { return views[v].name + ", byte " + std::to_string(k); });
    }
    frame->release();
    const bool is_default = kind == Windows::kPlain;
    memory.settings.push_back({name, sum.figure(), fixed(bytes * 1e-6), is_default});
    frames.settings.push_back({name,
                               sum.figure(),
                               [=] { return frame->get().draw_ms(camera, sun); },
                               is_default,
                               {},
                               release_of(frame)});
  }
  return {std::move(memory), std::move(frames)};
}

}  // namespace app::accuracy
