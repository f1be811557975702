#include "app/accuracy/study.h"

namespace app::accuracy {

std::vector<Family> families() {
  return {{"geometry",
           geometry_studies,
           {},
           {"geometry.sine_cosine", "geometry.arctangent", "geometry.midpoints"}},
          {"geodesics", geodesic_studies, {"--ellipsoid"}, {"geodesics.ellipsoid", "geodesics.sphere"}},
          {"heights", height_studies, {"--interpolation"}},
          {"storage", storage_studies, {}, {"storage.heights"}},
          {"conversion", conversion_studies, {"--filter", "--as-thesis", "convert --level", "inset --level"}},
          {"questions", question_studies, {"summary --level", "sight --level", "profile --count"}},
          {"covers", cover_studies, {"cover --level", "cover --max-ranges"}}};
}

}  // namespace app::accuracy
