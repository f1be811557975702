#include <cstdio>

#include "app/accuracy/harmonic_planet.h"
#include "app/accuracy/samples.h"
#include "globe/planet/interpolation.h"

namespace app::accuracy {
namespace {

using globe::planet::Interpolation;

}  // namespace

std::vector<Study> height_studies(const Scope& scope) {
  const converters::Harmonics harmonics = known_relief();
  const auto at = std::make_shared<const std::vector<globe::geo::Geodetic>>(height_places(scope));
  std::vector<double> truth;
  for (const auto& place : *at) truth.push_back(harmonics.at(place.lat_deg, place.lon_deg));
  std::vector<Study> studies;
  for (int level = 6; level <= (scope.full ? 9 : 7); ++level) {
    const auto planet = std::make_shared<const HarmonicPlanet>(harmonics, level);
    Study study{
        "heights.interpolation.l" + std::to_string(level),
        "Height between the nodes of level " + std::to_string(level),
        "--interpolation",
        "the function itself: harmonics to degree 64, 1000 m RMS",
        std::to_string(at->size()) + " places: anywhere, on edges of diamonds, on the equator, at the poles",
        "m",
        "ns a place",
        {}};
    for (const auto& way :
         {std::pair{"nearest", Interpolation::kNearest}, std::pair{"linear", Interpolation::kLinear},
          std::pair{"cubic", Interpolation::kCubic}}) {
      const Interpolation interpolation = way.second;
      const auto height = [planet, interpolation](const globe::geo::Geodetic& place) {
        return globe::planet::data_height_at(*planet->surface(),
                                             globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg),
                                             interpolation)
            .height_m;
      };
      ErrorSum sum;
      for (std::size_t k = 0; k < at->size(); ++k) {
        const auto& place = (*at)[k];
        sum.add(height(place) - truth[k], [&] {
          char text[48];
          std::snprintf(text, sizeof text, "%.4f,%.4f", place.lat_deg, place.lon_deg);
          return std::string(text);
        });
      }
      const auto cost = timed(static_cast<double>(at->size()), [at, height] {
        double all = 0;
        for (const auto& place : *at) all += height(place);
        keep(static_cast<double>(all));
      });
      study.settings.push_back({way.first, sum.figure(), cost, interpolation == Interpolation::kLinear});
    }
    studies.push_back(std::move(study));
  }
  return studies;
}

}  // namespace app::accuracy
