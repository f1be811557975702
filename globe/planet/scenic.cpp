#include "globe/planet/scenic.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace globe::planet {
namespace {

constexpr int kSearchLevel = 7;
constexpr int kSummitLevel = 11;
constexpr int kEyeLevel = 15;
constexpr double kGentle = 0.2;  ///< steepest slope a place may have
constexpr double kEyeHeight = 2.0;
constexpr double kSummitReach = 60000.0;

double bell(double x, double middle, double width) {
  const double t = (x - middle) / width;
  return std::exp(-t * t);
}

struct Candidate {
  dvec3 u;
  double score;
};

/// How much sea the nodes around have: best with some on one side.
double sea_factor(const Surface& surface, const Node& node) {
  if (!surface.has_sea()) return 1.0;
  constexpr int kReach = 5;
  int sea = 0;
  int all = 0;
  for (int dj = -kReach; dj <= kReach; ++dj) {
    for (int di = -kReach; di <= kReach; ++di) {
      if (hex_length(di, dj) > kReach) continue;
      ++all;
      if (surface.height(fold({node.d, node.level, node.i + di, node.j + dj})) < 0.0) ++sea;
    }
  }
  return 0.6 + 0.8 * std::min(0.5, static_cast<double>(sea) / all);
}

std::vector<Candidate> best_ranges(const Surface& surface, std::size_t wanted) {
  const int n = nodes_per_side(kSearchLevel);
  std::vector<std::pair<double, Node>> found;
  for (int d = 0; d < kDiamonds; ++d) {
    for (int j = 4; j < n - 4; ++j) {
      for (int i = 4; i < n - 4; ++i) {
        const Node node{d, kSearchLevel, i, j};
        const double height = surface.height(node);
        if (surface.has_sea() && height <= 0.0) continue;
        const double lowest = std::min({surface.height(Node{d, kSearchLevel, i + 2, j}),
                                        surface.height(Node{d, kSearchLevel, i - 2, j}),
                                        surface.height(Node{d, kSearchLevel, i, j + 2}),
                                        surface.height(Node{d, kSearchLevel, i, j - 2})});
        found.emplace_back(0.3 * height + (height - std::max(lowest, 0.0)), node);
      }
    }
  }
  const auto higher = [](const auto& a, const auto& b) { return a.first > b.first; };
  const std::size_t kept = std::min<std::size_t>(found.size(), 600);
  std::partial_sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(kept), found.end(), higher);
  std::vector<Candidate> ranges;
  for (std::size_t k = 0; k < kept; ++k) {
    const dvec3 u = node_direction(found[k].second);
    const double latitude = geo::degrees_from_normal(u).lat_deg;
    ranges.push_back(
        {u, found[k].first * bell(std::abs(latitude), 40.0, 16.0) * sea_factor(surface, found[k].second)});
  }
  std::sort(ranges.begin(), ranges.end(), [](const auto& a, const auto& b) { return a.score > b.score; });
  if (ranges.size() > wanted) ranges.resize(wanted);
  return ranges;
}

dvec3 moved(const dvec3& u, const dvec3& direction, double angle) {
  return glm::normalize(u * std::cos(angle) + direction * std::sin(angle));
}

/// Highest ground around a place.
dvec3 summit_near(const Surface& surface, const dvec3& u) {
  const geo::Geodetic at = geo::degrees_from_normal(u);
  const geo::LocalFrame frame = geo::local_frame(at.lat_deg, at.lon_deg);
  const double radius = surface.ellipsoid().mean_radius();
  const double step = 2500.0;
  dvec3 best = u;
  double highest = surface.height(u, kSummitLevel);
  for (double y = -kSummitReach; y <= kSummitReach; y += step) {
    for (double x = -kSummitReach; x <= kSummitReach; x += step) {
      const dvec3 there = glm::normalize(frame.up + (frame.east * x + frame.north * y) / radius);
      const double height = surface.height(there, kSummitLevel);
      if (height <= highest) continue;
      highest = height;
      best = there;
    }
  }
  return best;
}

/// Slope of the ground within some 150 m of a place.
double steepness_at(const Surface& surface, const dvec3& u) {
  const geo::Geodetic at = geo::degrees_from_normal(u);
  const geo::LocalFrame frame = geo::local_frame(at.lat_deg, at.lon_deg);
  constexpr double kStep = 150.0;
  const double angle = kStep / surface.ellipsoid().mean_radius();
  const auto rise = [&](const dvec3& direction) {
    return (surface.height(moved(u, direction, angle), kEyeLevel) -
            surface.height(moved(u, -direction, angle), kEyeLevel)) /
           (2.0 * kStep);
  };
  return std::hypot(rise(frame.east), rise(frame.north));
}

/// The best place to look at a summit from.
std::pair<double, ScenicView> best_view(const Surface& surface, const dvec3& summit) {
  const geo::Geodetic peak = geo::degrees_from_normal(summit);
  const geo::LocalFrame frame = geo::local_frame(peak.lat_deg, peak.lon_deg);
  const double radius = surface.ellipsoid().mean_radius();
  const double top = surface.height(summit, kSummitLevel);
  const double sun_heading = peak.lat_deg >= 0.0 ? 130.0 : 50.0;
  std::pair<double, ScenicView> best{-1e30, {}};
  for (int bearing = 0; bearing < 360; bearing += 10) {
    const dvec3 away = geo::look_direction(frame, bearing, 0.0);
    for (double distance = 12000.0; distance <= 36000.0; distance += 4000.0) {
      const dvec3 u = moved(summit, away, distance / radius);
      const double ground = surface.height(u, kEyeLevel);
      if (surface.has_sea() && ground < 20.0) continue;
      double hidden = -1e30;  // steepest line of sight to ground in the way
      for (double near = 250.0; near < 0.8 * distance; near *= 1.5) {
        const dvec3 there = moved(summit, away, (distance - near) / radius);
        hidden = std::max(hidden, (surface.height(there, kEyeLevel) - ground - kEyeHeight) / near);
      }
      geo::Geodetic place = geo::degrees_from_normal(u);
      const geo::LocalFrame here = geo::local_frame(place.lat_deg, place.lon_deg);
      const double heading =
          std::atan2(glm::dot(summit, here.east), glm::dot(summit, here.north)) * 57.29577951308232;
      const double to_sun = std::cos((heading - sun_heading) * 0.017453292519943295);
      const double light = 1.0 - 0.5 * std::max(0.0, to_sun - 0.1) - 0.15 * std::max(0.0, -to_sun - 0.6);
      const double open = std::clamp((top - ground) / distance - hidden, -0.1, 0.1);
      if (steepness_at(surface, u) > kGentle) continue;
      const double low = std::clamp(1.3 - ground / 2500.0, 0.3, 1.0);  // meadows in front
      const double score = (top - ground) * light * (1.0 + 6.0 * open) * low;
      if (score <= best.first) continue;
      place.h_m = ground;
      best = {score, {place, heading < 0.0 ? heading + 360.0 : heading}};
    }
  }
  return best;
}

}  // namespace

ScenicView scenic_place(const Surface& surface) {
  std::pair<double, ScenicView> best{-1e30, {}};
  for (const Candidate& range : best_ranges(surface, 3)) {
    const auto view = best_view(surface, summit_near(surface, range.u));
    if (view.first > best.first) best = view;
  }
  return best.second;
}

}  // namespace globe::planet
