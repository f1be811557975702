#include <memory>
#include <numbers>

#include "app/accuracy/samples.h"
#include "globe/htm/cone.h"
#include "globe/htm/cover.h"

namespace app::accuracy {
namespace {

using globe::htm::Cone;
using globe::htm::CoverSettings;
using globe::htm::dvec3;

/// Area of a trixel on the unit sphere, by the tangent of half of it (Van Oosterom and Strackee 1983).
double area(globe::htm::Trixel trixel) {
  const auto [a, b, c] = globe::htm::corners(trixel);
  const auto dot = [](const dvec3& p, const dvec3& q) { return p.x * q.x + p.y * q.y + p.z * q.z; };
  const double triple =
      a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
  return 2.0 * std::atan2(std::abs(triple), 1.0 + dot(a, b) + dot(b, c) + dot(c, a));
}

double area_of(const std::vector<globe::htm::IdRange>& ranges, int level) {
  double sum = 0;
  for (const globe::htm::IdRange& range : ranges)
    globe::htm::for_each_whole_trixel(level, range, [&](globe::htm::Trixel trixel) { sum += area(trixel); });
  return sum;
}

Study study_of(const char* name, const char* title, const char* knob, const std::vector<dvec3>& at,
               const std::vector<std::pair<std::string, CoverSettings>>& settings) {
  Study study{name,
              title,
              knob,
              "the cap's own area, 2 pi (1 - cos r)",
              std::to_string(at.size()) + " cones of 1 degree, three of them on corners of the octahedron",
              "% too much area",
              "us a cover",
              {}};
  const double cap = 2.0 * std::numbers::pi * (1.0 - std::cos(kConeRadius_deg * std::numbers::pi / 180.0));
  for (const auto& labelled : settings) {
    const CoverSettings cover = labelled.second;
    ErrorSum sum;
    std::size_t ranges = 0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      const auto found = globe::htm::cover(Cone(at[k], kConeRadius_deg), cover);
      ranges += found.size();
      sum.add(100.0 * (area_of(found, cover.level) / cap - 1.0), [&] { return "cone " + std::to_string(k); });
    }
    const auto cost = timed(
        static_cast<double>(at.size()),
        [=] {
          std::size_t all = 0;
          for (const dvec3& u : at) all += globe::htm::cover(Cone(u, kConeRadius_deg), cover).size();
          keep(static_cast<double>(all));
        },
        1e3);
    study.settings.push_back({labelled.first, sum.figure(), cost, false,
                              std::to_string(ranges / at.size()) + " ranges on average"});
  }
  return study;
}

}  // namespace

std::vector<Study> cover_studies(const Scope& scope) {
  const std::vector<dvec3> at = cone_centres(scope);
  std::vector<std::pair<std::string, CoverSettings>> levels, limits;
  for (int level = 6; level <= (scope.full ? 14 : 12); ++level)
    levels.push_back({"level " + std::to_string(level), {.level = level}});
  for (const std::size_t limit : {4U, 8U, 16U, 32U, 64U, 128U, 256U})
    limits.push_back({std::to_string(limit) + " ranges", {.level = 20, .max_ranges = limit}});
  return {study_of("covers.level", "A cover's excess by its level", "cover --level", at, levels),
          study_of("covers.ranges", "A cover's excess by the number of its ranges, level 20",
                   "cover --max-ranges", at, limits)};
}

}  // namespace app::accuracy
