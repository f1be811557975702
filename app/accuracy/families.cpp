#include "app/accuracy/study.h"

namespace app::accuracy {

std::vector<Family> families() {
  return {
      {.name = "geometry",
       .studies = geometry_studies,
       .approximations = {"geometry.sine_cosine", "geometry.arctangent", "geometry.midpoints"}},
      {.name = "geodesics",
       .studies = geodesic_studies,
       .knobs = {"--ellipsoid"},
       .approximations = {"geodesics.ellipsoid", "geodesics.sphere"}},
      {.name = "heights", .studies = height_studies, .knobs = {"--interpolation"}},
      {.name = "storage", .studies = storage_studies, .approximations = {"storage.heights"}},
      {.name = "conversion",
       .studies = conversion_studies,
       .knobs = {"--filter", "--as-thesis", "convert --level", "inset --level"}},
      {.name = "questions",
       .studies = question_studies,
       .knobs = {"summary --level", "sight --level", "profile --count"}},
      {.name = "covers", .studies = cover_studies, .knobs = {"cover --level", "cover --max-ranges"}},
      {.name = "positions", .studies = position_studies, .knobs = {"--positions"}, .draws = true},
      {.name = "detail", .studies = detail_studies, .knobs = {"--detail"}, .draws = true},
      {.name = "morph", .studies = morph_studies, .knobs = {"--morph"}, .draws = true},
      {.name = "depth", .studies = depth_studies, .approximations = {"depth"}, .draws = true},
      {.name = "windows", .studies = window_studies, .knobs = {"--window"}, .draws = true},
      {.name = "sky",
       .studies = sky_studies,
       .approximations = {"sky.steps", "sky.model", "sky.columns", "sky.map", "sky.haze"},
       .draws = true},
      {.name = "atmosphere",
       .studies = atmosphere_studies,
       .approximations = {"atmosphere.tables", "atmosphere.samples", "atmosphere.haze", "atmosphere.map"}},
      {.name = "shading",
       .studies = shading_studies,
       .approximations = {"shading.tone", "shading.texels", "shading.normals"},
       .draws = true},
      {.name = "samples", .studies = sample_studies, .knobs = {"--samples"}, .draws = true},
      {.name = "domes", .studies = dome_studies, .knobs = {"--faces"}, .draws = true},
      {.name = "flat",
       .studies = flat_studies,
       .knobs = {"flat --error", "flat --lod", "flat --morph", "flat --spacing", "flat endless --rings"},
       .draws = true},
      {.name = "marks", .studies = marks_studies, .approximations = {"marks.lines"}}};
}

}  // namespace app::accuracy
