#include "globe/clipmap/lighting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/glm.hpp>
#include <random>

#include "globe/clipmap/level_data.h"
#include "globe/planet/grid.h"

namespace {

using globe::clipmap::dvec3;
using globe::clipmap::Lighting;
using globe::clipmap::lit_nodes;
using globe::clipmap::NodeRect;
using globe::clipmap::ShadingNodes;

namespace shader {
using namespace glm;
#include "shaders/lib/lit_ground.glsl"
[[maybe_unused]] constexpr auto kUnusedLight = &lit_ground;
}  // namespace shader

/// Ground of any slope and colour.
ShadingNodes rough_ground(const NodeRect& rect, unsigned seed) {
  ShadingNodes nodes;
  nodes.resize(rect);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> angle(0.0, 6.28318530717958648), steepness(0.0, 0.95);
  for (std::size_t k = 0; k < nodes.albedo.size(); ++k) {
    const double a = angle(random), s = steepness(random);
    const auto unorm = [](double x) {
      return static_cast<std::uint16_t>(std::lround((x * 0.5 + 0.5) * 65534.0));
    };
    nodes.normal[k] = {unorm(s * std::cos(a)), unorm(s * std::sin(a))};
    nodes.albedo[k] = glm::u8vec4(random() % 256, random() % 256, random() % 256, 0);
  }
  return nodes;
}

/// The normal that the codes stand for, in ECEF.
dvec3 normal_of(const globe::planet::Node& node, const glm::u16vec2& code) {
  const dvec3 u = globe::planet::node_direction(node);
  const dvec3 axis = globe::clipmap::shading_axis(node.d);
  const dvec3 t1 = glm::normalize(axis - u * glm::dot(u, axis));
  const glm::dvec2 slope = glm::dvec2(code) * (2.0 / 65534.0) - 1.0;
  return u * std::sqrt(1.0 - glm::dot(slope, slope)) + t1 * slope.x + glm::cross(u, t1) * slope.y;
}

constexpr double kSunlight = 1.3, kSkylight = 0.2;

/// Light that leaves a node by the formula of lit_ground.glsl, from the ground itself.
dvec3 true_light(const globe::planet::Node& node, const ShadingNodes& ground, std::size_t k,
                 const dvec3& sun) {
  const dvec3 n = normal_of(node, ground.normal[k]);
  const double up = glm::dot(n, globe::planet::node_direction(node));
  const dvec3 root = dvec3(glm::vec3(ground.albedo[k])) / 255.0;
  return root * root * (kSunlight * std::max(glm::dot(n, sun), 0.0) + kSkylight * (0.55 + 0.45 * up));
}

TEST(LitNodes, TakenApartGiveTheLightOfAlbedoAndSlopeOnEveryLevel) {
  double worst = 0;
  for (const int level : {3, 7, 9, 12, 17, 24}) {
    const int n = 1 << level;
    const int first = n > 64 ? n / 3 : 0;
    const NodeRect rect{first, std::min(first + 40, n), first / 2, std::min(first / 2 + 37, n)};
    const ShadingNodes ground = rough_ground(rect, static_cast<unsigned>(level));
    const dvec3 sun = glm::normalize(dvec3(0.3, 0.8, 0.35));
    const auto lit = lit_nodes({sun, false}, level, 0, rect, rect, ground);
    ASSERT_EQ(lit.size(), ground.albedo.size());
    for (std::size_t k = 0; k < lit.size(); ++k) {
      const auto width = static_cast<std::size_t>(rect.width());
      const globe::planet::Node node{0, level, rect.i0 + static_cast<int>(k % width),
                                     rect.j0 + static_cast<int>(k / width)};
      const dvec3 truth = true_light(node, ground, k, sun);
      const glm::vec3 seen =
          shader::ground_light(glm::vec4(lit[k]) / 255.0f, glm::vec3(float(kSunlight) * shader::kSunRange),
                               glm::vec3(float(kSkylight)));
      // In the screen's own scale, which is about a square root.
      for (int c = 0; c < 3; ++c)
        worst = std::max(worst, std::abs(std::sqrt(double(seen[c])) - std::sqrt(truth[c])));
    }
  }
  EXPECT_LE(worst, 1.5 / 255.0);
  EXPECT_GT(worst, 0.0);
}

TEST(LitNodes, DependOnTheNodeAndNotOnTheRectangleAskedFor) {
  const NodeRect rect{100, 180, 40, 90}, part{133, 150, 55, 61};
  const ShadingNodes ground = rough_ground(rect, 5);
  const Lighting light{glm::normalize(dvec3(1, 2, 3)), false};
  const auto all = lit_nodes(light, 10, 2, rect, rect, ground);
  const auto some = lit_nodes(light, 10, 2, part, rect, ground);
  std::size_t k = 0;
  for (int j = part.j0; j <= part.j1; ++j)
    for (int i = part.i0; i <= part.i1; ++i)
      ASSERT_EQ(some[k++], all[static_cast<std::size_t>((j - rect.j0) * rect.width() + i - rect.i0)]);
}

TEST(LitNodes, AgreeAcrossTheEdgeOfTwoDiamonds) {
  constexpr int kLevel = 9;
  const int n = 1 << kLevel;
  const NodeRect edge0{0, 0, 1, n - 1}, edge1{1, n - 1, 0, 0};  // (0, t) of diamond d is (t, 0) of d + 1
  ShadingNodes ground0 = rough_ground(edge0, 7), ground1 = ground0;
  for (int t = 1; t < n; ++t) {  // the same normals in the other diamond's frame
    const auto k = static_cast<std::size_t>(t - 1);
    const dvec3 normal = normal_of({0, kLevel, 0, t}, ground0.normal[k]);
    const dvec3 u = globe::planet::node_direction({1, kLevel, t, 0});
    const dvec3 axis = globe::clipmap::shading_axis(1);
    const dvec3 t1 = glm::normalize(axis - u * glm::dot(u, axis));
    const auto unorm = [](double x) {
      return static_cast<std::uint16_t>(std::lround((x * 0.5 + 0.5) * 65534.0));
    };
    ground1.normal[k] = {unorm(glm::dot(normal, t1)), unorm(glm::dot(normal, glm::cross(u, t1)))};
  }
  const Lighting light{glm::normalize(dvec3(-0.2, 1.0, 0.4)), false};
  const auto lit0 = lit_nodes(light, kLevel, 0, edge0, edge0, ground0);
  const auto lit1 = lit_nodes(light, kLevel, 1, edge1, edge1, ground1);
  ASSERT_EQ(lit0.size(), lit1.size());
  for (std::size_t k = 0; k < lit0.size(); ++k) {
    // The sun's code is a square root: near the shadow's edge one step of the slope's code is many of it.
    for (int c = 0; c < 3; ++c) ASSERT_LE(std::abs(lit0[k][c] - lit1[k][c]), 1);
    const double a = lit0[k].a / 255.0, b = lit1[k].a / 255.0;
    ASSERT_LE(std::abs(a * a - b * b), 0.01);
  }
}

TEST(UpdateLevel, LightsEverythingAnewWhenTheSunMovesAndLeavesTheVerticesAlone) {
  const auto surface = globe::planet::Surface::builtin(1);
  const auto settings = globe::clipmap::Settings::for_detail(16, 1);
  const auto region =
      globe::clipmap::make_region(settings, globe::clipmap::nadir(glm::normalize(dvec3(1, 1, 0.3)), 12));
  const Lighting noon{glm::normalize(dvec3(1, 1, 0.3)), false},
      evening{glm::normalize(dvec3(1, -1, 0.3)), false};
  const auto first = globe::clipmap::update_level(settings, *surface, region, noon, nullptr);
  const auto moved = globe::clipmap::update_level(settings, *surface, region, evening, first.data.get());
  const auto fresh = globe::clipmap::update_level(settings, *surface, region, evening, nullptr);
  EXPECT_TRUE(moved.vertex_blocks.empty());
  ASSERT_EQ(moved.shading_blocks.size(), fresh.shading_blocks.size());
  for (std::size_t k = 0; k < moved.shading_blocks.size(); ++k) {
    EXPECT_EQ(moved.shading_blocks[k].nodes, fresh.shading_blocks[k].nodes);
    EXPECT_EQ(moved.shading_blocks[k].lit, fresh.shading_blocks[k].lit);
    EXPECT_EQ(moved.shading_blocks[k].water, fresh.shading_blocks[k].water);
    EXPECT_NE(moved.shading_blocks[k].lit, first.shading_blocks[k].lit);
  }
}

}  // namespace
