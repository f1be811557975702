#include <cstdio>

#include "app/accuracy/depth_scheme.h"
#include "app/accuracy/study.h"

namespace app::accuracy {
namespace {

/// Eight planes that fill the picture, nearest first: what is hidden costs little where depth is known before
/// the fragment shader runs.
std::vector<double> planes_from(double distance_m) {
  std::vector<double> planes;
  planes.reserve(8);
  for (int k = 0; k < 8; ++k) planes.push_back(distance_m * (1.0 + 0.01 * k));
  return planes;
}

struct Distance {
  std::string name, words;
  double metres;
};

}  // namespace

std::vector<Study> depth_studies(const Scope& scope) {
  std::vector<Study> studies;
  std::vector<std::shared_ptr<const DepthPlanes>> planes;
  for (const DepthScheme scheme : kDepthSchemes)
    planes.push_back(std::make_shared<const DepthPlanes>(scope.context, scheme, 1280, 720));
  for (const auto& [word, words, distance_m] :
       {Distance{"1m", "1 m", 1.0}, Distance{"100m", "100 m", 100.0}, Distance{"10km", "10 km", 1e4},
        Distance{"1000km", "1000 km", 1e6}, Distance{"100000km", "100,000 km", 1e8}}) {
    Study study{"depth." + word,
                "Depth told apart from " + words + " on",
                "",
                "distances themselves: how far apart they have to be to get different depths, by the "
                "formats; what a driver rounds in between (llvmpipe) may take up to three times that",
                std::to_string(depth_sample(distance_m).size()) +
                    " distances from there to a tenth more; near plane 0.05 m, far plane 1e9 m",
                "m",
                "ms for 8 planes of 1280x720 pixels",
                {}};
    for (std::size_t k = 0; k < planes.size(); ++k) {
      const DepthScheme scheme = kDepthSchemes[k];
      ErrorSum sum;
      for (const double at : depth_sample(distance_m)) {
        sum.add(smallest_separation(scheme, at), [&] {
          char text[32];
          std::snprintf(text, sizeof text, "%.6g m", at);
          return std::string(text);
        });
      }
      study.settings.push_back(
          {name_of(scheme), sum.figure(),
           [drawn = planes[k], at = planes_from(distance_m)] { return drawn->draw_ms(at); },
           scheme == DepthScheme::kReversedFloat,
           sum.figure().max > 0.8 * kFar ? "tells nothing apart" : ""});
    }
    studies.push_back(std::move(study));
  }
  return studies;
}

}  // namespace app::accuracy
