#include "globe/planet/dataset.h"

#include <gtest/gtest.h>

#include <barrier>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "globe/base/error.h"
#include "globe/planet/grid.h"
#include "globe/planet/layer_file.h"
#include "globe/planet/planet_file.h"
#include "tests/temporary_folder.h"

namespace globe::planet {
namespace {

constexpr int kDatasetLevel = 8;
constexpr int kTile = 64;

float sample(int d, int level, int i, int j) {
  return static_cast<float>(d * 1000 + level) + static_cast<float>(i) * 0.25F - static_cast<float>(j);
}

/// A planet with "height" to kDatasetLevel, "relief" stored below it, and "color", each sample telling its
/// own place.
void write_planet(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  PlanetFile file;
  file.info = {"Test", "moon", "", geo::kMoon, "sphere", kTile, {}, {"made by hand"}};
  file.layers = {{{"height", kDatasetLevel, 1, "float32", -1, 1}, kDatasetLevel, {}},
                 {{"relief", kDatasetLevel, 1, "float32", -1, 1}, kDatasetLevel - 1, {}},
                 {{"color", 3, 3, "uint8", 0, 1}, 3, {}}};
  for (StoredLayer& layer : file.layers) {
    for (int d = 0; d < kDiamonds; ++d) {
      const std::string name = layer.info.name + "_" + std::to_string(d) + ".tif";
      LayerFileWriter writer(folder / name, layer.stored_level, layer.info.channels, layer.info.storage,
                             kTile);
      for (int level = layer.stored_level; level >= 0; --level) {
        const int side = nodes_per_side(level) + 1;
        std::vector<float> heights;
        std::vector<std::uint8_t> colors;
        for (int j = 0; j < side; ++j) {
          for (int i = 0; i < side; ++i) {
            heights.push_back(sample(d, level, i, j));
            for (int c = 0; c < 3; ++c)
              colors.push_back(static_cast<std::uint8_t>(d * 60 + i * 3 + j * 2 + c));
          }
        }
        layer.info.storage == "uint8" ? writer.write_level(colors.data())
                                      : writer.write_level(heights.data());
      }
      writer.finish();
      layer.files.push_back(describe_file(folder / name));
    }
  }
  write_planet_file(folder, file);
}

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

void replace_in_json(const std::filesystem::path& folder, const std::string& from, const std::string& to) {
  std::ifstream in(folder / kPlanetFileName);
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  std::ofstream(folder / kPlanetFileName) << text.replace(at, from.size(), to);
}

TEST(Dataset, GivesBackEverySampleOfEveryLevelAcrossTileBorders) {
  const tests::TemporaryFolder folder;
  write_planet(folder.path());
  const Dataset dataset = Dataset::open(folder.path(), 1 << 20);
  for (int d = 0; d < kDiamonds; ++d) {
    for (int level = kDatasetLevel; level >= 0; --level) {
      const int side = nodes_per_side(level) + 1;
      for (const int first : {0, side / 3}) {
        const int count = side - first;
        std::vector<float> out(static_cast<std::size_t>(count) * static_cast<std::size_t>(count));
        dataset.read("height", d, level, first, first, count, count, out.data());
        for (int j = 0; j < count; ++j) {
          for (int i = 0; i < count; ++i)
            ASSERT_EQ(out[static_cast<std::size_t>(j * count + i)], sample(d, level, first + i, first + j));
        }
      }
    }
  }
}

TEST(Dataset, LayersLeftOutAreAsGoodAsNotThere) {
  const tests::TemporaryFolder folder;
  write_planet(folder.path());
  const Dataset heights = Dataset::open(folder.path(), 1 << 20, {.colors = false});
  EXPECT_EQ(heights.layer("color"), nullptr);
  EXPECT_NE(heights.layer("relief"), nullptr);
  EXPECT_EQ(heights.info().layers.size(), 2u);
  const Dataset colors = Dataset::open(folder.path(), 1 << 20, {.heights = false});
  EXPECT_NE(colors.layer("color"), nullptr);
  EXPECT_EQ(colors.layer("height"), nullptr);
  EXPECT_EQ(colors.info().layers.size(), 1u);
}

TEST(Dataset, FindsTheFinestReliefInTheHeights) {
  const tests::TemporaryFolder folder;
  write_planet(folder.path());
  const Dataset dataset = Dataset::open(folder.path(), 1 << 20);
  ASSERT_NE(dataset.layer("relief"), nullptr);
  EXPECT_EQ(dataset.layer("relief")->level, kDatasetLevel);
  float out = 0;
  dataset.read("relief", 2, kDatasetLevel, 5, 7, 1, 1, &out);
  EXPECT_EQ(out, sample(2, kDatasetLevel, 5, 7));
  dataset.read("relief", 2, kDatasetLevel - 1, 5, 7, 1, 1, &out);
  EXPECT_EQ(out, sample(2, kDatasetLevel - 1, 5, 7));
}

TEST(Dataset, GivesColorsAsBytesAndAsFractions) {
  const tests::TemporaryFolder folder;
  write_planet(folder.path());
  const Dataset dataset = Dataset::open(folder.path(), 1 << 20);
  std::uint8_t bytes[6] = {};
  dataset.read("color", 1, 3, 4, 2, 2, 1, bytes);
  EXPECT_EQ(bytes[0], 60 + 12 + 4);
  EXPECT_EQ(bytes[5], 60 + 15 + 4 + 2);
  float fractions[6] = {};
  dataset.read("color", 1, 3, 4, 2, 2, 1, fractions);
  EXPECT_EQ(fractions[5], static_cast<float>(bytes[5]) / 255.0F);
  EXPECT_EQ(dataset.layer("night"), nullptr);
}

TEST(Dataset, KeepsWhatPlanetJsonSays) {
  const tests::TemporaryFolder folder;
  write_planet(folder.path());
  const Dataset dataset = Dataset::open(folder.path(), 1 << 20);
  EXPECT_EQ(dataset.info().name, "Test");
  EXPECT_EQ(dataset.info().ellipsoid, geo::kMoon);
  EXPECT_EQ(dataset.info().layers.size(), 3U);
  EXPECT_EQ(dataset.info().credits, std::vector<std::string>{"made by hand"});
  EXPECT_EQ(dataset.info().id.size(), 16U);
  EXPECT_TRUE(find_damage(folder.path()).empty());
}

TEST(Dataset, ReadsTheSameFromManyThreadsThroughATinyCache) {
  const tests::TemporaryFolder folder;
  write_planet(folder.path());
  const Dataset dataset = Dataset::open(folder.path(), 1 << 16);
  std::vector<int> wrong(8, 0);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    threads.emplace_back([&, t] {
      for (int k = 0; k < 400; ++k) {
        const int d = (k + static_cast<int>(t)) % kDiamonds;
        const int i = k * 37 % 200;
        const int j = k * 101 % 200;
        std::vector<float> out(40 * 40);
        dataset.read("height", d, kDatasetLevel, i, j, 40, 40, out.data());
        if (out.front() != sample(d, kDatasetLevel, i, j) ||
            out.back() != sample(d, kDatasetLevel, i + 39, j + 39))
          ++wrong[t];
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(8, 0));
}

TEST(Dataset, ReadsFromThreadsThatOutliveTheDatasetsBefore) {
  const tests::TemporaryFolder folder;
  write_planet(folder.path());
  std::barrier<> turn(5);
  std::optional<Dataset> dataset;
  std::vector<int> wrong(4, 0);
  constexpr int kDatasets = 30;
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    threads.emplace_back([&, t] {
      for (int round = 0; round < kDatasets; ++round) {
        turn.arrive_and_wait();
        for (int k = 0; k < 20; ++k) {
          const int i = (k * 37 + 50 * static_cast<int>(t)) % 250;
          float out = 0;
          dataset->read("height", k % kDiamonds, kDatasetLevel, i, k * 11, 1, 1, &out);
          wrong[t] += out != sample(k % kDiamonds, kDatasetLevel, i, k * 11);
        }
        turn.arrive_and_wait();
      }
    });
  }
  for (int round = 0; round < kDatasets; ++round) {
    dataset.emplace(Dataset::open(folder.path(), 1 << 20));
    turn.arrive_and_wait();
    turn.arrive_and_wait();
    dataset.reset();
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST(Dataset, RefusesBrokenPlanetsWithOneClearLine) {
  const tests::TemporaryFolder folder;
  const auto open_error = [&] { return message_of([&] { Dataset::open(folder.path(), 1 << 20); }); };
  EXPECT_NE(open_error().find("not a planet"), std::string::npos) << open_error();

  write_planet(folder.path());
  std::filesystem::resize_file(folder / "height_2.tif",
                               std::filesystem::file_size(folder / "height_2.tif") - 100);
  EXPECT_NE(open_error().find("height_2.tif: truncated"), std::string::npos) << open_error();

  std::filesystem::remove(folder / "height_2.tif");
  EXPECT_NE(open_error().find("height_2.tif: missing"), std::string::npos) << open_error();

  write_planet(folder.path());
  std::fstream(folder / "color_0.tif", std::ios::in | std::ios::out | std::ios::binary)
      << "not a TIFF at all";
  EXPECT_NE(open_error().find("color_0.tif: not a readable TIFF"), std::string::npos) << open_error();

  write_planet(folder.path());
  replace_in_json(folder.path(), "\"version\": 1", "\"version\": 3");
  EXPECT_NE(open_error().find("newer"), std::string::npos) << open_error();

  write_planet(folder.path());
  replace_in_json(folder.path(), "\"color_0.tif\"", "\"../x.tif\"");
  EXPECT_NE(open_error().find("plain file name"), std::string::npos) << open_error();

  write_planet(folder.path());
  std::ofstream(folder / kPlanetFileName) << "{ \"format\": ";
  EXPECT_NE(open_error().find("malformed"), std::string::npos) << open_error();
  EXPECT_EQ(open_error().find('\n'), std::string::npos) << open_error();
}

TEST(Dataset, ReportsATileThatCannotBeDecoded) {
  const tests::TemporaryFolder folder;
  write_planet(folder.path());
  // The middle of the file lies in the compressed tiles of one level or another.
  const auto middle = static_cast<std::streamoff>(std::filesystem::file_size(folder / "height_0.tif") / 2);
  std::fstream file(folder / "height_0.tif", std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(middle) << std::string(2000, '\xff');
  file.close();
  const Dataset dataset = Dataset::open(folder.path(), 1 << 20);
  const std::string message = message_of([&] {
    for (int level = 0; level <= kDatasetLevel; ++level) {
      const int side = nodes_per_side(level) + 1;
      std::vector<float> out(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
      dataset.read("height", 0, level, 0, 0, side, side, out.data());
    }
  });
  EXPECT_NE(message.find("cannot be decoded"), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST(FindDamage, FindsEveryFlippedBit) {
  const tests::TemporaryFolder folder;
  write_planet(folder.path());
  const std::filesystem::path path = folder / "relief_3.tif";
  const auto bytes = static_cast<int>(std::filesystem::file_size(path));
  for (int k = 0; k < 50; ++k) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    const int at = k * 7919 % bytes;
    char byte = 0;
    file.seekg(at).get(byte);
    file.seekp(at).put(static_cast<char>(byte ^ (1 << k % 8)));
    file.close();
    EXPECT_EQ(find_damage(folder.path()).size(), 1U);
    std::fstream(path, std::ios::in | std::ios::out | std::ios::binary).seekp(at).put(byte);
  }
  EXPECT_TRUE(find_damage(folder.path()).empty());
}

}  // namespace
}  // namespace globe::planet
