// H23: where a ray meets the drawn surface, against every triangle of it, node by node; and against
// `globe height --drawn`.

#include "globe/clipmap/drawn_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "globe/clipmap/ground_below.h"
#include "globe/clipmap/level_data.h"
#include "globe/planet/drawn_ground.h"
#include "tests/hard/directions.h"
#include "tests/hard/table.h"

namespace {

using globe::clipmap::ClipmapState;
using globe::clipmap::DrawnPoint;
using globe::clipmap::DrawnSurface;
using globe::clipmap::ivec2;
using globe::clipmap::Patch;
using globe::clipmap::Ray;
using globe::clipmap::Settings;
using globe::planet::Node;
using globe::planet::Surface;
using hard::dvec3;

constexpr int kDetail = 16;
constexpr int kFinestDrawn = 26;
constexpr double kHitError = 1e-6;  ///< share of the distance
constexpr double kPlaneError_m = 1e-6;

std::shared_ptr<const Surface> builtin_planet() {
  static const auto planet = Surface::builtin(1);
  return planet;
}

/// A camera's clipmap, complete.
struct View {
  Settings settings = Settings::for_detail(kDetail, 0);
  dvec3 position{0.0};
  std::shared_ptr<const ClipmapState> state;
  globe::clipmap::FinestLevel finest{};

  View(const dvec3& u, double above_m) {
    const Surface& surface = *builtin_planet();
    globe::geo::Geodetic place = globe::geo::degrees_from_normal(u);
    place.h_m = surface.drawn_height(surface.height(u, 20)) + above_m;
    position = globe::geo::ecef_from_geodetic(surface.ellipsoid(), place);
    const double above = globe::clipmap::height_above_ground(settings, surface, position, kFinestDrawn, true);
    finest = globe::clipmap::finest_level(settings, surface.root_edge(), std::max(above, 0.1), kFinestDrawn);
    state = globe::clipmap::advance(settings, surface, {u, finest.level, {}}, nullptr,
                                    globe::clipmap::Stride::kWhole)
                .state;
  }

  DrawnSurface drawn() const { return {settings, builtin_planet(), state, finest.level, finest.fade}; }
};

/// A corner of a triangle, and where it is drawn: node by node, without tiles.
struct Corner {
  Node node;
  dvec3 position;
};
using Triangle = std::array<Corner, 3>;

dvec3 own_position(const Node& node) {
  const Surface& surface = *builtin_planet();
  return globe::geo::ecef_from_normal(surface.ellipsoid(), globe::planet::node_direction(node),
                                      surface.drawn_height(surface.height(node)));
}

Corner drawn_corner(const View& view, const Node& node) {
  const dvec3 own = own_position(node);
  if (node.level == view.settings.base_level || ((node.i | node.j) & 1) == 0) return {node, own};
  const auto images = globe::clipmap::images(globe::clipmap::nadir(view.state->target.u, node.level), node.d);
  const auto distance = globe::clipmap::hex_distance(
      images, {node.i * globe::clipmap::kSubcell, node.j * globe::clipmap::kSubcell});
  float alpha = globe::clipmap::morph_factor(globe::clipmap::morph_band(view.settings), distance);
  if (node.level == view.finest.level) alpha = std::max(alpha, view.finest.fade);
  const auto ends = globe::planet::halved_edge(node.i, node.j);
  const dvec3 a = own_position({node.d, node.level, ends[0].x, ends[0].y});
  const dvec3 b = own_position({node.d, node.level, ends[1].x, ends[1].y});
  return {node, own + (0.5 * (a + b) - own) * static_cast<double>(alpha)};
}

std::vector<Triangle> all_triangles(const View& view) {
  const auto mesh = globe::clipmap::make_patch_mesh(view.settings.m);
  std::vector<Triangle> triangles;
  for (int level = view.settings.base_level; level <= view.finest.level; ++level) {
    const auto level_of = [&](int l) {
      return view.state->levels[static_cast<std::size_t>(l - view.settings.base_level)].get();
    };
    const auto* hole = level < view.finest.level ? &level_of(level + 1)->region : nullptr;
    for (const Patch& patch : globe::clipmap::make_ring(view.settings, level_of(level)->region, hole)) {
      std::vector<Corner> corners;
      for (const auto& [a, b] : mesh.vertices) {
        const ivec2 ij = globe::clipmap::patch_node(patch.trixel, view.settings.m, a, b);
        corners.push_back(drawn_corner(view, {patch.trixel.d, level, ij.x, ij.y}));
      }
      const auto& order = mesh.indices[static_cast<std::size_t>(patch.rim)];
      for (std::size_t k = 0; k < order.size(); k += 3)
        triangles.push_back({corners[order[k]], corners[order[k + 1]], corners[order[k + 2]]});
    }
  }
  return triangles;
}

/// First meeting with a triangle seen from outside, by planes and volumes in extended precision; negative
/// when there is none.
double nearest_hit(const std::vector<Triangle>& triangles, const dvec3& origin, const dvec3& direction) {
  using Real = long double;
  using Vector = glm::vec<3, Real>;
  const Vector d(direction);
  Real nearest = -1;
  for (const Triangle& triangle : triangles) {
    std::array<Vector, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = Vector(triangle[k].position) - Vector(origin);
    const Vector normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const Real steepness = glm::dot(normal, d);
    if (steepness >= 0) continue;
    bool within = true;
    for (std::size_t k = 0; k < 3; ++k) within = within && glm::dot(glm::cross(p[k], p[(k + 1) % 3]), d) <= 0;
    const Real t = glm::dot(normal, p[0]) / steepness;
    if (within && t > 0 && (nearest < 0 || t < nearest)) nearest = t;
  }
  return static_cast<double>(nearest);
}

/// Places anywhere, and by the six corners and on the edges of diamonds.
dvec3 place(std::mt19937_64& random, std::size_t k) {
  const dvec3 anywhere = hard::random_direction(random);
  dvec3 axis(0.0);
  axis[static_cast<int>(k / 3 % 3)] = random() % 2 == 0 ? 1.0 : -1.0;
  if (k % 3 == 0) return anywhere;
  if (k % 3 == 1) return glm::normalize(axis + 1e-4 * anywhere);
  return glm::normalize(dvec3(anywhere.x, 0.0, anywhere.z));
}

double height_of(std::mt19937_64& random) {
  return 0.1 * std::pow(10.0, std::uniform_real_distribution<double>(0.0, 8.5)(random));
}

TEST(H23, ARayMeetsTheSurfaceWhereTheNearestOfAllItsTrianglesLies) {
  std::mt19937_64 random(2301);
  std::normal_distribution<double> normal;
  const std::size_t views = hard::cases(60), rays = 60;
  double worst = 0, worst_coarser = 0;
  std::size_t hits = 0, disagree = 0;
  for (std::size_t k = 0; k < views; ++k) {
    const dvec3 u = place(random, k);
    const double above = height_of(random);
    const View view(u, above);
    const std::vector<Triangle> triangles = all_triangles(view);
    const DrawnSurface drawn = view.drawn();
    const DrawnSurface coarser(view.settings, builtin_planet(), view.state,
                               std::max(view.finest.level - 1, view.settings.base_level), 0.0f);
    const double dip = std::acos(std::min(6.4e6 / (6.4e6 + above), 1.0));
    for (std::size_t r = 0; r < rays; ++r) {
      // from straight down to a little above the horizon
      const double pitch = -dip - (1.55 - dip) * std::pow(double(r) / rays, 3.0) + 0.02 * (r % 2 ? 0.0 : 1.0);
      const dvec3 aside = glm::normalize(glm::cross(u, hard::random_direction(random)));
      const dvec3 direction = glm::normalize(aside * std::cos(pitch) + u * std::sin(pitch));
      const double truth = nearest_hit(triangles, view.position, direction);
      const auto hit = drawn.first_hit({view.position, direction});
      if ((truth >= 0) != hit.has_value()) ++disagree;
      if (truth < 0 || !hit) continue;
      ++hits;
      worst = std::max(worst, std::abs(glm::distance(hit->position, view.position) - truth) / (1.0 + truth));
      const auto other = coarser.first_hit({view.position, direction});
      if (other) worst_coarser = std::max(worst_coarser, std::abs(other->distance_m - truth) / (1.0 + truth));
    }
  }
  hard::report("H23",
               "distance along rays to the drawn surface against all triangles, " + std::to_string(hits) +
                   " hits, share of it",
               "1e-6", hard::figure(worst));
  hard::report("H23", "rays that hit by one account and miss by the other", "0", std::to_string(disagree));
  hard::report("H23", "negative control: the surface without its finest level", "> 1e-6",
               hard::figure(worst_coarser));
  EXPECT_LE(worst, kHitError);
  EXPECT_EQ(disagree, 0u);
  EXPECT_GT(hits, views * rays / 3);
  EXPECT_GT(worst_coarser, kHitError);
}

/// Whether a ray meets none of the triangles nearer than a distance, by the usual test of each on its own
/// (Moller and Trumbore) in double.
bool slips_through_by_naive_test(const std::vector<Triangle>& triangles, const Ray& ray, double distance_m) {
  return std::none_of(triangles.begin(), triangles.end(), [&](const Triangle& triangle) {
    const dvec3 p = triangle[1].position - triangle[0].position;
    const dvec3 q = triangle[2].position - triangle[0].position;
    const dvec3 across = glm::cross(ray.direction(), q);
    const double volume = glm::dot(p, across);
    const dvec3 from = ray.origin() - triangle[0].position;
    const double u = glm::dot(from, across) / volume;
    const dvec3 over = glm::cross(from, p);
    const double v = glm::dot(ray.direction(), over) / volume;
    return volume > 0.0 && u > 0.0 && v > 0.0 && u + v < 1.0 && glm::dot(q, over) / volume < distance_m;
  });
}

/// Nothing is behind the ground: a ray aimed at a corner or an edge of the mesh from above meets it there.
TEST(H23, NoRayFallsThroughCornersAndEdgesOfTheMesh) {
  std::mt19937_64 random(2302);
  const std::size_t views = hard::cases(60);
  std::size_t aimed = 0, through = 0, naive = 0, naive_aimed = 0;
  for (std::size_t k = 0; k < views; ++k) {
    const View view(place(random, k), height_of(random));
    const DrawnSurface drawn = view.drawn();
    const std::vector<Triangle> triangles = all_triangles(view);
    for (std::size_t t = random() % 7; t < triangles.size(); t += 1 + triangles.size() / 400) {
      const Triangle& triangle = triangles[t];
      const double share = std::ldexp(static_cast<double>(random() >> 11), -53);
      const std::array<dvec3, 3> targets{
          triangle[0].position, 0.5 * (triangle[0].position + triangle[1].position),
          triangle[1].position + (triangle[2].position - triangle[1].position) * share};
      for (const dvec3& target : targets) {
        const dvec3 from = target + globe::planet::node_direction(triangle[0].node) * 3e4;
        const Ray ray(from, glm::normalize(target - from));
        const double beyond = glm::distance(target, from) + 1e-3;
        const auto hit = drawn.first_hit(ray);
        if (!hit || hit->distance_m > beyond) ++through;
        if (++aimed % 16 != 0) continue;
        ++naive_aimed;
        naive += slips_through_by_naive_test(triangles, ray, beyond) ? 1 : 0;
      }
    }
  }
  hard::report("H23", "rays at corners and edges of the mesh that fall through, " + std::to_string(aimed),
               "0", std::to_string(through));
  hard::report("H23",
               "negative control: with each triangle tested on its own, " + std::to_string(naive_aimed),
               "> 0", std::to_string(naive));
  EXPECT_EQ(through, 0u);
  EXPECT_GT(aimed, 1000u);
  EXPECT_GT(naive, 0u);
}

TEST(H23, WhereNothingIsMorphedHeightDrawnAgrees) {
  std::mt19937_64 random(2303);
  const std::size_t views = hard::cases(120), rays = 80;
  std::size_t unmorphed = 0;
  double worst = 0, worst_morphed = 0;
  for (std::size_t k = 0; k < views; ++k) {
    const dvec3 u = place(random, k);
    const View view(u, height_of(random));
    const DrawnSurface drawn = view.drawn();
    for (std::size_t r = 0; r < rays; ++r) {
      const dvec3 aside = glm::normalize(glm::cross(u, hard::random_direction(random)));
      const double pitch = -1.57 * std::pow((static_cast<double>(r) + 0.5) / rays, 2.0);
      const auto hit =
          drawn.first_hit({view.position, glm::normalize(aside * std::cos(pitch) + u * std::sin(pitch))});
      if (!hit) continue;
      const auto at = globe::geo::geodetic_from_ecef(builtin_planet()->ellipsoid(), hit->position);
      const double height =
          globe::planet::drawn_ground(*builtin_planet(),
                                      globe::geo::normal_from_degrees(at.lat_deg, at.lon_deg), hit->level)
              .height_m;
      double& of = hit->alpha == 0.0 ? worst : worst_morphed;
      unmorphed += hit->alpha == 0.0 ? 1 : 0;
      of = std::max(of, std::abs(height - at.h_m));
    }
  }
  hard::report("H23",
               "height of the first hit against height --drawn at its level where alpha is 0, " +
                   std::to_string(unmorphed),
               "1e-6 m", hard::figure(worst) + " m");
  hard::report("H23", "negative control: the same where alpha is not 0", "> 1e-6 m",
               hard::figure(worst_morphed) + " m");
  EXPECT_LE(worst, kPlaneError_m);
  EXPECT_GT(unmorphed, views * rays / 4);
  EXPECT_GT(worst_morphed, kPlaneError_m);
}

}  // namespace
