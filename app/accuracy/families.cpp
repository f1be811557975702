#include "app/accuracy/study.h"

namespace app::accuracy {

std::vector<Family> families() {
  return {{"geodesics", geodesic_studies},  {"heights", height_studies},
          {"storage", storage_studies},     {"conversion", conversion_studies},
          {"covers", cover_studies},        {"positions", position_studies, true},
          {"detail", detail_studies, true}, {"morph", morph_studies, true},
          {"depth", depth_studies, true},   {"windows", window_studies, true},
          {"sky", sky_studies, true},       {"shading", shading_studies, true},
          {"samples", sample_studies, true}};
}

}  // namespace app::accuracy
