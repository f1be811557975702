#include "globe/planet/tile_packer.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>

#include "tests/temporary_folder.h"

namespace globe::planet {
namespace {

constexpr int kSide = 128;

/// Tiles of every kind a layer has: smooth, noise, one value, numbers without a place on the scale.
std::vector<std::vector<std::byte>> tiles_of(const TiffLevel& level) {
  std::mt19937 random(5);
  std::vector<std::vector<std::byte>> tiles(4, std::vector<std::byte>(level.tile_bytes()));
  for (std::size_t kind = 0; kind < tiles.size(); ++kind) {
    std::vector<std::byte>& tile = tiles[kind];
    if (level.storage == "uint8") {
      for (std::size_t k = 0; k < tile.size(); ++k)
        tile[k] = static_cast<std::byte>(kind == 0   ? k / 40
                                         : kind == 1 ? random()
                                         : kind == 2 ? 77
                                                     : k % 251);
      continue;
    }
    for (std::size_t k = 0; k < tile.size() / sizeof(float); ++k) {
      const auto at = static_cast<float>(k % kSide);
      const float values[] = {4000.0F * std::sin(at / 30.0F), static_cast<float>(random()) - 2e9F, -0.0F,
                              k % 3 == 0 ? NAN : HUGE_VALF};
      std::memcpy(tile.data() + k * sizeof(float), &values[kind], sizeof(float));
    }
  }
  return tiles;
}

class EveryKind : public testing::TestWithParam<TiffLevel> {};

TEST_P(EveryKind, OfTileIsReadBackBitForBit) {
  TiffLevel level = GetParam();
  const auto tiles = tiles_of(level);
  level.width = kSide * static_cast<int>(tiles.size());
  level.height = kSide;
  const tests::TemporaryFolder folder;
  const std::filesystem::path path = folder / "tiles.tif";
  TiffWriter writer(path, false);
  writer.begin_level(level);
  for (std::size_t k = 0; k < tiles.size(); ++k) writer.write_tile(static_cast<int>(k), 0, tiles[k]);
  writer.end_level();
  writer.finish();
  const auto input = OIIO::ImageInput::open(path.string());
  ASSERT_TRUE(input);
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    std::vector<std::byte> read(tiles[k].size());
    ASSERT_TRUE(input->read_native_tile(0, 0, static_cast<int>(k) * kSide, 0, 0, read.data()))
        << input->geterror();
    EXPECT_TRUE(read == tiles[k]) << "tile " << k;
  }
}

TEST_P(EveryKind, OfTileGivesTheSameBytesWhateverWasPackedBefore) {
  const TiffLevel level = GetParam();
  const auto tiles = tiles_of(level);
  TilePacker old;
  for (const auto& tile : tiles) old.pack(level, tile);
  for (const auto& tile : tiles) {
    TilePacker fresh;
    EXPECT_TRUE(fresh.pack(level, tile) == old.pack(level, tile));
  }
}

INSTANTIATE_TEST_SUITE_P(TilePacker, EveryKind,
                         testing::Values(TiffLevel{0, 0, 1, "float32", kSide},
                                         TiffLevel{0, 0, 2, "float32", kSide},
                                         TiffLevel{0, 0, 1, "uint8", kSide},
                                         TiffLevel{0, 0, 3, "uint8", kSide}));

TEST(TilePacker, GivesTheSameBytesOnEveryProcessor) {
  std::uint64_t digest = 14695981039346656037ULL;  // Fowler, Noll and Vo's hash 1a
  TilePacker packer;
  for (const TiffLevel& level : {TiffLevel{0, 0, 1, "float32", kSide}, TiffLevel{0, 0, 3, "uint8", kSide}}) {
    std::vector<std::byte> tile(level.tile_bytes());
    std::uint32_t state = 1;
    for (std::byte& byte : tile) {
      state = state * 1664525 + 1013904223;
      byte = static_cast<std::byte>((state >> 24) % 23);
    }
    for (const std::byte byte : packer.pack(level, tile))
      digest = (digest ^ std::to_integer<std::uint64_t>(byte)) * 1099511628211ULL;
  }
  EXPECT_EQ(digest, 0x93b16fb7de7447e1ULL);
}

}  // namespace
}  // namespace globe::planet
