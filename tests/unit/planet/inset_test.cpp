#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <random>
#include <string>
#include <vector>

#include "globe/base/error.h"
#include "globe/planet/inset_stack.h"
#include "globe/planet/planet_file.h"
#include "globe/planet/subdivision.h"
#include "tests/node_planet.h"
#include "tests/temporary_folder.h"

namespace globe::planet {
namespace {

using tests::RoundInset;
using tests::TemporaryFolder;

constexpr int kBaseLevel = 6;
constexpr int kInsetLevel = 9;

/// Rolling hills of the base.
double base_height(const Node& node) {
  const dvec3 u = node_direction(node);
  return static_cast<double>(
      static_cast<float>(900.0 + 500.0 * std::sin(9.0 * u.x + 1.0) * std::sin(8.0 * u.y + 7.0 * u.z)));
}

/// What an inset has measured: other hills, finer ones, and higher.
double inset_height(const Node& node) {
  const dvec3 u = node_direction(node);
  return static_cast<double>(
      static_cast<float>(2500.0 + 200.0 * std::sin(60.0 * u.x) * std::cos(50.0 * u.y + 40.0 * u.z)));
}

RoundInset inset_at(const dvec3& centre, const std::string& name = "hill") {
  return {name, kInsetLevel, centre, 0.08, 0.16, inset_height};
}

dvec3 at_degrees(double lat, double lon) { return geo::normal_from_degrees(lat, lon); }

/// Places where the grid has its seams, and one where it has none.
struct Spot {
  const char* name;
  dvec3 centre;
};
const std::vector<Spot> kSpots{
    {"InsideADiamond", {0.5, 0.6, 0.4}},       {"NorthPole", {0.01, 0.0, 1.0}},
    {"SouthPole", {0.0, 0.02, -1.0}},          {"Antimeridian", at_degrees(17.0, 180.0)},
    {"DiamondEdge", at_degrees(-40.0, 90.0)},  {"Equator", at_degrees(0.5, 40.0)},
    {"OctahedronCorner", at_degrees(0.3, 0.2)}};

class InsetAt : public testing::TestWithParam<Spot> {
 protected:
  static void SetUpTestSuite() {
    base_folder_ = std::make_unique<TemporaryFolder>();
    make_base(*base_folder_ / "planet");
    base_ = tests::open_surface(*base_folder_ / "planet");
  }
  static void TearDownTestSuite() {
    base_.reset();
    base_folder_.reset();
  }
  static void make_base(const std::filesystem::path& folder) {
    tests::write_node_planet(folder, kBaseLevel, geo::kWgs84, base_height);
  }

  void SetUp() override {
    inset_ = inset_at(GetParam().centre);
    std::filesystem::copy(*base_folder_ / "planet", scratch_ / "planet");
    tests::add_inset(scratch_ / "planet", inset_);
    surface_ = tests::open_surface(scratch_ / "planet");
  }

  /// Nodes of a level within a chord of the centre, every `step`th.
  std::vector<Node> nodes_near(int level, double chord, int step) const {
    const dvec3 centre = glm::normalize(inset_.centre);
    const int n = nodes_per_side(level);
    const int reach = static_cast<int>(chord * n * 1.3) + 2;
    std::vector<Node> found;
    const Place place = locate(centre, level);
    for (int dj = -reach; dj <= reach; dj += step) {
      for (int di = -reach; di <= reach; di += step) {
        const Node node =
            fold({place.d, level, static_cast<int>(place.ij.x) + di, static_cast<int>(place.ij.y) + dj});
        if (glm::distance(node_direction(node), centre) < chord) found.push_back(node);
      }
    }
    return found;
  }

  static std::unique_ptr<TemporaryFolder> base_folder_;
  static std::shared_ptr<const Surface> base_;  ///< without the inset
  TemporaryFolder scratch_;
  RoundInset inset_;
  std::shared_ptr<const Surface> surface_;
};
std::unique_ptr<TemporaryFolder> InsetAt::base_folder_;
std::shared_ptr<const Surface> InsetAt::base_;

TEST_P(InsetAt, IsTheDataWhereItsWeightIsOneAndTheBaseWhereItIsZero) {
  std::size_t inside = 0, outside = 0;
  for (const int level : {4, kBaseLevel, 7, kInsetLevel}) {
    for (const Node& node : nodes_near(level, 0.25, level < 8 ? 1 : 5)) {
      const double w = inset_.weight(node);
      if (w == 1.0) {
        ASSERT_EQ(surface_->height(node), inset_height(node)) << level;
        ++inside;
      } else if (w == 0.0) {
        ASSERT_EQ(surface_->height(node), base_->height(node)) << level;
        ++outside;
      } else {
        const double base = base_->height(node);
        const double blend = base + static_cast<double>(static_cast<float>(w)) * (inset_height(node) - base);
        ASSERT_NEAR(surface_->height(node), blend, 1e-9) << level;
      }
    }
  }
  EXPECT_GT(inside, 100U);
  EXPECT_GT(outside, 100U);
}

TEST_P(InsetAt, LeavesTheSynthesisedBaseAsItIsBitForBit) {
  std::size_t count = 0;
  for (const int level : {8, 11}) {
    for (const Node& node : nodes_near(level, 0.25, level == 8 ? 3 : 29)) {
      if (glm::distance(node_direction(node), glm::normalize(inset_.centre)) < 0.16 + 0.04) continue;
      ASSERT_EQ(surface_->height(node), base_->height(node)) << level;
      ++count;
    }
  }
  EXPECT_GT(count, 50U);
}

TEST_P(InsetAt, HasOneHeightForANodeByAnyNameFromAnyTileAtAnyLevel) {
  for (const int level : {5, 7, 9, 10}) {
    for (const Node& node : nodes_near(level, 0.2, level <= 7 ? 3 : 29)) {
      const double height = surface_->height(node);
      const Names all = names(node);
      for (int k = 0; k < all.count; ++k)
        ASSERT_EQ(surface_->height(all.node[static_cast<std::size_t>(k)]), height);
      const Node finer{node.d, node.level + 2, node.i << 2, node.j << 2};
      ASSERT_EQ(surface_->height(finer), height) << "level " << level;
      ASSERT_EQ(surface_->data_height(finer), surface_->data_height(node));
    }
  }
}

TEST_P(InsetAt, HasTheSameGuardAsTheNeighbouringTileHasNodes) {
  for (const int level : {7, 9, 11}) {
    const Place place = locate(inset_.centre, level);
    const Node middle{place.d, level, static_cast<int>(place.ij.x), static_cast<int>(place.ij.y)};
    for (const int away : {0, 1, 2}) {  // in the middle, on the way out, in the rim
      const Node at = fold({middle.d, level, middle.i + away * (nodes_per_side(level) / 32), middle.j});
      const auto tile = surface_->tile(tile_of(at));
      for_each_node(tile->id, kTileGuard, [&](int i, int j, const Node& node) {
        if (i % 5 != 0 && j % 7 != 0) return;
        ASSERT_EQ(tile->height.at(i, j), surface_->height(node));
      });
    }
  }
}

/// Largest first and second differences between neighbours, over nodes in the rim.
struct Steps {
  double first = 0, second = 0;
};
template <typename HeightOf>
Steps steps_of(const std::vector<Node>& nodes, const HeightOf& height) {
  Steps steps;
  for (const Node& node : nodes) {
    if (is_corner(node)) continue;
    const double own = height(node);
    for (const ivec2 step : {ivec2{1, 0}, ivec2{0, 1}, ivec2{-1, 1}}) {
      const double a = height(fold({node.d, node.level, node.i + step.x, node.j + step.y}));
      const double b = height(fold({node.d, node.level, node.i - step.x, node.j - step.y}));
      steps.first = std::max({steps.first, std::abs(a - own), std::abs(b - own)});
      steps.second = std::max(steps.second, std::abs(a + b - 2.0 * own));
    }
  }
  return steps;
}

TEST_P(InsetAt, RimHasNoStepInHeightOrSlope) {
  for (const int level : {9, 11, 12}) {
    std::vector<Node> rim;
    for (const Node& node : nodes_near(level, 0.17, level == 9 ? 1 : 23)) {
      if (glm::distance(node_direction(node), glm::normalize(inset_.centre)) > 0.07) rim.push_back(node);
    }
    ASSERT_GT(rim.size(), 50U);
    const double edge = 2.0 / nodes_per_side(level);  // chords; the longest edge there is
    const double share = edge / 0.08;                 // of the rim's width
    constexpr double kApart = 2600.0;                 // between base and inset, metres
    const Steps base = steps_of(rim, [&](const Node& node) { return base_->height(node); });
    const Steps seen = steps_of(rim, [&](const Node& node) { return surface_->height(node); });
    // Smooth blend: w' <= 1.5 / width, w'' <= 6 / width^2. The inset alone rises 80 x 200 m a radian at most.
    const double inset_first = 200.0 * 90.0 * edge, inset_second = 200.0 * 8100.0 * edge * edge;
    const double detail = 25.0;  // metres: synthesised below the inset's own data
    EXPECT_LT(seen.first, base.first + inset_first + 1.5 * share * kApart + detail) << level;
    EXPECT_LT(seen.second, base.second + inset_second + 6.0 * share * share * kApart +
                               3.0 * share * (base.first + inset_first) + 2.0 * detail)
        << level;
  }
}

TEST_P(InsetAt, RimOfOneNodeFoldsTheGround) {
  // What the test above would see without a blend.
  TemporaryFolder hard;
  make_base(hard / "planet");
  RoundInset inset = inset_;
  inset.inner = inset.outer - 1e-6;
  tests::add_inset(hard / "planet", inset);
  const auto surface = tests::open_surface(hard / "planet");
  std::vector<Node> rim = nodes_near(kInsetLevel, 0.17, 1);
  std::erase_if(rim, [&](const Node& node) {
    return glm::distance(node_direction(node), glm::normalize(inset_.centre)) < 0.15;
  });
  EXPECT_GT(steps_of(rim, [&](const Node& node) { return surface->height(node); }).second, 1000.0);
}

TEST_P(InsetAt, ItsOwnGroundGoesOnBelowItsData) {
  // In the middle nothing of the base is left: the ground there depends on the inset's samples alone.
  TemporaryFolder other;
  tests::write_node_planet(other / "planet", kBaseLevel, geo::kWgs84,
                           [](const Node& node) { return base_height(node) * -0.5 + 77.0; });
  tests::add_inset(other / "planet", inset_);
  const auto elsewhere = tests::open_surface(other / "planet");
  double unlike_linear = 0.0;
  for (const Node& node : nodes_near(12, 0.05, 41)) {
    ASSERT_EQ(surface_->height(node), elsewhere->height(node));
    unlike_linear = std::max(unlike_linear, std::abs(surface_->height(node) - surface_->data_height(node)));
  }
  EXPECT_GT(unlike_linear, 0.0);
}

TEST_P(InsetAt, TellsTheDataOfAPlace) {
  const dvec3 centre = glm::normalize(inset_.centre);
  const DataSource inside = surface_->data_at(centre);
  EXPECT_EQ(inside.level, kInsetLevel);
  EXPECT_EQ(inside.inset, "hill");
  EXPECT_TRUE(inside.inset_alone);
  const dvec3 aside = glm::normalize(glm::cross(centre, dvec3(0.3, -0.5, 0.8)));
  const DataSource rim = surface_->data_at(glm::normalize(centre + 0.12 * aside));
  EXPECT_EQ(rim.level, kInsetLevel);
  EXPECT_FALSE(rim.inset_alone);
  const DataSource outside = surface_->data_at(glm::normalize(centre + 0.3 * aside));
  EXPECT_EQ(outside.level, kBaseLevel);
  EXPECT_EQ(outside.inset, "");
  EXPECT_EQ(surface_->finest_data_level(), kInsetLevel);
}

TEST_P(InsetAt, ShadesCoarserLevelsWithFilteredHeights) {
  const Place place = locate(inset_.centre, 7);
  const auto tile =
      surface_->tile(tile_of({place.d, 7, static_cast<int>(place.ij.x), static_cast<int>(place.ij.y)}));
  ASSERT_TRUE(tile->relief.has_value());
  const Node node{place.d, 7, static_cast<int>(place.ij.x), static_cast<int>(place.ij.y)};
  ASSERT_EQ(inset_.weight(node), 1.0);
  double apart = 0.0;
  for (std::size_t k = 0; k < tile->height.values.size(); ++k)
    apart = std::max(apart, std::abs(tile->relief->values[k] - tile->height.values[k]));
  EXPECT_GT(apart, 1.0);
  EXPECT_NEAR(tile->relief->at(node.i, node.j), 2500.0, 200.0);
}

INSTANTIATE_TEST_SUITE_P(Spots, InsetAt, testing::ValuesIn(kSpots),
                         [](const auto& spot) { return std::string(spot.param.name); });

class InsetFolder : public testing::Test {
 protected:
  InsetFolder() { tests::write_node_planet(folder_, kBaseLevel, geo::kWgs84, base_height); }

  TemporaryFolder scratch_;
  std::filesystem::path folder_ = scratch_ / "planet";
};

TEST_F(InsetFolder, LaterInsetsLieOverEarlierOnes) {
  const auto level_ground = [](double height_m) { return [=](const Node&) { return height_m; }; };
  const dvec3 a{0.5, 0.6, 0.4}, b{0.6, 0.5, 0.4};
  tests::add_inset(folder_, {"low", 8, a, 0.08, 0.16, level_ground(100.0)});
  tests::add_inset(folder_, {"high", 9, b, 0.08, 0.16, level_ground(4000.0)});
  const auto surface = tests::open_surface(folder_);
  const auto node_at = [](const dvec3& u, int level) {
    const Place place = locate(glm::normalize(u), level);
    return Node{place.d, level, static_cast<int>(place.ij.x), static_cast<int>(place.ij.y)};
  };
  for (const int level : {6, 8, 9, 12})
    EXPECT_NEAR(surface->height(node_at(b, level)), 4000.0, 10.0) << level;
  EXPECT_EQ(surface->data_at(glm::normalize(b)).inset, "high");
  // Beyond the upper one's rim only the lower shows.
  const dvec3 beyond = glm::normalize(a) - 0.05 * glm::normalize(glm::normalize(b) - glm::normalize(a));
  EXPECT_EQ(surface->data_at(glm::normalize(beyond)).inset, "low");
  EXPECT_EQ(surface->data_at(glm::normalize(beyond)).level, 8);
  EXPECT_NEAR(surface->height(node_at(beyond, 8)), 100.0, 1e-9);
}

TEST_F(InsetFolder, AFinerInsetUnderACoarserOneThatHidesItIsNotSeen) {
  const auto level_ground = [](double height_m) { return [=](const Node&) { return height_m; }; };
  const dvec3 at{0.5, 0.6, 0.4};
  tests::add_inset(folder_, {"fine", 10, at, 0.02, 0.03, level_ground(100.0)});
  tests::add_inset(folder_, {"coarse", 7, at, 0.10, 0.16, level_ground(3000.0)});
  const auto surface = tests::open_surface(folder_);
  const DataSource data = surface->data_at(glm::normalize(at));
  EXPECT_EQ(data.inset, "coarse");
  EXPECT_EQ(data.level, 7);
  const Place place = locate(at, 10);
  EXPECT_NEAR(surface->height(Node{place.d, 10, static_cast<int>(place.ij.x), static_cast<int>(place.ij.y)}),
              3000.0, 30.0);
}

TEST_F(InsetFolder, IsOfVersionTwoOnlyWithInsets) {
  const auto text = [&] {
    std::ifstream file(folder_ / kPlanetFileName);
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  EXPECT_NE(text().find("\"version\": 1"), std::string::npos);
  tests::add_inset(folder_, inset_at({0.5, 0.6, 0.4}));
  EXPECT_NE(text().find("\"version\": 2"), std::string::npos);
  const PlanetFile file = read_planet_file(folder_);
  ASSERT_EQ(file.insets.size(), 1U);
  EXPECT_EQ(file.insets[0].info, file.info.insets[0]);
  EXPECT_EQ(file.insets[0].info.name, "hill");
}

TEST_F(InsetFolder, AFlippedBitInAnInsetIsFound) {
  tests::add_inset(folder_, inset_at({0.5, 0.6, 0.4}));
  EXPECT_TRUE(find_damage(folder_).empty());
  const PlanetFile planet = read_planet_file(folder_);
  for (const StoredFile& file : planet.insets[0].files[0]) {
    std::fstream stream(folder_ / file.name, std::ios::in | std::ios::out | std::ios::binary);
    stream.seekg(static_cast<std::streamoff>(file.bytes / 2));
    const auto byte = static_cast<char>(stream.get() ^ 4);
    stream.seekp(static_cast<std::streamoff>(file.bytes / 2));
    stream.put(byte);
  }
  EXPECT_EQ(find_damage(folder_).size(), 3U);
}

TEST_F(InsetFolder, AMissingOrCutFileIsRefusedAtTheDoor) {
  tests::add_inset(folder_, inset_at({0.5, 0.6, 0.4}));
  const std::filesystem::path path = folder_ / read_planet_file(folder_).insets[0].files[0][1].name;
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 1);
  EXPECT_THROW(Dataset::open(folder_, 0), Error);
  std::filesystem::remove(path);
  EXPECT_THROW(Dataset::open(folder_, 0), Error);
}

TEST_F(InsetFolder, TheSameInsetGivesTheSameFiles) {
  const auto samples = tests::samples_of(inset_at({0.0, 0.1, 1.0}));
  const auto once = converters::write_inset(folder_, "a", "height", samples, 128);
  const auto twice = converters::write_inset(folder_, "a", "height", samples, 128);
  EXPECT_EQ(once.stored, twice.stored);
  EXPECT_EQ(once.made.size(), 12U);
  EXPECT_TRUE(twice.made.empty());
}

TEST(Insets, AnyNodeInAnyRimLiesBetweenItsGroundsAndHasOneHeight) {
  std::mt19937 random(20261124);
  const auto number = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high - 1)(random);
  };
  const int rounds = std::getenv("GLOBE_TEST_FULL") != nullptr ? 200 : 12;
  for (int round = 0; round < rounds; ++round) {
    TemporaryFolder scratch;
    const dvec3 centre(number(-100, 101) + 0.5, number(-100, 101) + 0.25, number(-100, 101));
    const int level = number(7, 9);
    const double inner = number(1, 60) / 1000.0, outer = inner + number(20, 80) / 1000.0;
    const auto measured = tests::hashed_heights(8, 5000.0, 6000.0);
    tests::write_node_planet(scratch / "planet", 4, geo::kWgs84, tests::hashed_heights(7, 0.0, 1000.0));
    const auto before = tests::open_surface(scratch / "planet");
    tests::add_inset(scratch / "planet", {"x", level, centre, inner, outer, measured});
    const auto surface = tests::open_surface(scratch / "planet");
    const dvec3 c = glm::normalize(centre);
    for (int k = 0; k < 40; ++k) {
      const dvec3 u =
          glm::normalize(c + 1e-3 * dvec3(number(-100, 101), number(-100, 101), number(-100, 101)));
      const int at = number(3, level + 1);
      const Place place = locate(u, at);
      const Node node{place.d, at, static_cast<int>(place.ij.x), static_cast<int>(place.ij.y)};
      const double low = before->height(node),
                   high = measured({node.d, level, node.i << (level - at), node.j << (level - at)});
      const double height = surface->height(node);
      ASSERT_GE(height, std::min(low, high) - 1e-3) << "round " << round;
      ASSERT_LE(height, std::max(low, high) + 1e-3) << "round " << round;
      const Names all = names(node);
      for (int m = 0; m < all.count; ++m)
        ASSERT_EQ(surface->height(all.node[static_cast<std::size_t>(m)]), height) << "round " << round;
    }
  }
}

}  // namespace
}  // namespace globe::planet
