#include "globe/planet/verify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>

#include "globe/base/error.h"
#include "globe/planet/layer_file.h"
#include "globe/planet/mean_height.h"
#include "tests/node_planet.h"
#include "tests/temporary_folder.h"

namespace globe::planet {
namespace {

using tests::TemporaryFolder;

constexpr int kVerifiedLevel = 6;

Verification verify(const std::filesystem::path& folder) {
  return verify_planet(folder, std::size_t{8} << 20, [](const std::string&, double) {});
}

std::vector<std::string> damage(const std::filesystem::path& folder) { return verify(folder).damage; }

void write_sound_planet(const std::filesystem::path& folder, int level = kVerifiedLevel) {
  tests::write_node_planet(folder, level, geo::kMoon, tests::hashed_heights(11, -3000.0, 5000.0));
}

using Change = std::function<void(int level, std::vector<float>& samples)>;

/// Writes a layer of one diamond anew with some samples changed, and planet.json with its new checksum: a
/// planet that is whole and wrong.
void alter(const std::filesystem::path& folder, const std::string& layer, int d, const Change& change) {
  PlanetFile file = read_planet_file(folder);
  const auto stored = std::find_if(file.layers.begin(), file.layers.end(),
                                   [&](const StoredLayer& one) { return one.info.name == layer; });
  ASSERT_NE(stored, file.layers.end());
  const std::filesystem::path path = folder / stored->files[static_cast<std::size_t>(d)].name;
  const std::filesystem::path altered = folder / "altered.tif";
  {
    const Dataset data = Dataset::open(folder, std::size_t{8} << 20);
    LayerFileWriter writer(altered, stored->stored_level, stored->info.channels, "float32",
                           file.info.tile_size);
    for (int level = stored->stored_level; level >= 0; --level) {
      const int side = nodes_per_side(level) + 1;
      std::vector<float> samples(static_cast<std::size_t>(side * side * stored->info.channels));
      data.read(layer, d, level, 0, 0, side, side, samples.data());
      change(level, samples);
      writer.write_level(samples.data());
    }
    writer.finish();
  }
  std::filesystem::rename(altered, path);
  stored->files[static_cast<std::size_t>(d)] = describe_file(path);
  write_planet_file(folder, file);
}

/// Puts a value to a sample of one level, j row and i column.
Change put(int level, int i, int j, float value, int channels = 1) {
  return [=](int at, std::vector<float>& samples) {
    if (at != level) return;
    const int side = nodes_per_side(level) + 1;
    samples[static_cast<std::size_t>((j * side + i) * channels)] = value;
  };
}

TEST(VerifyPlanet, FindsNothingInASoundPlanet) {
  for (const int level : {0, 1, 2, 3, kVerifiedLevel, 8}) {
    const TemporaryFolder folder;
    write_sound_planet(folder.path(), level);
    const Verification found = verify(folder.path());
    EXPECT_EQ(found.damage, std::vector<std::string>{}) << level;
    EXPECT_GT(found.files, 9U);
    EXPECT_GE(found.nodes, 4U << (2 * level));
  }
}

TEST(VerifyPlanet, FindsAValueThatIsNotFinite) {
  const TemporaryFolder folder;
  write_sound_planet(folder.path());
  alter(folder.path(), "relief", 1, put(5, 7, 9, NAN));
  EXPECT_EQ(
      damage(folder.path()),
      std::vector<std::string>{"relief, level 5, diamond 1: 1 values are not finite, the first at 7, 9"});
}

TEST(VerifyPlanet, FindsABorderThatDiffersOnEitherEdge) {
  const TemporaryFolder folder;
  write_sound_planet(folder.path());
  alter(folder.path(), "relief", 2, put(4, 0, 3, 1.0F));
  alter(folder.path(), "relief", 0, put(5, 32, 20, 1.0F));
  EXPECT_EQ(
      damage(folder.path()),
      (std::vector<std::string>{
          "relief, level 5, diamond 3: 1 nodes on the border have other values in diamond 0, the first at "
          "20, 32",
          "relief, level 4, diamond 2: 1 nodes on the border have other values in diamond 3, the first at "
          "0, 3"}));
}

TEST(VerifyPlanet, FindsACoarseHeightThatIsNotTheFineOne) {
  const TemporaryFolder folder;
  write_sound_planet(folder.path());
  alter(folder.path(), "height", 3, put(3, 5, 2, 17.0F));
  EXPECT_EQ(damage(folder.path()),
            std::vector<std::string>{
                "height, level 3, diamond 3: 1 heights are not those of the finer level, the first at 5, 2"});
}

TEST(VerifyPlanet, FindsAFineHeightOutsideItsRange) {
  const TemporaryFolder folder;
  write_sound_planet(folder.path());
  alter(folder.path(), "height", 0, put(kVerifiedLevel, 51, 21, 9999.0F));
  const std::vector<std::string> found = damage(folder.path());
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(found[0].starts_with("height: its heights span -")) << found[0];
  EXPECT_NE(found[0].find(" to 9999.000000 m, planet.json says "), std::string::npos) << found[0];
  EXPECT_EQ(found[1],
            "height_range, level 3, diamond 0: 1 cells do not hold their heights, the first at 6, 2");
}

TEST(VerifyPlanet, FindsARangeThatIsTooNarrowAtEveryLevel) {
  const TemporaryFolder folder;
  write_sound_planet(folder / "sound");
  for (int level = block_level(kVerifiedLevel); level >= 0; --level) {
    const std::filesystem::path altered = folder / std::to_string(level);
    std::filesystem::copy(folder / "sound", altered);
    alter(altered, "height_range", 2, put(level, 0, 0, 4900.0F, 2));
    const std::vector<std::string> found = damage(altered);
    ASSERT_FALSE(found.empty()) << level;
    EXPECT_NE(found.front().find("height_"), std::string::npos) << found.front();
  }
}

TEST(VerifyPlanet, FindsAMeanOutsideItsRange) {
  const TemporaryFolder folder;
  write_sound_planet(folder.path());
  alter(folder.path(), "height_mean", 1, put(2, 3, 1, -3500.0F, 2));
  EXPECT_EQ(
      damage(folder.path()),
      std::vector<std::string>{
          "height_mean, level 2, diamond 1: 1 means lie outside their cell's range, the first at 3, 1"});
}

TEST(VerifyPlanet, NamesTheTileThatCannotBeDecoded) {
  const TemporaryFolder folder;
  write_sound_planet(folder.path());
  const std::filesystem::path path = folder / "height_0.tif";
  constexpr std::streamoff kFirstTile = 8;  // right behind the header
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(kFirstTile) << std::string(64, '\xff');
  file.close();
  const std::vector<std::string> found = damage(folder.path());
  ASSERT_GE(found.size(), 2U);
  EXPECT_EQ(found[0], "height_0.tif: contents changed (checksum differs)");
  EXPECT_TRUE(std::any_of(found.begin(), found.end(), [](const std::string& line) {
    return line.starts_with("height_0.tif: tile ") && line.find("cannot be decoded") != std::string::npos;
  })) << testing::PrintToString(found);
}

TEST(FindDamage, FindsEveryFlippedBitOfEveryFile) {
  const TemporaryFolder folder;
  write_sound_planet(folder.path(), 3);
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::mt19937 random(20261124);
  int found = 0;
  constexpr int kFlips = 1000;
  for (int k = 0; k < kFlips; ++k) {
    const std::filesystem::path& path = files[random() % files.size()];
    const auto at = static_cast<std::streamoff>(random() % std::filesystem::file_size(path));
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    char byte = 0;
    file.seekg(at).get(byte);
    file.seekp(at).put(static_cast<char>(byte ^ (1 << random() % 8)));
    file.close();
    try {
      found += !find_damage(folder.path()).empty();
    } catch (const Error&) {
      ++found;  // a planet.json that cannot be read
    }
    std::fstream(path, std::ios::in | std::ios::out | std::ios::binary).seekp(at).put(byte);
  }
  EXPECT_EQ(found, kFlips);
  EXPECT_TRUE(find_damage(folder.path()).empty());
}

}  // namespace
}  // namespace globe::planet
