#include "app/accuracy/drawing_quality.h"
#include "app/accuracy/pop.h"
#include "app/accuracy/remade.h"
#include "app/accuracy/repeated_frame.h"
#include "app/accuracy/study.h"
#include "globe/planet/scenic.h"

namespace app::accuracy {
namespace {

using globe::clipmap::Settings;

constexpr int kMorphedDetail = 64;
constexpr int kFinestMorphed = 24;  ///< level

}  // namespace

std::vector<Study> morph_studies(const Scope& scope) {
  const std::shared_ptr<const Surface>& surface = scope.planet;
  std::vector<globe::geo::Geodetic> at{globe::planet::scenic_place(*surface).place};
  if (scope.full) at.insert(at.end(), {{0.013, 89.983}, {35.2644, -135.0}, {41.3, 0.0}, {0.0, 30.7}});
  const int step = scope.full ? 1 : 3;
  Study study{"morph.pop",
              "Levels that turn into each other, and levels that change at once",
              "--morph",
              "the picture just before: vertices of a level that is admitted, and where they stood",
              "all vertices at each admission of " + std::string(scope.full ? "every" : "every third") +
                  " level of descents to level 24 over " + std::to_string(at.size()) +
                  " places, the first in mountains; 1280x720, 60 degrees high",
              "px",
              "ms a frame of 1280x720 pixels, from 2 km",
              {}};
  const Camera camera = judged_views(*surface, kPicture)[3].camera;
  const glm::dvec3 sun = sun_over(*surface, camera);
  for (const bool morph : {false, true}) {
    Settings settings = Settings::for_detail(kMorphedDetail, 0);
    settings.morph = morph;
    MeshProbe probe(surface, settings);
    ErrorSum sum;
    for (const auto& place : at) {
      for (int level = settings.base_level + 1; level <= kFinestMorphed; level += step)
        add_pops(*surface, probe, place, level, morph ? 1.0f : 0.0f, sum);
    }
    globe::render::RenderSettings ground;
    ground.clipmap.morph = morph;
    const auto frame = remade<RepeatedFrame>(scope.context, surface, ground, kPicture.width, kPicture.height);
    study.settings.push_back({morph ? "on" : "off",
                              sum.figure(),
                              [=] { return frame->get().draw_ms(camera, sun); },
                              morph,
                              {},
                              release_of(frame)});
  }
  return {std::move(study)};
}

}  // namespace app::accuracy
