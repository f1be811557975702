#include "flat/levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include "globe/render/camera.h"
#include "tests/hard/table.h"
#include "tests/unit/flat/mesh.h"
#include "tests/unit/flat/rough_ground.h"

namespace {

using namespace globe::flat;

TEST(Levels, TheErrorOfALevelIsTheFarthestPostFromItsMesh) {
  const auto terrain = rough_terrain(1, 1);
  // The middle of a patch's only cell, level 4, on the diagonal from south-west to north-east.
  double worst = 0.0;
  for (int j = 0; j <= 16; ++j) {
    for (int i = 0; i <= 16; ++i) {
      const double u = i / 16.0, v = j / 16.0;
      const double sw = terrain->z(0, 0), se = terrain->z(16, 0), nw = terrain->z(0, 16),
                   ne = terrain->z(16, 16);
      const double mesh = u >= v ? sw + u * (se - sw) + v * (ne - se) : sw + v * (nw - sw) + u * (ne - nw);
      worst = std::max(worst, std::abs(mesh - static_cast<double>(terrain->z(i, j))));
    }
  }
  double known = 0.0;
  for (const LevelErrors& errors : terrain->patch(0).errors_m) {
    EXPECT_EQ(errors[0], 0.0f);
    for (std::size_t level = 1; level < kLevels; ++level) EXPECT_GE(errors[level], errors[level - 1]);
    known = std::max(known, static_cast<double>(errors[4]));
  }
  EXPECT_GE(known * 1.000001, worst);
}

TEST(Levels, TheLevelIsTheCoarsestUnderTheBoundAndGrowsSteadilyWithIt) {
  const std::array<float, kLevels> errors{0.0f, 0.5f, 0.5f, 3.0f, 20.0f};
  float before = 0.0f;
  for (double allowed = 0.0; allowed < 25.0; allowed += 1e-3) {
    const float level = level_for(errors, allowed);
    EXPECT_GE(level, before);
    EXPECT_LE(level - before, before < 2.0f ? 2.01f : 0.01f)
        << allowed;  // levels of equal errors are passed over
    const auto whole = static_cast<std::size_t>(level);
    const float share = level - static_cast<float>(whole);
    const float error =
        share > 0.0f ? errors[whole] + share * (errors[whole + 1] - errors[whole]) : errors[whole];
    EXPECT_LE(static_cast<double>(error), allowed + 1e-6);
    before = level;
  }
  EXPECT_EQ(before, 4.0f);
  EXPECT_EQ(level_for({}, 0.0), 4.0f);  // level ground
}

TEST(Levels, NoPatchIsMoreThanOneLevelAboveANeighbourAndNoneIsLoweredInVain) {
  std::mt19937 random(5);
  std::uniform_int_distribution<int> any(0, 4096);
  for (int round = 0; round < 50; ++round) {
    const int east = 1 + round % 7, north = 1 + round % 5;
    std::vector<float> levels(static_cast<std::size_t>(east * north));
    for (float& level : levels) level = static_cast<float>(any(random)) * kLevelStep;
    const std::vector<float> wanted = levels;
    limit_steps(levels, east, north);
    for (int j = 0; j < north; ++j) {
      for (int i = 0; i < east; ++i) {
        float highest = 1e9f;
        for (int q = 0; q < north; ++q) {
          for (int p = 0; p < east; ++p)
            highest = std::min(highest, wanted[static_cast<std::size_t>(q * east + p)] +
                                            static_cast<float>(std::abs(p - i) + std::abs(q - j)));
        }
        EXPECT_EQ(levels[static_cast<std::size_t>(j * east + i)], highest);
      }
    }
  }
}

/// HARD-CASES H11: what the bound says a patch is off by on the screen, against what its vertices are.
TEST(Levels, NoErrorOnTheScreenIsAboveWhatTheBoundTakesItFor) {
  const auto terrain = rough_terrain(6, 6);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  constexpr int kHeight = 720;
  double said = 0.0, seen = 0.0;
  int patches = 0;
  for (int round = 0; round < (hard::full() ? 90'000 : 300); ++round) {
    globe::render::Camera camera;
    const double x = (share(random) - 0.5) * 4000.0, y = (share(random) - 0.5) * 4000.0;
    const glm::dvec3 eye(x, y, terrain->z_at(x, y) + 2.0 + 1500.0 * share(random) * share(random));
    const double heading = 6.28 * share(random), pitch = -0.6 * share(random);
    camera.forward = {std::cos(heading) * std::cos(pitch), std::sin(heading) * std::cos(pitch),
                      std::sin(pitch)};
    camera.right = glm::normalize(glm::cross(camera.forward, glm::dvec3(0, 0, 1)));
    camera.up = glm::cross(camera.right, camera.forward);
    const ErrorBound bound = error_bound(1.0, camera.fov_y_deg, camera.aspect, kHeight, camera.forward);
    const auto pixel = [&](const glm::dvec3& at) {
      const glm::dvec3 d = at - eye;
      const double depth = glm::dot(d, camera.forward);
      return depth > 0.0 ? glm::dvec2(glm::dot(d, camera.right), glm::dot(d, camera.up)) / depth *
                               (0.5 * kHeight / camera.tan_y())
                         : glm::dvec2(1e9);
    };
    for (std::size_t k = 0; k < terrain->patch_count(); ++k) {
      const int level = 1 + static_cast<int>(3.99 * share(random));
      const int column = static_cast<int>(k % 6) * 16, row = static_cast<int>(k / 6) * 16, step = 1 << level;
      const double predicted = pixels_off(*terrain, k, eye, bound)[static_cast<std::size_t>(level)];
      double worst = -1.0;
      for (int j = 0; j <= 16; ++j) {
        for (int i = 0; i <= 16; ++i) {
          const int ci = std::min(i / step, 16 / step - 1), cj = std::min(j / step, 16 / step - 1);
          const auto z = [&](int di, int dj) {
            return static_cast<double>(terrain->z(column + (ci + di) * step, row + (cj + dj) * step));
          };
          const double mesh =
              in_cell({z(0, 0), z(1, 0), z(0, 1), z(1, 1)}, splits_north_east(ci, cj),
                      static_cast<double>(i - ci * step) / step, static_cast<double>(j - cj * step) / step);
          const glm::dvec2 true_at = pixel({terrain->x_m(column + i), terrain->y_m(row + j),
                                            static_cast<double>(terrain->z(column + i, row + j))});
          const glm::dvec2 mesh_at = pixel({terrain->x_m(column + i), terrain->y_m(row + j), mesh});
          const auto in_picture = [](const glm::dvec2& p) {
            return std::abs(p.y) <= kHeight / 2.0 && std::abs(p.x) <= kHeight / 2.0 * 16.0 / 9.0;
          };
          if (in_picture(true_at) && in_picture(mesh_at))
            worst = std::max(worst, glm::distance(true_at, mesh_at));
        }
      }
      if (worst < 0.0 || predicted > 1e6) continue;
      EXPECT_LE(worst, predicted) << "level " << level;
      said += std::log(predicted);
      seen += std::log(std::max(worst, 1e-9));
      ++patches;
    }
  }
  ASSERT_GT(patches, 1000);
  const double ratio = std::exp((said - seen) / patches);
  hard::report("H11", "error of a level said over seen, mean of " + std::to_string(patches) + " patches", "3",
               hard::figure(ratio));
  EXPECT_LT(ratio, 3.0);
}

/// The whole of it: real-valued levels, sides that adapt and all.
TEST(Levels, NothingThatIsDrawnIsFartherOffOnTheScreenThanAskedFor) {
  const auto terrain = rough_terrain(6, 6);
  std::mt19937 random(31);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  constexpr int kHeight = 720;
  const int columns = terrain->posts().columns, rows = terrain->posts().rows;
  double farthest = 0.0;
  int coarse = 0;
  for (int round = 0; round < 40; ++round) {
    const double x = (share(random) - 0.5) * 4000.0, y = (share(random) - 0.5) * 4000.0;
    const glm::dvec3 eye(x, y, terrain->z_at(x, y) + 5.0 + 3000.0 * share(random) * share(random));
    const ErrorBound bound = error_bound(8.0, 60.0, 16.0 / 9.0, kHeight, glm::dvec3(0.0));
    const std::vector<float> levels = patch_levels(*terrain, eye, bound, Morph::kGpu);
    coarse += static_cast<int>(std::count_if(levels.begin(), levels.end(), [](float l) { return l > 0.5f; }));
    const std::vector<double> drawn = surface_of(mesh_of(*terrain, levels), columns, rows);
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const glm::dvec3 there(terrain->x_m(column), terrain->y_m(row), terrain->z(column, row));
        const double z = drawn[static_cast<std::size_t>(2 * row * (2 * columns - 1) + 2 * column)];
        // The angle between where the post is and where it is drawn, in the widest pixels of the picture.
        const glm::dvec3 a = glm::normalize(there - eye),
                         b = glm::normalize(glm::dvec3(there.x, there.y, z) - eye);
        const double angle = std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
        farthest = std::max(farthest, std::tan(std::min(angle, 1.5)) * bound.pixels_at_1m);
      }
    }
  }
  EXPECT_GT(coarse, 200);
  RecordProperty("farthest_px", std::to_string(farthest));
  EXPECT_LE(farthest, 8.0 * 1.05);  // beside a coarser side a little of its error comes along
}

}  // namespace
