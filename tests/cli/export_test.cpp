#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "tests/cli/make_planet.h"
#include "tests/cli/refusals.h"
#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

namespace {

using cli::Outcome;
using cli::run_program;

class ExportCommand : public testing::Test {
 protected:
  Outcome make(const std::string& map, std::vector<std::string> options) const {
    options.insert(options.begin(), {"export", planet_, "-o", (folder_ / map).string()});
    return run_program(options);
  }

  tests::TemporaryFolder folder_;
  std::string planet_ = cli::make_planet(folder_.path(), {"--level", "6", "--credit", "by hand"});
};

TEST_F(ExportCommand, SaysWhatItWritesAndPixelsAreTheHeightsAsked) {
  const Outcome run = make("made.exr", {"--extent", "-30,-20,40,15", "--size=14x7"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_NE(run.err.find("longitudes -30 to 40, latitudes -20 to 15, 14x7 pixels of 5 x 5 degrees"),
            std::string::npos)
      << run.err;
  ASSERT_EQ(make("made.exr",
                 {"--extent=-30,-20,40,15", "--size", "14x7", "--filter", "linear", "--quiet", "--overwrite"})
                .err,
            "");
  const auto input = OIIO::ImageInput::open((folder_ / "made.exr").string());
  ASSERT_TRUE(input);
  std::vector<float> pixels(14 * 7);
  ASSERT_TRUE(input->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, pixels.data()));
  EXPECT_NE(input->spec().get_string_attribute("ImageDescription").find("by hand"), std::string::npos);
  for (const auto& [x, y] : {std::pair{0, 0}, std::pair{13, 6}, std::pair{5, 2}}) {
    std::ostringstream place;
    place << 15 - 5 * (y + 0.5) << ',' << -30 + 5 * (x + 0.5);
    const Outcome height = run_program({"height", planet_, "--json", place.str()});
    EXPECT_NEAR(pixels[static_cast<std::size_t>(y * 14 + x)],
                nlohmann::json::parse(height.out)["height_m"].get<double>(), 1e-4);
  }
}

TEST_F(ExportCommand, ExtentsRunAcrossTheAntimeridianEitherWay) {
  ASSERT_EQ(make("a.tif", {"--extent", "170,-20,-170,10", "--quiet"}).status, 0);
  ASSERT_EQ(make("b.tif", {"--extent", "170,-20,190,10", "--quiet"}).status, 0);
  EXPECT_EQ(cli::text_of(folder_ / "a.tif"), cli::text_of(folder_ / "b.tif"));
}

TEST_F(ExportCommand, TakesColorsForAPngOfAPlanetThatHasThem) {
  const std::string colors = cli::make_color_planet(folder_.path());
  const auto exported = [&](const std::string& planet, const std::string& name) {
    const Outcome run = run_program({"export", planet, "-o", (folder_ / name).string(), "--size", "32x16"});
    EXPECT_EQ(run.status, 0) << run.err;
    return run.err;
  };
  EXPECT_NE(exported(colors, "c.png").find("colors of"), std::string::npos);
  EXPECT_NE(exported(colors, "c.tif").find("colors of"), std::string::npos);
  EXPECT_NE(exported(planet_, "h.png").find("16 bits span"), std::string::npos);
  EXPECT_NE(exported("procedural", "p.png").find("colors of"), std::string::npos);
  EXPECT_EQ(run_program({"export", colors, "-o", (folder_ / "x.tif").string(), "--layer", "height"}).status,
            1);
  EXPECT_EQ(make("x.tif", {"--layer", "color"}).status, 1);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "x.tif"));
}

TEST_F(ExportCommand, MakesAMeshOfAPart) {
  const Outcome run = make("made.glb", {"--extent", "170,-20,-170,10"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("level 6"), std::string::npos) << run.err;
  EXPECT_EQ(cli::text_of(folder_ / "made.glb").substr(0, 4), "glTF");
  const std::string mesh = (folder_ / "other.glb").string();
  cli::expect_refusals("export", {{{planet_, "-o", mesh}, 2},
                                  {{planet_, "-o", mesh, "--extent", "0,0,9,9", "--range", "0,1"}, 2},
                                  {{planet_, "-o", mesh, "--extent", "0,0,180,9"}, 2}});
}

TEST_F(ExportCommand, RefusesBadRequestsWithOneLine) {
  const std::string map = (folder_ / "made.tif").string();
  cli::expect_refusals("export", {{{planet_}, 2},
                                  {{planet_, "-o", (folder_ / "map.jpg").string()}, 2},
                                  {{planet_, "-o", map, "--size", "40"}, 2},
                                  {{planet_, "-o", map, "--size", "0x40"}, 2},
                                  {{planet_, "-o", map, "--size", "9999999x9999999"}, 2},
                                  {{planet_, "-o", map, "--extent", "1,2,3"}, 2},
                                  {{planet_, "-o", map, "--extent", "0,-91,10,20"}, 2},
                                  {{planet_, "-o", map, "--extent", "0,10,10,10"}, 2},
                                  {{planet_, "-o", map, "--range", "5,5"}, 2},
                                  {{planet_, "-o", map, "--filter", "magic"}, 2},
                                  {{planet_, "-o", map, "--level", "99"}, 2},
                                  {{planet_, "-o", map, "--layer", "soil"}, 2},
                                  {{planet_, "-o", (folder_ / "no/map.tif").string(), "--quiet"}, 1},
                                  {{(folder_ / "nowhere").string(), "-o", map}, 1}});
  EXPECT_FALSE(std::filesystem::exists(map));
  ASSERT_EQ(make("made.tif", {"--quiet"}).status, 0);
  const Outcome again = make("made.tif", {"--quiet"});
  EXPECT_EQ(again.status, 1);
  EXPECT_NE(again.err.find("--overwrite"), std::string::npos);
  EXPECT_EQ(make("made.tif", {"--quiet", "--overwrite"}).status, 0);
}

TEST_F(ExportCommand, AFullDiskLeavesNothing) {
  for (const char* name : {"made.tif", "made.png", "made.exr"}) {
    const pid_t child = ::fork();
    if (child == 0) {
      const rlimit limit{20000, 20000};
      ::setrlimit(RLIMIT_FSIZE, &limit);
      ::signal(SIGXFSZ, SIG_IGN);
      const std::string errors = (folder_ / "errors").string();
      if (std::freopen(errors.c_str(), "w", stderr) == nullptr) ::_exit(127);
      cli::become_program(
          {"export", planet_, "-o", (folder_ / name).string(), "--size", "1536x768", "--quiet"}, false);
    }
    EXPECT_EQ(cli::wait_for(child), 1) << name;
    const std::string errors = cli::text_of(folder_ / "errors");
    EXPECT_NE(errors.find("cannot be written"), std::string::npos) << errors;
    EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 1) << errors;
  }
  EXPECT_EQ(folder_.contents().count("made.tif"), 0U);
  for (const std::string& file : folder_.contents())
    EXPECT_EQ(file.find("partial"), std::string::npos) << file;
}

TEST_F(ExportCommand, KilledAtAnyMomentLeavesNothingUnderTheFinalName) {
  const tests::TemporaryFolder streams;
  const std::vector<std::string> words{"export", planet_,    "-o",      (folder_ / "made.tif").string(),
                                       "--size", "1536x768", "--quiet", "--overwrite"};
  ASSERT_EQ(run_program(words).status, 0);
  const std::string reference = cli::text_of(folder_ / "made.tif");
  std::filesystem::remove(folder_ / "made.tif");
  int unfinished = 0;
  for (int k = 0; k < 6; ++k) {
    const pid_t child = cli::start(words, streams.path());
    std::this_thread::sleep_for(std::chrono::milliseconds(40 * k + 20));
    ::kill(child, k % 2 == 0 ? SIGKILL : SIGTERM);
    cli::wait_for(child);
    if (std::filesystem::exists(folder_ / "made.tif")) {
      EXPECT_TRUE(cli::text_of(folder_ / "made.tif") == reference);
      std::filesystem::remove(folder_ / "made.tif");
    } else {
      ++unfinished;
    }
  }
  EXPECT_GT(unfinished, 0);
}

}  // namespace
