#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/cli/make_planet.h"
#include "tests/cli/refusals.h"
#include "tests/cli/run_program.h"

namespace {

using cli::Outcome;
using cli::run_program;
using nlohmann::json;

/// A DEM of 40 x 40 samples, 0.05 degrees apart, whose south-western corner is at (west, south): 5000 m and
/// 10 m more for each column; GDAL's ASCII grid, degrees.
std::string write_dem(const std::filesystem::path& path, double west, double south) {
  std::ofstream file(path);
  file << "ncols 40\nnrows 40\nxllcorner " << west << "\nyllcorner " << south
       << "\ncellsize 0.05\nNODATA_value -9999\n";
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 40; ++column) file << 5000 + 10 * column << ' ';
    file << '\n';
  }
  file.close();
  std::ofstream system(std::filesystem::path(path).replace_extension(".prj"));
  system
      << R"(GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],)"
      << R"(UNIT["degree",0.0174532925199433]])";
  return path.string();
}

/// Names and contents of all files of a folder.
std::map<std::string, std::string> contents_of(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream file(entry.path(), std::ios::binary);
    files[entry.path().filename()] = {std::istreambuf_iterator<char>(file), {}};
  }
  return files;
}

class InsetCommand : public testing::Test {
 protected:
  InsetCommand()
      : planet_(cli::make_planet(folder_.path(), {"--datum", "ellipsoid"})),
        dem_(write_dem(folder_ / "peak.asc", 10.0, 40.0)) {}

  json height(const std::string& point) const {
    const Outcome run = run_program({"height", planet_, point, "--json"});
    EXPECT_EQ(run.status, 0) << run.err;
    return json::parse(run.out);
  }

  tests::TemporaryFolder folder_;
  std::string planet_, dem_;
};

TEST_F(InsetCommand, LaysADemThatEveryCommandAnswersFrom) {
  const json before = height("41 30");
  const Outcome made = run_program({"inset", planet_, dem_});
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_EQ(made.out, "");
  EXPECT_NE(made.err.find("level 11"), std::string::npos) << made.err;

  // Column 19.5 is at 11 degrees.
  const json middle = height("41 11");
  EXPECT_NEAR(middle["height_m"].get<double>(), 5195.0, 1.0);
  EXPECT_EQ(middle["source"], "peak");
  EXPECT_EQ(middle["level"], 11);
  EXPECT_EQ(height("41 30"), before);

  const json summary = json::parse(run_program({"summary", planet_, "--box", "5,35,17,47", "--json"}).out);
  EXPECT_GT(summary["max_m"].get<double>(), 5250.0);
  EXPECT_EQ(summary["level"], 11);
  const std::string lines =
      run_program({"profile", planet_, "41 11", "41 11.2", "--count", "2", "--json"}).out;
  EXPECT_NEAR(json::parse(lines.substr(0, lines.find('\n')))["height_m"].get<double>(), 5195.0, 1.0);
  const json sight = json::parse(run_program({"sight", planet_, "41,9,3000", "41,13,3000", "--json"}).out);
  EXPECT_EQ(sight["visible"], false);
  const json lookup = json::parse(run_program({"lookup", planet_, "41 11", "--json"}).out);
  EXPECT_EQ(lookup["level"], 11);
  EXPECT_EQ(lookup["height_m"], middle["height_m"]);

  const Outcome info = run_program({"info", planet_, "--verify", "--json"});
  EXPECT_EQ(info.status, 0) << info.err;
  EXPECT_EQ(json::parse(info.out)["insets"][0]["name"], "peak");
  EXPECT_TRUE(json::parse(info.out)["damage"].empty()) << info.out;
}

TEST_F(InsetCommand, GoesAcrossTheAntimeridianAndOverAPole) {
  const std::string across = write_dem(folder_ / "across.asc", 179.0, -1.0);
  ASSERT_EQ(run_program({"inset", planet_, across, "--quiet"}).status, 0);
  EXPECT_NEAR(height("0 180")["height_m"].get<double>(), 5195.0, 1.0);
  EXPECT_NEAR(height("0.2 -179.6")["height_m"].get<double>(), 5195.0 + 80.0, 2.0);
  // The same square in kilometres, laid around the north pole.
  const std::filesystem::path pole = folder_ / "pole.asc";
  std::ofstream file(pole);
  file << "ncols 40\nnrows 40\nxllcorner -100000\nyllcorner -100000\ncellsize 5000\n";
  for (int k = 0; k < 1600; ++k) file << "4000 ";
  file.close();
  ASSERT_EQ(run_program({"inset", planet_, pole.string(), "--crs", "EPSG:3413", "--quiet"}).status, 0);
  EXPECT_NEAR(height("90 0")["height_m"].get<double>(), 4000.0, 0.1);
  EXPECT_NEAR(height("89.9 135")["height_m"].get<double>(), 4000.0, 0.1);
  EXPECT_EQ(run_program({"info", planet_, "--verify"}).status, 0);
}

TEST_F(InsetCommand, LaysAnImageOnItsPlaceAndNowhereElse) {
  constexpr int kSide = 64;
  std::vector<unsigned char> flag;  // red in the west, green in the east
  for (int k = 0; k < kSide * kSide; ++k) {
    const bool west = k % kSide < kSide / 2;
    flag.insert(flag.end(),
                {static_cast<unsigned char>(west ? 250 : 5), static_cast<unsigned char>(west ? 5 : 250), 5});
  }
  const std::string image = (folder_ / "flag.png").string(), colored = (folder_ / "colored").string();
  const auto output = OIIO::ImageOutput::create(image);
  ASSERT_TRUE(output->open(image, OIIO::ImageSpec(kSide, kSide, 3, OIIO::TypeDesc::UINT8)));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, flag.data()) && output->close());
  const std::string map = (folder_ / "blue.png").string();
  const std::vector<unsigned char> blue(32 * 16, 90);
  const auto base = OIIO::ImageOutput::create(map);
  ASSERT_TRUE(base->open(map, OIIO::ImageSpec(32, 16, 1, OIIO::TypeDesc::UINT8)));
  ASSERT_TRUE(base->write_image(OIIO::TypeDesc::UINT8, blue.data()) && base->close());
  ASSERT_EQ(run_program({"convert", "--color", map, "-o", colored, "--level", "7", "--quiet"}).status, 0);
  const Outcome made = run_program(
      {"inset", colored, "--color", image, "--extent", "10,40,12,42", "--name", "flag", "--quiet"});
  ASSERT_EQ(made.status, 0) << made.err;

  const std::string part = (folder_ / "part.png").string();
  ASSERT_EQ(
      run_program({"export", colored, "-o", part, "--extent", "9,39,13,43", "--size", "80x80", "--quiet"})
          .status,
      0);
  const auto input = OIIO::ImageInput::open(part);
  ASSERT_TRUE(input);
  std::vector<unsigned char> pixels(80 * 80 * 3);
  ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data()));
  const auto at = [&](int x, int y, int c) {
    return int{pixels[static_cast<std::size_t>((y * 80 + x) * 3 + c)]};
  };
  EXPECT_NEAR(at(33, 40, 0), 250, 3);  // 10.7 east, in the west of the flag
  EXPECT_NEAR(at(33, 40, 1), 5, 3);
  EXPECT_NEAR(at(47, 40, 0), 5, 3);
  EXPECT_NEAR(at(47, 40, 1), 250, 3);
  for (const auto& [x, y] : {std::pair{17, 40}, {62, 40}, {40, 17}, {40, 62}})
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(at(x, y, c), 90, 1) << x << ", " << y;
  EXPECT_EQ(run_program({"info", colored, "--verify"}).status, 0);
}

TEST_F(InsetCommand, ASecondOneOfTheNameNeedsOverwrite) {
  ASSERT_EQ(run_program({"inset", planet_, dem_, "--quiet"}).status, 0);
  const auto once = contents_of(planet_);
  const Outcome again = run_program({"inset", planet_, dem_});
  EXPECT_EQ(again.status, 1);
  EXPECT_NE(again.err.find("--overwrite"), std::string::npos) << again.err;
  EXPECT_TRUE(contents_of(planet_) == once);
  const std::string moved = write_dem(folder_ / "moved.asc", 20.0, 40.0);
  ASSERT_EQ(run_program({"inset", planet_, moved, "--name", "peak", "--overwrite", "--quiet"}).status, 0);
  EXPECT_EQ(height("41 21")["source"], "peak");
  EXPECT_EQ(height("41 11")["source"], "data");
  EXPECT_EQ(contents_of(planet_).size(), once.size()) << "files of the old one are gone";
  EXPECT_EQ(run_program({"info", planet_, "--verify"}).status, 0);
}

TEST_F(InsetCommand, RefusesWhatItCannotLayAndLeavesThePlanetAsItWas) {
  const auto before = contents_of(planet_);
  std::ofstream(folder_ / "words.tif") << "no raster";
  cli::expect_refusals(
      "inset", {{{"procedural", dem_}, 2},
                {{planet_}, 2},
                {{(folder_ / "none").string(), dem_}, 1},
                {{planet_, (folder_ / "missing.tif").string()}, 1},
                {{planet_, (folder_ / "words.tif").string()}, 1},
                {{planet_, (folder_ / "map.tif").string()}, 1},  // no georeferencing: a map of everything
                {{planet_, dem_, "--level", "3"}, 1},
                {{planet_, dem_, "--name", "data"}, 2},
                {{planet_, dem_, "--name", "../x"}, 2},
                {{planet_, dem_, "--rim", "-3"}, 2},
                {{planet_, dem_, "--nodata", "x"}, 2},
                {{planet_, "--color", dem_}, 1}});  // the planet has no colors
  EXPECT_TRUE(contents_of(planet_) == before);
}

TEST_F(InsetCommand, AFullDiskLeavesThePlanetAsItWas) {
  const auto before = contents_of(planet_);
  rlimit limit{}, less{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &limit), 0);
  for (const rlim_t bytes : {rlim_t{2000}, rlim_t{6000}}) {
    less = {bytes, limit.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &less), 0);
    const Outcome run = run_program({"inset", planet_, dem_, "--quiet"});
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &limit), 0);
    EXPECT_EQ(run.status, 1) << run.err;
    EXPECT_TRUE(contents_of(planet_) == before);
  }
}

TEST_F(InsetCommand, KilledAtAnyMomentThePlanetIsTheOldOrTheNewOne) {
  const json old = json::parse(run_program({"info", planet_, "--json"}).out);
  const int kills = std::getenv("GLOBE_TEST_FULL") != nullptr ? 200 : 6;
  for (int k = 0; k < kills; ++k) {
    const pid_t child = cli::start({"inset", planet_, dem_, "--overwrite", "--quiet"}, folder_.path());
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + 37 * k % 300));
    ::kill(child, SIGKILL);
    cli::wait_for(child);
    const Outcome info = run_program({"info", planet_, "--json", "--verify"});
    ASSERT_EQ(info.status, 0) << info.err;
  }
  ASSERT_EQ(run_program({"inset", planet_, dem_, "--overwrite", "--quiet"}).status, 0);
  for (const auto& [name, bytes] : contents_of(planet_))
    EXPECT_NE(name.front(), '.') << "left over: " << name;
}

}  // namespace
