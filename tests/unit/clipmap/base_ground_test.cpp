#include <gtest/gtest.h>

#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>

#include "globe/clipmap/shading_nodes.h"
#include "globe/clipmap/stream.h"
#include "globe/planet/grid.h"
#include "globe/planet/surface.h"
#include "globe/planet/synthesis.h"

namespace {

using globe::clipmap::Settings;
using globe::planet::Surface;

Settings small() {
  Settings settings;
  settings.s = 16;
  settings.base_level = 4;
  settings.shading_levels = 5;  // to level 10, which the built-in planet has no function of its own for
  return settings;
}

TEST(BaseGround, IsAllThatABaseLevelIsShadedBy) {
  const Settings settings = small();
  const int level = settings.base_level + settings.shading_levels_at(settings.base_level);
  const auto surface = Surface::builtin(5, std::size_t{1} << 30);
  globe::clipmap::make_base_ground(settings, *surface);
  const auto fresh = Surface::builtin(5);
  std::mt19937 random(7);
  std::normal_distribution<double> axis;
  for (int k = 0; k < 50; ++k) {
    const glm::dvec3 u = glm::normalize(glm::dvec3(axis(random), axis(random), axis(random)));
    EXPECT_EQ(surface->height_at_hand(u, level), fresh->height(u, level));
  }
}

/// At a detail of 1024 it is 65,536 tiles: made for a cache that forgets them, they would be made twice.
TEST(BaseGround, IsNotMadeForACacheThatDoesNotHoldIt) {
  const Settings settings = small();
  const auto surface = Surface::builtin(5, std::size_t{1} << 16);
  globe::clipmap::make_base_ground(settings, *surface);
  const glm::dvec3 far_from_the_first_tile = glm::normalize(glm::dvec3(-0.3, -0.4, -0.5));
  const auto fresh = Surface::builtin(5);
  const int level = settings.base_level + settings.shading_levels_at(settings.base_level);
  EXPECT_EQ(surface->height_at_hand(far_from_the_first_tile, level),
            fresh->height(far_from_the_first_tile, globe::planet::kBuiltinLevel));
}

/// Made on many threads at once it is what it is made of one node at a time.
TEST(BaseGround, IsShadedTheSameInOneGoAndInParts) {
  const Settings settings = small();
  const auto surface = Surface::builtin(5);
  const int level = settings.base_level + 3;
  const int n = globe::planet::nodes_per_side(level);
  const auto whole = globe::clipmap::make_shading_nodes(*surface, level, 1, {0, n, 0, n}, nullptr);
  for (const auto& part :
       {globe::clipmap::NodeRect{0, n, 64, 64}, {64, 64, 3, 70}, {100, n, 60, n}, {7, 7, 9, 9}}) {
    const auto alone = globe::clipmap::make_shading_nodes(*surface, level, 1, part, nullptr);
    for (int j = part.j0; j <= part.j1; ++j) {
      for (int i = part.i0; i <= part.i1; ++i) {
        const auto own = static_cast<std::size_t>((j - part.j0) * part.width() + (i - part.i0));
        const auto there = static_cast<std::size_t>(j * (n + 1) + i);
        ASSERT_EQ(alone.normal[own], whole.normal[there]) << i << "," << j;
        ASSERT_EQ(alone.albedo[own], whole.albedo[there]) << i << "," << j;
      }
    }
  }
}

}  // namespace
