#include "globe/planet/mean_height.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <vector>

#include "globe/geo/area.h"
#include "globe/planet/cell.h"
#include "tests/node_planet.h"
#include "tests/temporary_folder.h"

namespace globe::planet {
namespace {

TEST(LatticeTrixel, HasTheCornersAndChildrenOfItsCell) {
  for (int level = 0; level <= 4; ++level) {
    for (std::uint64_t id = htm::kFirstRoot << (2 * level); id < 16ULL << (2 * level); ++id) {
      const Cell cell = cell_from_trixel({id});
      const LatticeTrixel t = lattice_trixel(cell.d, level, cell.i, cell.j, cell.half);
      ASSERT_EQ((Cell{t.d, t.level, t.cell_i(), t.cell_j(), t.half()}), cell);
      const htm::Corners own = corners(t), named = htm::corners({id});
      ASSERT_TRUE(std::is_permutation(own.begin(), own.end(), named.begin())) << id;
      EXPECT_GT(glm::dot(own[0], glm::cross(own[1], own[2])), 0.0);
      const auto parts = children(t);
      const auto part_corners = children_corners(own);
      std::vector<std::uint64_t> ids;
      for (std::size_t k = 0; k < 4; ++k) {
        ASSERT_EQ(part_corners[k], corners(parts[k]));
        const LatticeTrixel& part = parts[k];
        ids.push_back(trixel_from_cell({part.d, part.level, part.cell_i(), part.cell_j(), part.half()}).id);
      }
      std::sort(ids.begin(), ids.end());
      EXPECT_EQ(ids, (std::vector<std::uint64_t>{4 * id, 4 * id + 1, 4 * id + 2, 4 * id + 3}));
    }
  }
}

/// The mean over a trixel by its definition: every trixel of the heights' level by its own area.
double true_mean(const geo::Ellipsoid& ellipsoid, int height_level, const tests::HeightOfNode& height,
                 const LatticeTrixel& t) {
  double area = 0, sum = 0;
  const std::function<void(const LatticeTrixel&)> add = [&](const LatticeTrixel& part) {
    if (part.level < height_level) {
      for (const LatticeTrixel& finer : children(part)) add(finer);
      return;
    }
    const double own = geo::surface_area(ellipsoid, corners(part));
    area += own;
    sum += own / 3 *
           (height({part.d, part.level, part.i, part.j}) +
            height({part.d, part.level, part.i + part.sign, part.j}) +
            height({part.d, part.level, part.i, part.j + part.sign}));
  };
  add(t);
  return sum / area;
}

double rounded(const tests::HeightOfNode& height, const Node& node) {
  return static_cast<double>(static_cast<float>(height(node)));
}

TEST(MeanHeight, OfTheStoredPyramidIsThatOfTheTrixelsUnderIt) {
  const auto exact = tests::hashed_heights(11, -9000, 9000);
  const tests::HeightOfNode height = [&](const Node& node) { return rounded(exact, node); };
  for (const int level : {0, 1, 3, 4, 7, 9}) {
    const tests::TemporaryFolder folder;
    const geo::Ellipsoid ellipsoid{6.4e6, 0.1};
    tests::write_node_planet(folder.path(), level, ellipsoid, height);
    const Dataset planet = Dataset::open(folder.path(), std::size_t{64} << 20);
    ASSERT_NE(planet.layer("height_mean"), nullptr);
    EXPECT_EQ(planet.layer("height_mean")->level, block_level(level));
    // Stated: 2e-5 of the range; and each level is rounded to float.
    const double tolerance = level <= 8 ? 2e-3 : 0.36;
    for (int k = std::max(0, level - 5); k <= block_level(level); ++k) {
      const int last = nodes_per_side(k) - 1;
      for (const int i : {0, last / 2, last}) {
        for (int half = 0; half < 2; ++half) {
          const LatticeTrixel t = lattice_trixel(i % 4, k, i, last - i / 2, half);
          std::array<float, 2> seen;
          planet.read("height_mean", t.d, k, t.cell_i(), t.cell_j(), 1, 1, seen.data());
          EXPECT_NEAR(seen[static_cast<std::size_t>(half)], true_mean(ellipsoid, level, height, t), tolerance)
              << level << ' ' << k << ' ' << i << ' ' << half;
        }
      }
    }
  }
}

TEST(MeanHeight, OfEqualHeightsIsThatHeightToTheLastBit) {
  const tests::TemporaryFolder folder;
  tests::write_node_planet(folder.path(), 6, geo::kWgs84, [](const Node&) { return 1234.567; });
  const Dataset planet = Dataset::open(folder.path(), std::size_t{64} << 20);
  for (int k = 0; k <= 3; ++k) {
    const int side = nodes_per_side(k) + 1;
    std::vector<float> means(static_cast<std::size_t>(2 * side * side));
    planet.read("height_mean", 2, k, 0, 0, side, side, means.data());
    for (const float mean : means) EXPECT_EQ(mean, 1234.567F);
  }
}

TEST(MeanHeight, CountingAllTrixelsAlikeWouldBeWrong) {
  // Negative control: a root's trixels differ in area by a factor of two, its poles are its small end.
  const tests::HeightOfNode height = [](const Node& node) {
    const double z = node_direction(node).z;
    return 9000 * z * z * z * z;
  };
  const LatticeTrixel root = lattice_trixel(0, 0, 0, 0, 0);
  double plain = 0;
  int count = 0;
  const std::function<void(const LatticeTrixel&)> add = [&](const LatticeTrixel& part) {
    if (part.level < 6) {
      for (const LatticeTrixel& finer : children(part)) add(finer);
      return;
    }
    plain += height({part.d, part.level, part.i, part.j});
    ++count;
  };
  add(root);
  EXPECT_GT(std::abs(plain / count - true_mean(geo::kMoon, 6, height, root)), 9000 * 1e-3);
}

}  // namespace
}  // namespace globe::planet
