#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/make_planet.h"
#include "tests/cli/refusals.h"
#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

namespace {

using cli::Outcome;
using cli::run_program;
using cli::text_of;
using nlohmann::json;

constexpr double kStep = 2e-8;  // metres: two geodesics' errors

struct Row {
  double distance_m = 0, lat = 0, lon = 0, height_m = 0;
};

std::vector<Row> rows(const Outcome& run) {
  std::vector<Row> all;
  for (const std::string& line : run.lines()) {
    std::istringstream words(line);
    Row row;
    EXPECT_TRUE(words >> row.distance_m >> row.lat >> row.lon >> row.height_m) << line;
    all.push_back(row);
  }
  return all;
}

std::vector<Row> profile(std::vector<std::string> words) {
  words.insert(words.begin(), "profile");
  const Outcome run = run_program(words);
  EXPECT_EQ(run.status, 0) << run.err;
  return rows(run);
}

double distance(const std::string& a, const std::string& b) {
  return json::parse(run_program({"distance", "--json", a, b}).out)["s12_m"].get<double>();
}

bool has_gnuplot() { return std::system("gnuplot --version >/dev/null 2>&1") == 0; }

TEST(Profile, BeginsAtAEndsAtBAndStepsEvenlyAlongTheGeodesic) {
  const auto samples = profile({"procedural", "48.2,16.37", "-33.9 151.2", "--count", "9"});
  ASSERT_EQ(samples.size(), 9u);
  EXPECT_EQ(samples.front().distance_m, 0.0);
  EXPECT_EQ(samples.front().lat, 48.2);
  EXPECT_EQ(samples.front().lon, 16.37);
  EXPECT_EQ(samples.back().lat, -33.9);
  EXPECT_EQ(samples.back().lon, 151.2);
  const double length = distance("48.2 16.37", "-33.9 151.2");
  EXPECT_NEAR(samples.back().distance_m, length, kStep);
  std::string pairs;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    char pair[200];
    std::snprintf(pair, sizeof pair, "%.17g %.17g %.17g %.17g\n", samples[k - 1].lat, samples[k - 1].lon,
                  samples[k].lat, samples[k].lon);
    pairs += pair;
  }
  for (const std::string& line : run_program({"distance"}, pairs).lines())
    EXPECT_NEAR(std::stod(line), length / 8.0, kStep) << line;
}

TEST(Profile, HeightsAreThoseOfTheHeightCommand) {
  const tests::TemporaryFolder folder;
  const std::string planet = cli::make_planet(folder.path(), {});
  for (const std::vector<std::string>& options : {std::vector<std::string>{},
                                                  {"--interpolation", "nearest"},
                                                  {"--interpolation", "cubic"},
                                                  {"--level", "3"},
                                                  {"--level", "8"}}) {
    std::vector<std::string> ask{planet, "10 -170", "-20 170", "--count", "50"};
    ask.insert(ask.end(), options.begin(), options.end());
    const auto samples = profile(ask);
    std::string points;
    for (const Row& row : samples) {
      char point[100];
      std::snprintf(point, sizeof point, "%.17g %.17g\n", row.lat, row.lon);
      points += point;
    }
    std::vector<std::string> words{"height", planet, "--json"};
    words.insert(words.end(), options.begin(), options.end());
    const auto answers = run_program(words, points).lines();
    ASSERT_EQ(answers.size(), samples.size());
    for (std::size_t k = 0; k < answers.size(); ++k)
      ASSERT_EQ(json::parse(answers[k])["height_m"].get<double>(), samples[k].height_m) << answers[k];
  }
}

TEST(Profile, AnswersTheKeysOfTheContractInOrder) {
  const Outcome run = run_program({"profile", "procedural", "0,0", "0,1", "--count=2", "--json"});
  EXPECT_EQ(run.status, 0) << run.err;
  ASSERT_EQ(run.lines().size(), 2u);
  std::vector<std::string> names;
  const auto object = nlohmann::ordered_json::parse(run.lines()[1]);
  for (const auto& item : object.items()) names.push_back(item.key());
  EXPECT_EQ(names, (std::vector<std::string>{"distance_m", "lat", "lon", "height_m"}));
  const auto table =
      run_program({"profile", "procedural", "0,0", "0,1", "--count=2", "--csv", "--precision=1"}).lines();
  ASSERT_EQ(table.size(), 3u);
  EXPECT_EQ(table[0], "distance_m,lat,lon,height_m");
  EXPECT_EQ(table[2].substr(0, 17), "111319.5,0.0,1.0,");
}

TEST(Profile, TakesTwoSamplesAGridEdgeAndFiveHundredAtLeast) {
  EXPECT_EQ(profile({"procedural", "0,0", "0,0.1"}).size(), 512u);
  // Half the equator at level 9, edges of a quarter meridian / 512: 2048 half edges and a little.
  const auto half_way = profile({"procedural", "1,0", "1,179"});
  EXPECT_GT(half_way.size(), 1900u);
  EXPECT_LT(half_way.size(), 2200u);
}

TEST(Profile, BetweenOppositePlacesGoesByTheNorthPole) {
  const auto samples = profile({"procedural", "30,20", "-30,-160", "--count", "7"});
  ASSERT_EQ(samples.size(), 7u);
  EXPECT_NEAR(samples[2].lat, 90.0, 0.3);
  for (const Row& row : samples) EXPECT_TRUE(std::isfinite(row.height_m));
  EXPECT_EQ(profile({"procedural", "90,0", "-90,0", "--count", "3"})[1].lon, 0.0);
}

TEST(Profile, OfOnePlaceIsThatPlaceTwice) {
  const auto samples = profile({"procedural", "12,34", "12,34"});
  ASSERT_EQ(samples.size(), 2u);
  for (const Row& row : samples) {
    EXPECT_EQ(row.distance_m, 0.0);
    EXPECT_EQ(row.lat, 12.0);
    EXPECT_EQ(row.lon, 34.0);
  }
  EXPECT_EQ(samples[0].height_m, samples[1].height_m);
}

TEST(Profile, RefusesWhatItCannotMeanWithOneLine) {
  const tests::TemporaryFolder folder;
  cli::make_planet(folder.path(), {});
  const std::string colors = cli::make_color_planet(folder.path());
  cli::expect_refusals(
      "profile", {cli::Refusal{{"procedural", "0,0"}, 2}, cli::Refusal{{"procedural", "nan,0", "1,1"}, 2},
                  cli::Refusal{{"procedural", "91,0", "1,1"}, 2}, cli::Refusal{{"procedural", "0,0", "1"}, 2},
                  cli::Refusal{{"procedural", "0,0", "1,1", "--count", "1"}, 2},
                  cli::Refusal{{"procedural", "0,0", "1,1", "--level", "29"}, 2},
                  cli::Refusal{{"procedural", "0,0", "1,1", "-o", "x.jpg"}, 2},
                  cli::Refusal{{"procedural", "0,0", "0,0", "-o", (folder / "x.png").string()}, 2},
                  cli::Refusal{{"procedural", "0,0", "1,1", "-o", (folder / "no/x.png").string()}, 1},
                  cli::Refusal{{"procedural", "0,0", "1,1", "-o", "/proc/x.png"}, 1},
                  cli::Refusal{{(folder / "nowhere").string(), "0,0", "1,1"}, 1},
                  cli::Refusal{{colors, "0,0", "1,1"}, 1}});
  EXPECT_FALSE(std::filesystem::exists(folder / "x.png"));
}

/// How many pixels of a picture have a colour.
std::size_t count_pixels(const std::filesystem::path& path, const std::array<int, 3>& color, int& width) {
  const auto input = OIIO::ImageInput::open(path.string());
  if (!input) return 0;
  const int height = input->spec().height, channels = input->spec().nchannels;
  width = input->spec().width;
  std::vector<unsigned char> bytes(static_cast<std::size_t>(width * height * channels));
  EXPECT_TRUE(input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, bytes.data()));
  std::size_t count = 0;
  for (std::size_t k = 0; k < bytes.size(); k += static_cast<std::size_t>(channels))
    count += bytes[k] == color[0] && bytes[k + 1] == color[1] && bytes[k + 2] == color[2] ? 1 : 0;
  return count;
}

TEST(ProfilePlot, ShowsGroundAndWater) {
  if (!has_gnuplot()) GTEST_SKIP() << "NO GNUPLOT";
  constexpr std::array<int, 3> kGround{0xd9, 0xc7, 0xa3}, kWater{0xb9, 0xd7, 0xee};
  const tests::TemporaryFolder folder;
  const auto draw = [&](const std::string& planet, const std::string& name) {
    const Outcome run = run_program(
        {"profile", planet, "-60,10", "60,170", "-o", (folder / name).string(), "--title", "It's _there_"});
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, "");
  };
  draw("procedural", "sea.png");
  draw("procedural", "again.png");
  int width = 0;
  EXPECT_GT(count_pixels(folder / "sea.png", kGround, width), 20000u);
  EXPECT_GT(count_pixels(folder / "sea.png", kWater, width), 20000u);
  EXPECT_EQ(width, 1600);
  EXPECT_EQ(text_of(folder / "sea.png"), text_of(folder / "again.png"));
  draw(cli::make_planet(folder.path(), {"--ellipsoid", "moon"}), "moon.png");
  EXPECT_GT(count_pixels(folder / "moon.png", kGround, width), 20000u);
  EXPECT_EQ(count_pixels(folder / "moon.png", kWater, width), 0u);
}

TEST(ProfilePlot, NamesPlacesAxesDatumAndExaggeration) {
  if (!has_gnuplot()) GTEST_SKIP() << "NO GNUPLOT";
  const tests::TemporaryFolder folder;
  const std::string path = (folder / "a.svg").string();
  const Outcome run = run_program({"profile", "procedural", "-43.42,-106.43", "-43.3,-106.3", "--title",
                                   "A walk & a 'half'", "-o", path, "--csv"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.lines().size(), 513u);
  const std::string svg = text_of(path);
  for (const char* words :
       {"A walk &amp; a 'half'", "43.4200° S, 106.4300° W", "datum: ellipsoid", "vertical exaggeration",
        "distance, km", "height, m", "sea level", "highest", "lowest", "procedural:1, level 9", "</svg>"})
    EXPECT_NE(svg.find(words), std::string::npos) << words;
}

TEST(ProfilePlot, IsNotOverwrittenUnaskedAndLeavesNothingElse) {
  if (!has_gnuplot()) GTEST_SKIP() << "NO GNUPLOT";
  const tests::TemporaryFolder folder;
  const std::string path = (folder / "~ |odd.png").string();
  const std::vector<std::string> words{"profile", "procedural", "0,0", "1,1", "-o", path};
  EXPECT_EQ(run_program(words).status, 0);
  const std::string before = text_of(path);
  EXPECT_GT(before.size(), 1000u);
  const Outcome again = run_program(words);
  EXPECT_EQ(again.status, 1);
  EXPECT_NE(again.err.find("--overwrite"), std::string::npos) << again.err;
  std::vector<std::string> other = words;
  other[3] = "20,20";
  other.push_back("--overwrite");
  EXPECT_EQ(run_program(other).status, 0);
  EXPECT_NE(text_of(path), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(ProfilePlot, WithoutGnuplotSaysWhatToInstall) {
  const tests::TemporaryFolder folder;
  const std::string before = std::getenv("PATH");
  ::setenv("PATH", folder.path().c_str(), 1);
  const Outcome run = run_program({"profile", "procedural", "0,0", "1,1", "-o", (folder / "a.png").string()});
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.err.find("gnuplot-nox"), std::string::npos) << run.err;
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
