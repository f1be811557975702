#include "app/accuracy/drawing_quality.h"
#include "app/accuracy/freed_memory.h"
#include "app/accuracy/repeated_frame.h"
#include "app/accuracy/study.h"

namespace app::accuracy {
namespace {

using globe::clipmap::Settings;

constexpr int kDefaultDetail = 64;  ///< app/view_options.h

Study study_of(const std::string& name, const std::string& title, const std::string& cost_unit, int rows) {
  return {"detail." + name,
          title,
          "--detail",
          "the ground at its finest, level 26 or an eighth of a pixel, by its own function in double",
          "rays on " + std::to_string(rows) +
              " rows of 1280x720 pixels from orbit, of the limb, from 100 km, " +
              "2 km and eye height, at the built-in planet's mountains",
          "px",
          cost_unit,
          {}};
}

}  // namespace

std::vector<Study> detail_studies(const Scope& scope) {
  const std::shared_ptr<const globe::planet::Surface>& surface = scope.planet;
  const int rows = scope.full ? kRowsFull : kRowsQuick;
  std::vector<int> details{16, 32, 64, 128};
  if (scope.full) details.push_back(256);
  std::vector<Settings> settings;
  for (const int detail : details) settings.push_back(Settings::for_detail(detail));
  const std::vector<ErrorFigure> errors = drawn_errors(settings, surface, kPicture, rows);
  return_freed_memory();

  // From 2 km most levels are in view, and ground fills most of the picture.
  const globe::render::Camera camera = judged_views(*surface, kPicture)[3].camera;
  const glm::dvec3 sun = sun_over(*surface, camera);
  Study frames = study_of("frame", "Size of the triangles, against time", "ms a frame, from 2 km", rows);
  Study triangles = study_of("triangles", "Size of the triangles, against their number",
                             "thousand triangles, from 2 km", rows);
  Study textures =
      study_of("textures", "Size of the triangles, against memory", "MB of textures, from 2 km", rows);
  // They are not released between passes: the finest takes seconds to make. That one first, for what it takes
  // while it is made is as much again as it holds.
  std::vector<std::shared_ptr<RepeatedFrame>> made(details.size());
  for (std::size_t k = details.size(); k-- > 0;) {
    globe::render::RenderSettings ground;
    ground.clipmap = settings[k];
    made[k] =
        std::make_shared<RepeatedFrame>(scope.context, surface, ground, kPicture.width, kPicture.height);
    made[k]->draw_ms(camera, sun);
    return_freed_memory();
  }
  for (std::size_t k = 0; k < details.size(); ++k) {
    const std::shared_ptr<RepeatedFrame>& frame = made[k];
    const std::string name = "s = " + std::to_string(details[k]);
    const bool is_default = details[k] == kDefaultDetail;
    frames.settings.push_back({name, errors[k], [=] { return frame->draw_ms(camera, sun); }, is_default});
    triangles.settings.push_back(
        {name, errors[k], fixed(static_cast<double>(frame->stats().triangles) * 1e-3), is_default});
    textures.settings.push_back(
        {name, errors[k], fixed(static_cast<double>(frame->stats().gpu_bytes) * 1e-6), is_default});
  }
  return {std::move(frames), std::move(triangles), std::move(textures)};
}

}  // namespace app::accuracy
