#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "tests/cli/refusals.h"
#include "tests/cli/run_program.h"

// What globe convert takes: rasters of regions and of the whole planet, one over the other, and what is said
// of them.

namespace {

using cli::Outcome;
using cli::run_program;
using tests::TemporaryFolder;

/// An ASCII grid: longitude and latitude of its south-western corner, and of the middle of each cell to a
/// value.
struct Grid {
  int columns, rows;
  double west, south, cell;
  std::function<double(double lat, double lon)> value;

  std::string write(const std::filesystem::path& path) const {
    std::ofstream file(path);
    file << "ncols " << columns << "\nnrows " << rows << "\nxllcorner " << west << "\nyllcorner " << south
         << "\ncellsize " << cell << "\nNODATA_value -9999\n";
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x)
        write_value(file, value(south + (rows - y - 0.5) * cell, west + (x + 0.5) * cell));
      file << "\n";
    }
    return path.string();
  }
  static void write_value(std::ostream& file, double value) {
    file << (value == -9999 ? value : value + 0.5) << " ";
  }
};

Grid world(double value) {
  return {36, 18, -180, -90, 10, [=](double, double) { return value; }};
}

/// 20 to 40 north and east, with a hole in the middle.
Grid region(double value) {
  return {80, 80, 20, 20, 0.25, [=](double lat, double lon) {
            return std::abs(lat - 30) < 4 && std::abs(lon - 30) < 4 ? -9999.0 : value;
          }};
}

Outcome convert(std::vector<std::string> words, const std::string& planet) {
  words.insert(words.begin(), "convert");
  words.insert(words.end(), {"-o", planet, "--overwrite"});
  return run_program(words);
}

double height_at(const std::string& planet, const std::string& place) {
  const Outcome run = run_program({"height", planet, place, "--json"});
  EXPECT_EQ(run.status, 0) << run.err;
  return nlohmann::json::parse(run.out)["height_m"];
}

std::string datum(const std::string& planet) {
  return nlohmann::json::parse(run_program({"info", planet, "--json"}).out)["datum"];
}

class ConvertInputs : public testing::Test {
 protected:
  TemporaryFolder folder_;
  std::string planet_ = (folder_ / "planet").string();
};

TEST_F(ConvertInputs, LieOneOverTheOtherAndVoidsShowWhatIsBelow) {
  const std::string below = world(100).write(folder_ / "world.asc");
  const std::string above = region(500).write(folder_ / "region.asc");
  const Outcome made = convert({below, above, "--level", "6"}, planet_);
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_NE(made.err.find("degrees (assumed; --crs)"), std::string::npos) << made.err;
  EXPECT_NE(made.err.find("showing the maps below"), std::string::npos) << made.err;
  EXPECT_EQ(made.err.find("no map covers"), std::string::npos) << made.err;
  EXPECT_EQ(height_at(planet_, "24 24"), 500.5);
  EXPECT_EQ(height_at(planet_, "30 30"), 100.5);
  EXPECT_EQ(height_at(planet_, "0 0"), 100.5);
  ASSERT_EQ(convert({above, below, "--level", "6", "--quiet"}, planet_).status, 0);
  EXPECT_EQ(height_at(planet_, "24 24"), 100.5);
  EXPECT_EQ(run_program({"info", planet_, "--verify"}).status, 0);
}

TEST_F(ConvertInputs, TakeTheLevelOfTheFinestMapOfTheWholePlanet) {
  const std::string below = world(100).write(folder_ / "world.asc");
  const std::string above = region(500).write(folder_ / "region.asc");
  const auto level = [&](const std::vector<std::string>& maps) {
    EXPECT_EQ(convert(maps, planet_).status, 0);
    return nlohmann::json::parse(run_program({"info", planet_, "--json"}).out)["layers"][0]["level"]
        .get<int>();
  };
  EXPECT_EQ(level({below, above}), 4);
  EXPECT_EQ(level({above}), 9);
}

TEST_F(ConvertInputs, OfARegionAloneLeaveTheRestAtZeroAndSaySo) {
  const std::string map = region(500).write(folder_ / "region.asc");
  const Outcome made = convert({map, "--level", "6", "--quiet"}, planet_);
  ASSERT_EQ(made.status, 0) << made.err;
  // A sphere's share of 20 degrees square, and how it is said.
  const double share =
      100.0 - 100.0 * 20.0 / 360.0 * (std::sin(40 * M_PI / 180) - std::sin(20 * M_PI / 180)) / 2.0;
  const std::size_t at = made.err.find("no map covers ");
  ASSERT_NE(at, std::string::npos) << made.err;
  EXPECT_NEAR(std::stod(made.err.substr(at + 14)), share, 0.05) << made.err;
  EXPECT_NE(made.err.find("globe inset"), std::string::npos) << made.err;
  EXPECT_EQ(height_at(planet_, "24 24"), 500.5);
  EXPECT_EQ(height_at(planet_, "30 30"), 500.5) << "filled from around";
  EXPECT_EQ(height_at(planet_, "-10 100"), 0.0);
  ASSERT_EQ(convert({map, "--level", "6", "--quiet", "--voids", "zero"}, planet_).status, 0);
  EXPECT_EQ(height_at(planet_, "24 24"), 500.5);
  EXPECT_EQ(height_at(planet_, "30 30"), 0.0);
}

TEST_F(ConvertInputs, VoidsThatAreMarkedAreKnownAsFilledFromThenOn) {
  const std::string map = region(500).write(folder_ / "region.asc");
  ASSERT_EQ(convert({map, "--level", "7", "--quiet", "--voids", "mark"}, planet_).status, 0);
  const auto source = [&](const std::string& place, const std::vector<std::string>& options) {
    std::vector<std::string> words{"height", planet_, place, "--json"};
    words.insert(words.end(), options.begin(), options.end());
    const nlohmann::json answer = nlohmann::json::parse(run_program(words).out);
    EXPECT_EQ(answer["error_m"].is_null(), answer["source"] == "filled" || answer["source"] == "synthesised");
    return answer["source"].get<std::string>();
  };
  EXPECT_EQ(source("24 24", {}), "data");
  EXPECT_EQ(source("30 30", {}), "filled");
  EXPECT_EQ(source("30 30", {"--level", "5"}), "filled");
  EXPECT_EQ(source("-10 100", {}), "filled") << "no map there";
  EXPECT_EQ(source("30 30", {"--level", "12"}), "synthesised");
  EXPECT_EQ(height_at(planet_, "30 30"), 500.5) << "drawn and answered as though it were filled";
  EXPECT_EQ(run_program({"info", planet_, "--verify"}).status, 0);

  // As a map again, with the voids it had: half a degree a pixel, so those within a node of the hole go too.
  const std::string back = (folder_ / "back.asc.tif").string();
  ASSERT_EQ(run_program({"export", planet_, "-o", back, "--size", "40x40", "--extent", "20,20,40,40",
                         "--nodata", "-9999", "--quiet"})
                .status,
            0);
  const auto input = OIIO::ImageInput::open(back);
  std::vector<float> pixels(40 * 40);
  ASSERT_TRUE(input && input->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, pixels.data()));
  const auto at = [&](double lat, double lon) {
    return pixels[static_cast<std::size_t>((40 - lat) * 2) * 40 + static_cast<std::size_t>((lon - 20) * 2)];
  };
  int hidden = 0;
  for (double lon = 20.25; lon < 40; lon += 0.5) {
    const bool in_hole = std::abs(lon - 30)<3.5, on_land = std::abs(lon - 30)> 5.5 && std::abs(lon - 30) < 9;
    const float value = at(30.25, lon);
    hidden += value == -9999.0F;
    EXPECT_TRUE(!in_hole || value == -9999.0F) << lon;
    EXPECT_TRUE(!on_land || value == 500.5F) << lon << " " << value;
  }
  EXPECT_GE(hidden, 14);
  // It goes back as it came.
  ASSERT_EQ(convert({back, "--level", "6", "--quiet", "--voids", "mark"}, planet_).status, 0);
  EXPECT_EQ(source("30 30", {}), "filled");
  EXPECT_EQ(source("24 24", {}), "data");

  // A finer map laid over the void is data.
  const Grid patch{40, 40, 29, 29, 0.05, [](double, double) { return 7.0; }};
  ASSERT_EQ(run_program({"inset", planet_, patch.write(folder_ / "patch.asc"), "--quiet"}).status, 0);
  EXPECT_EQ(source("30 30", {}), "patch");
}

TEST_F(ConvertInputs, WithoutMarksNothingIsKnownAsFilled) {
  const std::string map = region(500).write(folder_ / "region.asc");
  ASSERT_EQ(convert({map, "--level", "6", "--quiet"}, planet_).status, 0);
  const nlohmann::json answer =
      nlohmann::json::parse(run_program({"height", planet_, "30 30", "--json"}).out);
  EXPECT_EQ(answer["source"], "data");
  cli::expect_refusals("export", {{{planet_, "-o", (folder_ / "a.tif").string(), "--nodata", "0"}, 1},
                                  {{planet_, "-o", (folder_ / "a.exr").string(), "--nodata", "0"}, 2}});
}

TEST_F(ConvertInputs, CountFromTheEllipsoidWithAGeoid) {
  const std::string map = world(100).write(folder_ / "world.asc");
  const std::string geoid = world(30).write(folder_ / "geoid.asc");
  ASSERT_EQ(convert({map, "--level", "4", "--geoid", geoid, "--quiet"}, planet_).status, 0);
  EXPECT_EQ(height_at(planet_, "12 34"), 131.0);
  EXPECT_EQ(datum(planet_), "ellipsoid");
  EXPECT_EQ(run_program({"info", planet_, "--verify"}).status, 0);
  ASSERT_EQ(convert({map, "--level", "4", "--datum", "EGM2008 height", "--quiet"}, planet_).status, 0);
  EXPECT_EQ(height_at(planet_, "12 34"), 100.5);
  EXPECT_EQ(datum(planet_), "EGM2008 height");
  ASSERT_EQ(convert({map, "--level", "4", "--quiet"}, planet_).status, 0);
  EXPECT_EQ(datum(planet_), "unknown");
}

TEST_F(ConvertInputs, HearWhatIsSaidOfAllOrOfEach) {
  const std::string below = world(100).write(folder_ / "world.asc");
  const std::string above = region(500).write(folder_ / "region.asc");
  ASSERT_EQ(convert({below, above, "--level", "6", "--units", "ft", "--quiet"}, planet_).status, 0);
  EXPECT_FLOAT_EQ(static_cast<float>(height_at(planet_, "0 0")), 100.5F * 0.3048F);
  EXPECT_FLOAT_EQ(static_cast<float>(height_at(planet_, "24 24")), 500.5F * 0.3048F);
  ASSERT_EQ(convert({below, above, "--level", "6", "--scale", "auto", "--scale", "2", "--offset", "1",
                     "--offset", "-1", "--quiet"},
                    planet_)
                .status,
            0);
  EXPECT_EQ(height_at(planet_, "0 0"), 101.5);
  EXPECT_EQ(height_at(planet_, "24 24"), 1000.0);
  ASSERT_EQ(convert({below, above, "--level", "6", "--nodata", "auto", "--nodata", "500.5", "--extent",
                     "auto", "--extent", "60,20,80,40", "--quiet"},
                    planet_)
                .status,
            0);
  EXPECT_EQ(height_at(planet_, "24 24"), 100.5) << "moved by its extent";
  EXPECT_EQ(height_at(planet_, "24 64"), 100.5) << "no data";
  cli::expect_refusals("convert",
                       {{{below, above, "-o", planet_, "--scale", "1", "--scale", "1", "--scale", "1"}, 2},
                        {{below, "-o", planet_, "--crs", "atlantis", "--overwrite", "--quiet"}, 2},
                        {{below, "-o", planet_, "--units", "cubits"}, 2},
                        {{below, "-o", planet_, "--voids", "keep"}, 2},
                        {{below, "-o", planet_, "--scale", "big"}, 2}});
}

TEST_F(ConvertInputs, OfColorsLieOneOverTheOtherToo) {
  const Grid grey{36, 18, -180, -90, 10, [](double, double) { return 0.0; }};
  const Grid bright{40, 40, 20, 20, 0.5, [](double, double) { return 1.0; }};
  const Outcome made = convert(
      {"--color", grey.write(folder_ / "a.asc"), bright.write(folder_ / "b.asc"), "--level", "5", "--quiet"},
      planet_);
  ASSERT_EQ(made.status, 0) << made.err;
  const nlohmann::json info = nlohmann::json::parse(run_program({"info", planet_, "--json"}).out);
  EXPECT_EQ(info["layers"][0]["name"], "color");
  EXPECT_EQ(info["credits"].size(), 3U);
}

// All of them with GLOBE_TEST_FULL=1, else every tenth.
TEST_F(ConvertInputs, ThatBreakReadersEndInOneLineOrInAPlanet) {
  const std::filesystem::path nasty = std::filesystem::path(GLOBE_DATA_DIR) / "nasty";
  if (!std::filesystem::exists(nasty)) GTEST_SKIP() << "SKIPPED: no sample data in " << nasty;
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(nasty))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  const std::size_t step = std::getenv("GLOBE_TEST_FULL") != nullptr ? 1 : 10;
  for (std::size_t k = 0; k < files.size(); k += step) {
    for (const bool as_heights : {true, false}) {
      std::vector<std::string> words{files[k].string(), "--level", "2", "--quiet"};
      if (!as_heights) words.insert(words.begin(), "--color");
      const Outcome made = convert(words, planet_);
      EXPECT_TRUE(made.status == 0 || made.status == 1) << files[k] << made.status << made.err;
      std::istringstream lines(made.err);
      int errors = 0;
      for (std::string line; std::getline(lines, line);) {
        EXPECT_EQ(line.rfind("globe: ", 0), 0U) << files[k] << ": " << line;
        errors += line.rfind("globe: warning: ", 0) != 0 ? 1 : 0;
      }
      EXPECT_EQ(errors, made.status) << files[k] << ": " << made.err;
      EXPECT_FALSE(std::filesystem::exists(planet_ + ".partial")) << files[k];
    }
  }
}

}  // namespace
