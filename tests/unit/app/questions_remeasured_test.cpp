#include <tbb/parallel_for.h>

#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/GeodesicExact.hpp>
#include <GeographicLib/GeodesicLineExact.hpp>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "app/accuracy/question_studies.h"
#include "globe/planet/grid.h"
#include "globe/planet/profile.h"
#include "globe/planet/surface.h"
#include "tests/second_method.h"

// What `globe accuracy` reports of answers about the ground, measured again by looking at all nodes and at
// many places: they agree to 5 %.

namespace app::accuracy {
namespace {

using namespace second;
namespace planet = globe::planet;
using planet::Surface;

Long ground(const Surface& surface, const Geodetic& place, int level) {
  return second::ground(surface, globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg), level);
}

/// All of a sample, or in the quick tier the first of it: what is measured twice is measured over the same.
template <typename Subject>
std::vector<Subject> some_of(std::vector<Subject> sample) {
  constexpr std::size_t kFew = 4;
  if (std::getenv("GLOBE_TEST_FULL") == nullptr && sample.size() > kFew)
    sample.erase(sample.begin() + kFew, sample.end());
  return sample;
}

/// The highest node of a level within an angle of a direction, in a cell of a level and in all cells in it.
Long highest_node(const Surface& surface, const planet::Node& cell, int level, const Vec& u, Long radius) {
  std::array<Vec, 4> corners{};
  Vec middle{};
  for (int k = 0; k < 4; ++k) {
    const Vec corner = to_long(planet::node_direction({cell.d, cell.level, cell.i + k % 2, cell.j + k / 2}));
    corners[static_cast<std::size_t>(k)] = corner;
    for (std::size_t axis = 0; axis < 3; ++axis) middle[axis] += corner[axis] / 4.0L;
  }
  Long reach = 0;
  for (const Vec& corner : corners) reach = std::max(reach, angle(middle, corner));
  Long highest = -std::numeric_limits<Long>::infinity();
  if (cell.level > 1 && angle(middle, u) > radius + 1.2L * reach) return highest;
  if (cell.level == level) {
    for (int k = 0; k < 4; ++k) {
      if (angle(corners[static_cast<std::size_t>(k)], u) <= radius)
        highest = std::max(highest,
                           Long(surface.height(planet::Node{cell.d, level, cell.i + k % 2, cell.j + k / 2})));
    }
    return highest;
  }
  for (int k = 0; k < 4; ++k)
    highest = std::max(highest,
                       highest_node(surface, {cell.d, cell.level + 1, 2 * cell.i + k % 2, 2 * cell.j + k / 2},
                                    level, u, radius));
  return highest;
}

TEST(AccuracyRemeasured, HighestPlacesByLookingAtAllNodes) {
  const Ground planet = remade<AskedGround>();
  const auto surface = planet->get().surface;
  const std::vector<dvec3> centres = some_of(cone_centres({}));
  const int finest = question_level({});
  std::vector<std::vector<Long>> highest(centres.size());  // centre, level
  tbb::parallel_for(std::size_t{0}, centres.size(), [&](std::size_t k) {
    for (int level = finest - 6; level <= finest; ++level) {
      Long here = -std::numeric_limits<Long>::infinity();
      for (int d = 0; d < planet::kDiamonds; ++d)
        here = std::max(here, highest_node(*surface, {d, 0, 0, 0}, level, to_long(centres[k]),
                                           Long(0.5 * kConeRadius_deg) * kLongDegree));
      highest[k].push_back(here);
    }
  });
  const std::vector<Study> studies{summary_study(planet, centres, finest)};
  for (std::size_t n = 0; n < 6; ++n) {
    Second second;
    for (const std::vector<Long>& levels : highest) second.add(levels[n] - levels.back());
    expect_agreement(
        setting(studies, "questions.summary", "level " + std::to_string(finest - 6 + static_cast<int>(n))),
        second);
  }
}

/// How far a straight line clears the level's ground, by places along it, more of them around the lowest.
Long clearance(const Surface& surface, const PlacePair& eyes, int level) {
  const GeographicLib::Geocentric earth(surface.ellipsoid().a, surface.ellipsoid().f);
  std::array<Vec, 2> ends{};
  for (std::size_t e = 0; e < 2; ++e) {
    const Geodetic& eye = e == 0 ? eyes.a : eyes.b;
    double x = 0, y = 0, z = 0;
    earth.Forward(eye.lat_deg, eye.lon_deg, eye.h_m, x, y, z);
    ends[e] = {x, y, z};
  }
  const auto above = [&](Long share) {
    Vec p{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      p[axis] = ends[0][axis] + (ends[1][axis] - ends[0][axis]) * share;
    Geodetic place;
    earth.Reverse(static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]),
                  place.lat_deg, place.lon_deg, place.h_m);
    return place.h_m - std::max(ground(surface, place, level), 0.0L);
  };
  constexpr int kPlaces = 2000, kNear = 40;
  std::vector<std::pair<Long, int>> seen;
  for (int k = 0; k <= kPlaces; ++k) seen.emplace_back(above(Long(k) / kPlaces), k);
  std::sort(seen.begin(), seen.end());
  Long lowest = seen.front().first;
  for (std::size_t n = 0; n < 8; ++n) {
    for (int k = -kNear; k <= kNear; ++k) {
      const Long share = (Long(seen[n].second) + Long(k) / kNear) / kPlaces;
      if (share >= 0.0L && share <= 1.0L) lowest = std::min(lowest, above(share));
    }
  }
  return lowest;
}

TEST(AccuracyRemeasured, LinesOfSightByPlacesAlongThem) {
  const Ground planet = remade<AskedGround>();
  const auto surface = planet->get().surface;
  const int finest = question_level({});
  const std::vector<PlacePair> pairs = some_of(land_pairs(*surface, {}, finest));
  std::vector<PlacePair> eyes = pairs;
  std::vector<std::vector<Long>> clearances(eyes.size());  // pair, level
  tbb::parallel_for(std::size_t{0}, eyes.size(), [&](std::size_t k) {
    for (Geodetic* eye : {&eyes[k].a, &eyes[k].b}) {
      EXPECT_NEAR(eye->h_m, static_cast<double>(ground(*surface, *eye, finest)), 1e-3);
      eye->h_m += kEye_m;
    }
    for (int level = finest - 5; level <= finest; ++level)
      clearances[k].push_back(clearance(*surface, eyes[k], level));
  });
  const std::vector<Study> studies{sight_study(planet, pairs, finest)};
  for (std::size_t n = 0; n < 5; ++n) {
    Second second;
    for (const std::vector<Long>& levels : clearances) second.add(levels[n] - levels.back());
    expect_agreement(
        setting(studies, "questions.sight", "level " + std::to_string(finest - 5 + static_cast<int>(n))),
        second);
  }
}

TEST(AccuracyRemeasured, ProfilesByTheExactGeodesicOfGeographicLib) {
  const Ground planet = remade<AskedGround>();
  const auto surface = planet->get().surface;
  const int finest = question_level({});
  const GeographicLib::GeodesicExact geodesic(surface->ellipsoid().a, surface->ellipsoid().f);
  const std::vector<PlacePair> ways = some_of(land_pairs(*surface, {}, finest));
  const auto highest = [&](const PlacePair& way, std::size_t count) {
    const GeographicLib::GeodesicLineExact line =
        geodesic.InverseLine(way.a.lat_deg, way.a.lon_deg, way.b.lat_deg, way.b.lon_deg);
    Long top = -std::numeric_limits<Long>::infinity();
    for (std::size_t k = 0; k < count; ++k) {
      Geodetic place;
      line.Position(line.Distance() * static_cast<double>(k) / static_cast<double>(count - 1), place.lat_deg,
                    place.lon_deg);
      top = std::max(top, ground(*surface, place, finest));
    }
    return top;
  };
  const std::vector<Study> studies{profile_study(planet, ways, finest)};
  const std::size_t own = planet::profile_count(*surface, ways.front().a, ways.front().b, finest);
  std::vector<Long> truth(ways.size());
  tbb::parallel_for(std::size_t{0}, ways.size(), [&](std::size_t k) { truth[k] = highest(ways[k], 10007); });
  for (const std::size_t count : {std::size_t{16}, std::size_t{64}, std::size_t{256}, own}) {
    Second second;
    for (std::size_t k = 0; k < ways.size(); ++k) second.add(highest(ways[k], count) - truth[k]);
    expect_agreement(setting(studies, "questions.profile", std::to_string(count) + " samples"), second);
  }
}

}  // namespace
}  // namespace app::accuracy
