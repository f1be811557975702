#include "app/accuracy/study.h"

namespace app::accuracy {

std::vector<Family> families() {
  return {{"geodesics", geodesic_studies},
          {"heights", height_studies},
          {"storage", storage_studies},
          {"conversion", conversion_studies},
          {"covers", cover_studies}};
}

}  // namespace app::accuracy
