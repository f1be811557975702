#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "globe/planet/layer_file.h"
#include "globe/planet/planet_file.h"
#include "globe/planet/surface.h"
#include "globe/planet/synthesis.h"
#include "tests/temporary_folder.h"

namespace globe::planet {
namespace {

using tests::TemporaryFolder;

constexpr int kDataLevel = 7;

/// Mountains in the north, a plain in the south, and still water of height 0 around longitude 0.
float measured(const Node& node) {
  const dvec3 u = node_direction(node);
  if (u.x > 0.9) return 0.0f;
  const double rough = u.z > 0.2 ? 1500.0 : 3.0;
  return static_cast<float>(1000.0 + rough * std::sin(70.0 * u.x) * std::sin(60.0 * u.y + 50.0 * u.z));
}

void write_planet(const std::filesystem::path& folder, const std::string& body) {
  std::filesystem::create_directory(folder);
  PlanetFile file;
  file.info.name = "test";
  file.info.body = body;
  file.info.vertical_datum = "ellipsoid";
  file.info.tile_size = 64;
  StoredLayer layer{{"height", kDataLevel, 1, "float32", -1000.0, 3000.0}, kDataLevel, {}};
  for (int d = 0; d < kDiamonds; ++d) {
    const std::string name = "height_" + std::to_string(d) + ".tif";
    LayerFileWriter writer(folder / name, kDataLevel, 1, "float32", 64);
    for (int level = kDataLevel; level >= 0; --level) {
      std::vector<float> samples;
      for (int j = 0; j <= nodes_per_side(level); ++j)
        for (int i = 0; i <= nodes_per_side(level); ++i) samples.push_back(measured({d, level, i, j}));
      writer.write_level(samples.data());
    }
    writer.finish();
    layer.files.push_back(describe_file(folder / name));
  }
  file.layers.push_back(layer);
  write_planet_file(folder, file);
}

class GroundOfDataset : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    write_planet(scratch_ / "planet", GetParam());
    surface_ = Surface::from_dataset(
        std::make_shared<const Dataset>(Dataset::open(scratch_ / "planet", std::size_t{16} << 20)));
  }

  TemporaryFolder scratch_;
  std::shared_ptr<const Surface> surface_;
};

TEST_P(GroundOfDataset, IsExactlyTheDataAtTheirNodesAtEveryLevel) {
  for (int d = 0; d < kDiamonds; ++d) {
    for (int j = 0; j <= nodes_per_side(kDataLevel); j += 7) {
      for (int i = 0; i <= nodes_per_side(kDataLevel); i += 5) {
        const auto data = static_cast<double>(measured({d, kDataLevel, i, j}));
        ASSERT_EQ(surface_->height(Node{d, kDataLevel, i, j}), data);
        ASSERT_EQ(surface_->height(Node{d, kDataLevel + 2, i << 2, j << 2}), data);
      }
    }
    const auto data = static_cast<double>(measured({d, kDataLevel, 40, 40}));
    ASSERT_EQ(surface_->height(Node{d, 22, 40 << (22 - kDataLevel), 40 << (22 - kDataLevel)}), data);
  }
}

TEST_P(GroundOfDataset, EveryNameOfANodeHasOneHeightBelowTheData) {
  for (const int level : {8, 9, 12, 21}) {
    const int n = nodes_per_side(level);
    for (const int t : {0, 1, n / 3, n / 2 + 1, n - 1}) {
      for (const ivec2 p : {ivec2{0, t}, ivec2{t, 0}, ivec2{n, t}, ivec2{t, n}}) {
        const Names all = names({1, level, p.x, p.y});
        for (int k = 1; k < all.count; ++k)
          ASSERT_EQ(surface_->height(all.node[static_cast<std::size_t>(k)]), surface_->height(all.node[0]));
      }
    }
  }
}

/// Root mean square difference between neighbours of the tile of level 11 around a direction, over the edge.
double unevenness(const Surface& surface, const dvec3& u) {
  const Place place = locate(glm::normalize(u), 11);
  const auto tile =
      surface.tile(tile_of({place.d, 11, static_cast<int>(place.ij.x), static_cast<int>(place.ij.y)}));
  double sum = 0.0;
  for (int j = tile->id.first_j(); j < tile->id.first_j() + tile->id.cells(); ++j) {
    for (int i = tile->id.first_i(); i < tile->id.first_i() + tile->id.cells(); ++i)
      sum += std::pow(tile->height.at(i + 1, j) - tile->height.at(i, j), 2.0);
  }
  return std::sqrt(sum) / tile->id.cells() / std::ldexp(surface.root_edge(), -11);
}

TEST_P(GroundOfDataset, IsRoughWhereTheDataAre) {
  const double mountains = unevenness(*surface_, {-0.5, 0.5, 0.7});
  const double plain = unevenness(*surface_, {-0.5, 0.5, -0.7});
  EXPECT_GT(mountains, 0.1);
  EXPECT_GT(mountains, 1.5 * plain);
}

INSTANTIATE_TEST_SUITE_P(Bodies, GroundOfDataset, testing::Values("earth", "moon"));

TEST(GroundOfDatasetOfEarth, StillWaterStaysFlat) {
  const TemporaryFolder scratch;
  write_planet(scratch / "planet", "earth");
  const auto surface = Surface::from_dataset(
      std::make_shared<const Dataset>(Dataset::open(scratch / "planet", std::size_t{16} << 20)));
  EXPECT_EQ(unevenness(*surface, {1.0, 0.02, 0.02}), 0.0);
}

}  // namespace
}  // namespace globe::planet
