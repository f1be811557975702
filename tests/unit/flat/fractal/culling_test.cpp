#include "flat/fractal/culling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "globe/render/camera.h"

namespace globe::flat::fractal {
namespace {

/// A number that counts what is done with it.
struct Counted {
  double value = 0;
  static inline int products = 0, sums = 0, comparisons = 0;

  friend Counted operator*(Counted a, Counted b) { return ++products, Counted{a.value * b.value}; }
  friend Counted operator+(Counted a, Counted b) { return ++sums, Counted{a.value + b.value}; }
  friend bool operator>(Counted a, Counted b) { return ++comparisons, a.value > b.value; }
};

TEST(FractalCulling, ABoxAndAPlaneTakeSixProductsSixSumsAndFiveComparisons) {
  const Plane<Counted> plane{{1}, {-2}, {3}, {-0.5}};
  EXPECT_EQ(side_of(plane, Box<Counted>{{{{-1}, {-1}, {-1}}}, {{{1}, {1}, {1}}}}), Side::kCut);
  EXPECT_EQ(Counted::products, 6);
  EXPECT_EQ(Counted::sums, 6);
  EXPECT_EQ(Counted::comparisons, 5);
}

TEST(FractalCulling, TwoCornersSayWhatAllEightSay) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int seen[3] = {};
  for (int trial = 0; trial < 20000; ++trial) {
    const Plane<double> plane{unit(random), unit(random), unit(random), unit(random)};
    Box<double> box;
    for (std::size_t k = 0; k < 3; ++k) {
      const double a = unit(random), b = unit(random);
      box.low[k] = std::min(a, b);
      box.high[k] = std::max(a, b);
    }
    int outside = 0;
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto c = [&](unsigned k) { return (corner >> k & 1u) ? box.high[k] : box.low[k]; };
      outside += plane.a * c(0) + plane.b * c(1) + plane.c * c(2) + plane.d > 0.0;
    }
    const Side expected = outside == 8 ? Side::kOutside : outside == 0 ? Side::kInside : Side::kCut;
    ASSERT_EQ(side_of(plane, box), expected);
    ++seen[static_cast<int>(expected)];
  }
  for (const int count : seen) EXPECT_GT(count, 1000);
}

struct World {
  static constexpr int kLog2Side = 4, kSide = 16;
  HeightTree tree{kLog2Side};
  std::vector<HeightTree::Range> ranges;

  explicit World(std::mt19937& random) {
    std::uniform_real_distribution<float> height(-300.0f, 900.0f);
    for (int k = 0; k < kSide * kSide; ++k) {
      const float a = height(random), b = height(random);
      ranges.push_back({std::min(a, b), std::max(a, b)});
    }
    tree.update([&](int column, int row) { return ranges[static_cast<std::size_t>(row * kSide + column)]; });
  }
};

render::Camera camera_towards(double heading, double pitch, double fov) {
  render::Camera camera;
  const double c = std::cos(pitch);
  camera.forward = {c * std::sin(heading), c * std::cos(heading), std::sin(pitch)};
  camera.right = {std::cos(heading), -std::sin(heading), 0.0};
  camera.up = glm::cross(camera.right, camera.forward);
  camera.fov_y_deg = fov;
  return camera;
}

TEST(FractalCulling, NothingInViewIsLeftOutAndTheTreeKeepsWhatEveryBoxAloneWould) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const World world(random);
  constexpr double kBlock = 500.0;
  std::size_t kept = 0;
  std::uint64_t planes = 0;
  constexpr int kTrials = 1000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const render::Camera camera =
        camera_towards(6.28 * unit(random), 3.0 * unit(random) - 1.5, 10.0 + 100.0 * unit(random));
    const glm::dmat4 clip = render::clip_from_relative(camera, 0.1);
    const View view = view_of(clip);
    const std::array<double, 3> origin{-9000.0 * unit(random), -9000.0 * unit(random),
                                       -2000.0 * unit(random)};
    std::vector<int> visible;
    planes += world.tree.visible(view, origin, kBlock, visible).planes;
    std::vector<bool> is_kept(world.ranges.size());
    for (const int block : visible) is_kept[static_cast<std::size_t>(block)] = true;
    kept += visible.size();
    for (int block = 0; block < World::kSide * World::kSide; ++block) {
      const HeightTree::Range& range = world.ranges[static_cast<std::size_t>(block)];
      const double west = origin[0] + (block % World::kSide) * kBlock;
      const double south = origin[1] + (block / World::kSide) * kBlock;
      const Box<double> box{{west, south, origin[2] + double(range.low)},
                            {west + kBlock, south + kBlock, origin[2] + double(range.high)}};
      const bool out = std::any_of(view.begin(), view.end(), [&](const Plane<double>& plane) {
        return side_of(plane, box) == Side::kOutside;
      });
      ASSERT_EQ(is_kept[static_cast<std::size_t>(block)], !out);
      // Any point of the box that is in the picture.
      const glm::dvec4 at = clip * glm::dvec4(west + kBlock * unit(random), south + kBlock * unit(random),
                                              box.low[2] + (box.high[2] - box.low[2]) * unit(random), 1.0);
      if (at.w > 0 && std::abs(at.x) < at.w && std::abs(at.y) < at.w) {
        ASSERT_TRUE(is_kept[static_cast<std::size_t>(block)]);
      }
    }
  }
  EXPECT_LT(kept, std::size_t{kTrials} * World::kSide * World::kSide / 2);
  // One by one it would be up to five planes a box.
  EXPECT_LT(planes, std::uint64_t{kTrials} * World::kSide * World::kSide);
}

TEST(FractalCulling, BlocksComeNearestFirst) {
  std::mt19937 random(5);
  const World world(random);
  const View all{};  // planes 0 x + 0 y + 0 z + 0: nothing is outside
  std::vector<int> visible;
  // The eye over the middle of block (11, 2).
  world.tree.visible(all, {-11.5, -2.5, 0.0}, 1.0, visible);
  ASSERT_EQ(visible.size(), 256u);
  EXPECT_EQ(visible.front(), 2 * World::kSide + 11);
  // A block never comes before all of the three that lie between it and the eye's quarter.
  std::vector<int> place(256);
  for (int k = 0; k < 256; ++k) place[static_cast<std::size_t>(visible[static_cast<std::size_t>(k)])] = k;
  for (int column = 12; column < World::kSide - 1; ++column)
    EXPECT_LT(place[static_cast<std::size_t>(2 * World::kSide + column)],
              place[static_cast<std::size_t>(2 * World::kSide + column + 1)]);
}

}  // namespace
}  // namespace globe::flat::fractal
