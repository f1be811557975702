#include "app/accuracy/conversion_studies.h"

#include <memory>
#include <utility>

#include "app/accuracy/samples.h"

namespace app::accuracy {
namespace {

using converters::Filter;
using converters::RoundTripMethod;
using converters::Sampling;

Setting setting_of(std::string name, const RoundTripMethod& way, int level, const Map& map, const Map& truth,
                   bool is_default) {
  const converters::RoundTripLoss loss = converters::round_trip(*map, way, level, *truth);
  const auto cost = [=] { return 1e3 * converters::round_trip(*map, way, level, *truth).there_s; };
  return {std::move(name),
          {loss.max_m, loss.rms_m,
           "pixel " + std::to_string(loss.worst_x) + "," + std::to_string(loss.worst_y) + " of " +
               std::to_string(truth->width) + "x" + std::to_string(truth->height())},
          cost,
          is_default};
}

Study study_of(std::string name, std::string title, std::string knob, const Map& truth) {
  return {
      std::move(name),
      std::move(title),
      std::move(knob),
      "the function itself: harmonics to degree 64, 1000 m RMS",
      std::to_string(truth->metres.size()) + " pixels of the whole planet, the poles included; RMS by area",
      "m",
      "ms a map, sampling alone",
      {}};
}

}  // namespace

Study filter_study(const Map& map, int level, int own_level, const Map& truth) {
  Study study = study_of("conversion.filter.l" + std::to_string(level),
                         "A map of " + std::to_string(map->width) + " pixels to level " +
                             std::to_string(level) + " and back, by filter",
                         "--filter, --as-thesis", truth);
  for (const converters::NamedRoundTrip& method : converters::round_trip_methods()) {
    const bool is_default = method.method.filter == (level < own_level ? Filter::kArea : Filter::kBilinear) &&
                            !method.method.as_thesis;
    study.settings.push_back(setting_of(method.name, method.method, level, map, truth, is_default));
  }
  return study;
}

std::vector<Study> conversion_studies(const Scope& scope) {
  const auto [width, truth_width, own_level] = map_sample(scope);
  const converters::Harmonics relief = known_relief();
  const Map map = std::make_shared<const converters::HeightMap>(map_of(relief, width));
  const Map truth = std::make_shared<const converters::HeightMap>(map_of(relief, truth_width));
  std::vector<Study> studies;
  for (const int level : {own_level - 1, own_level, own_level + 1})
    studies.push_back(filter_study(map, level, own_level, truth));
  Study levels =
      study_of("conversion.level", "The same by level, bilinear", "convert --level, inset --level", truth);
  for (int level = own_level - 2; level <= own_level + (scope.full ? 3 : 2); ++level) {
    levels.settings.push_back(setting_of("level " + std::to_string(level),
                                         {Filter::kBilinear, Sampling::kLinear, false}, level, map, truth,
                                         level == own_level));
  }
  studies.push_back(std::move(levels));
  return studies;
}

}  // namespace app::accuracy
