#include "app/accuracy/question_studies.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "globe/htm/cone.h"
#include "globe/planet/interpolation.h"
#include "globe/planet/profile.h"
#include "globe/planet/sight.h"
#include "globe/planet/summary.h"
#include "globe/planet/surface.h"

namespace app::accuracy {
namespace {

namespace planet = globe::planet;
using globe::geo::Geodetic;
using globe::htm::dvec3;

std::string text_of(const PlacePair& pair) {
  char text[96];
  std::snprintf(text, sizeof text, "%.6f,%.6f to %.6f,%.6f", pair.a.lat_deg, pair.a.lon_deg, pair.b.lat_deg,
                pair.b.lon_deg);
  return text;
}

/// A setting: what `ask` answers of each subject against the truth, and how long it takes.
template <typename Subject, typename Ask, typename Words>
void add(Study& study, std::string name, bool is_default, const Ground& ground,
         const std::shared_ptr<std::vector<Subject>>& subjects, const std::vector<double>& truth,
         const Ask& ask, const Words& words) {
  ErrorSum sum;
  for (std::size_t k = 0; k < truth.size(); ++k)
    sum.add(ask((*subjects)[k]) - truth[k], [&] { return words(k); });
  const auto cost = timed(
      static_cast<double>(subjects->size()),
      [subjects, ask] {
        double all = 0;
        for (const Subject& subject : *subjects) all += ask(subject);
        keep(all);
      },
      1e6);
  study.settings.push_back({std::move(name), sum.figure(), cost, is_default, {}, release_of(ground)});
}

}  // namespace

Study summary_study(const Ground& ground, const std::vector<dvec3>& centres, int finest) {
  const auto regions = std::make_shared<std::vector<globe::htm::Cone>>();
  for (const dvec3& centre : centres) regions->emplace_back(centre, 0.5 * kConeRadius_deg);
  const auto highest = [ground](const globe::htm::Cone& cone, int level) {
    return planet::summarize(*ground->get().surface, cone, level)->highest.height_m;
  };
  std::vector<double> truth;
  for (const auto& cone : *regions) truth.push_back(highest(cone, finest));
  Study study{
      "questions.summary",
      "The highest place of a region, by the level whose nodes are looked at",
      "summary --level",
      "level " + std::to_string(finest),
      std::to_string(regions->size()) +
          " cones of half a degree over the built-in planet, three of them on corners of the octahedron",
      "m",
      "ms a region",
      {}};
  for (int level = finest - 6; level < finest; ++level) {
    add(
        study, "level " + std::to_string(level), level == ground->get().surface->data_level(), ground,
        regions, truth, [=](const globe::htm::Cone& cone) { return highest(cone, level); },
        [](std::size_t k) { return "cone " + std::to_string(k); });
  }
  return study;
}

Study sight_study(const Ground& ground, const std::vector<PlacePair>& pairs, int finest) {
  const auto eyes = std::make_shared<std::vector<PlacePair>>(pairs);
  for (PlacePair& pair : *eyes) {
    pair.a.h_m += kEye_m;
    pair.b.h_m += kEye_m;
  }
  const auto clearance = [ground](const PlacePair& pair, int level) {
    return planet::sight(*ground->get().surface, pair.a, pair.b, {.level = level}).lowest.clearance_m;
  };
  std::vector<double> truth;
  for (const PlacePair& pair : *eyes) truth.push_back(clearance(pair, finest));
  Study study{
      "questions.sight",
      "How far a line of sight clears the ground, by the ground's level",
      "sight --level",
      "level " + std::to_string(finest),
      std::to_string(eyes->size()) + " pairs on the built-in planet's land, 50 km apart, 30 m above ground",
      "m",
      "ms a look",
      {}};
  for (int level = finest - 5; level < finest; ++level) {
    add(
        study, "level " + std::to_string(level), level == ground->get().surface->data_level(), ground, eyes,
        truth, [=](const PlacePair& pair) { return clearance(pair, level); },
        [&](std::size_t k) { return text_of((*eyes)[k]); });
  }
  return study;
}

Study profile_study(const Ground& ground, const std::vector<PlacePair>& pairs, int finest) {
  const auto ways = std::make_shared<std::vector<PlacePair>>(pairs);
  const auto highest = [ground, finest](const PlacePair& pair, std::size_t count) {
    double top = -1e9;
    for (const planet::ProfileSample& sample : planet::profile(*ground->get().surface, pair.a, pair.b, count,
                                                               finest, planet::Interpolation::kLinear))
      top = std::max(top, sample.height_m);
    return top;
  };
  constexpr std::size_t kTruth = 10007;  // no multiple of any of the counts
  std::vector<double> truth;
  for (const PlacePair& pair : *ways) truth.push_back(highest(pair, kTruth));
  Study study{"questions.profile",
              "The highest place on the way between two, by the number of samples",
              "profile --count",
              std::to_string(kTruth) + " samples",
              std::to_string(ways->size()) + " ways of 50 km over the built-in planet's land, level " +
                  std::to_string(finest),
              "m",
              "ms a profile",
              {}};
  const std::size_t own =
      planet::profile_count(*ground->get().surface, ways->front().a, ways->front().b, finest);
  for (const std::size_t count : {std::size_t{16}, std::size_t{64}, std::size_t{256}, own}) {
    add(
        study, std::to_string(count) + " samples", count == own, ground, ways, truth,
        [=](const PlacePair& pair) { return highest(pair, count); },
        [&](std::size_t k) { return text_of((*ways)[k]); });
  }
  return study;
}

std::vector<Study> question_studies(const Scope& scope) {
  const auto ground = remade<AskedGround>();
  const int finest = question_level(scope);
  const std::vector<PlacePair> pairs = land_pairs(*ground->get().surface, scope, finest);
  std::vector<Study> studies{summary_study(ground, cone_centres(scope), finest),
                             sight_study(ground, pairs, finest), profile_study(ground, pairs, finest)};
  ground->release();
  return studies;
}

}  // namespace app::accuracy
