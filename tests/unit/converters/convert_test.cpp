#include "converters/convert.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>

#include "globe/base/error.h"
#include "globe/planet/dataset.h"
#include "globe/planet/grid.h"
#include "globe/planet/planet_file.h"
#include "tests/temporary_folder.h"

namespace converters {
namespace {

using globe::planet::Dataset;
using globe::planet::kDiamonds;
using globe::planet::Node;
using tests::TemporaryFolder;

template <typename T>
void write_map(const std::filesystem::path& path, int width, int channels,
               const std::function<T(int x, int y, int c)>& value) {
  std::vector<T> samples;
  for (int y = 0; y < width / 2; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) samples.push_back(value(x, y, c));
    }
  }
  const OIIO::TypeDesc type = OIIO::BaseTypeFromC<T>::value;
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output && output->open(path.string(), OIIO::ImageSpec(width, width / 2, channels, type)));
  ASSERT_TRUE(output->write_image(type, samples.data()) && output->close());
}

std::map<std::string, std::string> contents(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream stream(entry.path(), std::ios::binary);
    files[entry.path().filename().string()] = {std::istreambuf_iterator<char>(stream), {}};
  }
  return files;
}

/// Heights and colors of a small made-up planet.
ConvertOptions small_maps(const TemporaryFolder& folder) {
  write_map<float>(folder / "heights.tif", 512, 1, [](int x, int y, int) {
    return 3000.0F * std::sin(static_cast<float>(x) * 0.11F) * std::cos(static_cast<float>(y) * 0.07F);
  });
  write_map<std::uint8_t>(folder / "colors.png", 300, 3, [](int x, int y, int c) {
    return static_cast<std::uint8_t>((x * 5 + y * 3 + c * 80) % 256);
  });
  ConvertOptions options;
  options.heights = {MapInput{folder / "heights.tif", {}, {}}};
  options.colors = {MapInput{folder / "colors.png", {}, {}}};
  options.planet = folder / "planet";
  options.program_version = "globe test";
  return options;
}

TEST(Convert, MakesTheSameBytesWhateverTheThreadsAndTheMemory) {
  const TemporaryFolder folder;
  ConvertOptions options = small_maps(folder);
  options.threads = 1;
  convert(options, {});
  const std::map<std::string, std::string> reference = contents(options.planet);
  EXPECT_EQ(reference.size(), 21U);
  options.overwrite = true;
  for (const int threads : {2, 4}) {
    options.threads = threads;
    convert(options, {});
    EXPECT_TRUE(contents(options.planet) == reference) << threads << " threads";
  }
  options.memory_bytes = 1;
  convert(options, {});
  EXPECT_TRUE(contents(options.planet) == reference) << "everything in scratch files";
  EXPECT_FALSE(std::filesystem::exists(folder / "planet.partial"));
}

TEST(Convert, StoresLayersThatKeepTheirPromises) {
  const TemporaryFolder folder;
  const ConvertOptions options = small_maps(folder);
  convert(options, {});
  const Dataset planet = Dataset::open(options.planet, 1 << 22);
  EXPECT_EQ(planet.info().body, "earth");
  ASSERT_EQ(planet.layer("height")->level, 7);
  ASSERT_EQ(planet.layer("color")->level, 7);
  const auto read = [&](const char* layer, int d, int level) {
    const int side = globe::planet::nodes_per_side(level) + 1;
    std::vector<float> values(static_cast<std::size_t>(side * side * planet.layer(layer)->channels));
    planet.read(layer, d, level, 0, 0, side, side, values.data());
    return values;
  };
  for (int d = 0; d < kDiamonds; ++d) {
    const std::vector<float> fine = read("height", d, 7);
    for (int level = 0; level <= 7; ++level) {
      const int n = globe::planet::nodes_per_side(level);
      const int stride = 128 / n;
      const std::vector<float> coarse = read("height", d, level);
      const std::vector<float> next = read("height", (d + 1) % kDiamonds, level);
      const std::vector<float> relief = read("relief", d, level);
      const std::vector<float> next_relief = read("relief", (d + 1) % kDiamonds, level);
      const auto at = [&](const std::vector<float>& values, int i, int j) {
        return values[static_cast<std::size_t>(j * (n + 1) + i)];
      };
      for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i)
          ASSERT_EQ(at(coarse, i, j), fine[static_cast<std::size_t>(j * stride * 129 + i * stride)]);
        ASSERT_EQ(at(coarse, 0, j), at(next, j, 0));
        ASSERT_EQ(at(coarse, j, n), at(next, n, j));
        ASSERT_EQ(at(relief, 0, j), at(next_relief, j, 0));
        ASSERT_EQ(at(relief, j, n), at(next_relief, n, j));
      }
    }
    EXPECT_EQ(read("relief", d, 7), fine);
    EXPECT_NE(read("relief", d, 5), read("height", d, 5));
  }
}

TEST(Convert, RefusesWhatItCannotUseAndLeavesNothingBehind) {
  const TemporaryFolder folder;
  const ConvertOptions good = small_maps(folder);
  const auto message = [&](const ConvertOptions& options) -> std::string {
    try {
      convert(options, {});
    } catch (const globe::Error& error) {
      EXPECT_FALSE(std::filesystem::exists(options.planet.string() + ".partial"));
      return error.what();
    }
    return "no error";
  };
  ConvertOptions options = good;
  options.heights[0].path = folder / "absent.tif";
  EXPECT_NE(message(options).find("no such file"), std::string::npos);

  options = good;
  std::filesystem::resize_file(folder / "heights.tif", 300000);
  EXPECT_NE(message(options).find("heights.tif"), std::string::npos) << message(options);
  EXPECT_FALSE(std::filesystem::exists(options.planet));

  write_map<float>(folder / "heights.tif", 64, 1, [](int, int, int) { return NAN; });
  EXPECT_NE(message(good).find("no valid sample"), std::string::npos) << message(good);

  std::filesystem::create_directory(folder / "other");
  std::ofstream(folder / "other/letter.txt") << "keep me";
  options = small_maps(folder);
  options.planet = folder / "other";
  options.overwrite = true;
  EXPECT_NE(message(options).find("not a planet"), std::string::npos);
  EXPECT_TRUE(std::filesystem::exists(folder / "other/letter.txt"));

  convert(good, {});
  EXPECT_NE(message(good).find("--overwrite"), std::string::npos);
}

TEST(Convert, WarnsOfAnotherBodyAndOfVoids) {
  const TemporaryFolder folder;
  write_map<std::int16_t>(folder / "lunar.tif", 64, 1,
                          [](int x, int, int) { return static_cast<std::int16_t>(x < 16 ? -32768 : x); });
  ConvertOptions options;
  options.heights = {MapInput{folder / "lunar.tif", {}, {}}};
  options.planet = folder / "planet";
  std::string warnings;
  ConvertListener listener;
  listener.warning = [&](const std::string& text) { warnings += text + "\n"; };
  convert(options, listener);
  EXPECT_NE(warnings.find("looks like the moon"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("25 % of the surface is void"), std::string::npos) << warnings;
}

struct ColorSpot {
  const char* name;
  double lat, lon;
  std::vector<double> value;
};

/// Of the nodes within `reach` of a place, how near the best comes to the value wanted (largest difference of
/// a channel).
double best_match(const Dataset& planet, const char* layer, double unit, const ColorSpot& spot, int reach) {
  const globe::planet::LayerInfo& info = *planet.layer(layer);
  const globe::planet::Place place =
      globe::planet::locate(globe::geo::normal_from_degrees(spot.lat, spot.lon), info.level);
  double best = HUGE_VAL;
  for (int dj = -reach; dj <= reach; ++dj) {
    for (int di = -reach; di <= reach; ++di) {
      const Node node =
          globe::planet::fold({place.d, info.level, static_cast<int>(std::lround(place.ij.x)) + di,
                               static_cast<int>(std::lround(place.ij.y)) + dj});
      std::vector<float> found(static_cast<std::size_t>(info.channels));
      planet.read(layer, node.d, info.level, node.i, node.j, 1, 1, found.data());
      double difference = 0;
      for (std::size_t c = 0; c < found.size(); ++c)
        difference = std::max(difference, std::abs(static_cast<double>(found[c]) * unit - spot.value[c]));
      best = std::min(best, difference);
    }
  }
  return best;
}

void expect_spots(const Dataset& planet, const char* layer, double unit, double tolerance, int reach,
                  const std::vector<ColorSpot>& spots) {
  for (const ColorSpot& spot : spots)
    EXPECT_LE(best_match(planet, layer, unit, spot, reach), tolerance) << spot.name;
}

// With the nearest filter a node has the very sample it lies in. A place named may lie at that sample's edge,
// so the nodes within half a sample of it are searched, no farther.
TEST(ConvertRealMaps, KeepsTheSpotValuesOfEarth) {
  const std::filesystem::path data = GLOBE_DATA_DIR "/earth";
  if (!std::filesystem::exists(data / "earth_etopo20_f32.tif"))
    GTEST_SKIP() << "SKIPPED: no sample data in " << data;
  const TemporaryFolder folder;
  ConvertOptions options;
  options.heights = {MapInput{data / "earth_etopo20_f32.tif", {}, {}}};
  options.colors = {MapInput{data / "earth_colour_bluemarble_200411_topo_bathy_5400x2700.jpg", {}, {}}};
  options.planet = folder / "earth";
  options.filter = Filter::kNearest;
  convert(options, {});
  const Dataset planet = Dataset::open(options.planet, 1 << 24);
  EXPECT_NEAR(planet.layer("height")->min, -9026.625, 0.001);
  EXPECT_NEAR(planet.layer("height")->max, 6228.8125, 0.001);
  expect_spots(planet, "height", 1.0, 0.01, 1,
               {{"Everest", 27.99, 86.92, {5386.125}},
                {"Challenger Deep", 11.35, 142.2, {-7148.75}},
                {"Dead Sea", 31.5, 35.5, {-40.94}},
                {"Denver", 39.7, -105, {1619.19}},
                {"south pole", -89.9, 0.1, {2774.0}},
                {"north pole", 89.9, 0.1, {-4288.375}}});
  expect_spots(planet, "color", 255.0, 1.0, 1,
               {{"Sahara", 23, 13, {189, 145, 96}},
                {"mid Pacific", 0, -150, {6, 14, 37}},
                {"Amazon", -5, -62, {28, 45, 13}},
                {"Greenland", 75, -40, {246, 250, 251}}});
}

TEST(ConvertRealMaps, KeepsTheSpotValuesOfTheMoon) {
  const std::filesystem::path data = GLOBE_DATA_DIR "/moon";
  if (!std::filesystem::exists(data / "moon_gld100_12.8ppd_int16.tif"))
    GTEST_SKIP() << "SKIPPED: no sample data in " << data;
  const TemporaryFolder folder;
  ConvertOptions options;
  options.heights = {MapInput{data / "moon_gld100_12.8ppd_int16.tif", Extent{0, -90, 360, 90}, {}}};
  options.colors = {MapInput{data / "moon_colour_4096x2048.jpg", {}, {}}};
  options.planet = folder / "moon";
  options.ellipsoid = globe::geo::kMoon;
  options.filter = Filter::kNearest;
  convert(options, {});
  const Dataset planet = Dataset::open(options.planet, 1 << 24);
  EXPECT_EQ(planet.layer("height")->level, 11);
  EXPECT_EQ(planet.layer("height")->min, -9052);
  EXPECT_EQ(planet.layer("height")->max, 10757);
  expect_spots(planet, "height", 1.0, 0.5, 1,
               {{"highest", 5.44, 201.4, {10757}},
                {"lowest", -70.37, 187.55, {-9052}},
                {"Tycho's floor", -43.3, 348.8, {-2746}},
                {"Apollo 15", 26.13, 3.63, {-1923}},
                {"South Pole-Aitken", -53, 190.5, {-7192}}});
  // Greys of a picture with a tinge of color.
  expect_spots(planet, "color", 255.0, 8.0, 1,
               {{"Mare Imbrium", 35, -15, {63, 63, 63}}, {"far side", 20, 180, {198, 198, 198}}});
}

}  // namespace
}  // namespace converters
