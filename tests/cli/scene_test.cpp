#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/make_planet.h"
#include "tests/cli/refusals.h"
#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

// Scenes through the program: shot, fly and pick take one in place of the planet.

namespace {

using cli::Outcome;
using cli::run_program;
using cli::with;
using nlohmann::json;
using tests::TemporaryFolder;

const std::string kScenes = std::string(GLOBE_SOURCE_DIR) + "/scenes/";

class Scenes : public testing::Test {
 protected:
  void SetUp() override {
    const Outcome run = run_program({"shot", "procedural", "-o", (folder_ / "probe.png").string(), "--at",
                                     "1 2 1e6", "--size", "32x16", "--detail", "16"});
    if (run.status != 0) GTEST_SKIP() << "NO GRAPHICS HERE: " << run.err;
  }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  /// A picture's bytes; the run must be silent.
  std::string shot(std::vector<std::string> words) const {
    const std::string picture = file("shot.png");
    words.insert(words.begin(), "shot");
    words.insert(words.end(), {"-o", picture, "--overwrite", "--quiet"});
    const Outcome run = run_program(words);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.err, "");
    return cli::text_of(picture);
  }

  TemporaryFolder folder_;
};

const std::vector<std::string> kSmall{"--size", "64x48", "--detail", "16"};

TEST_F(Scenes, ALayerLeftOutIsNotDrawn) {
  cli::make_planet(folder_.path(), {"--ellipsoid", "moon"});
  const Outcome made = run_program({"convert", file("map.tif"), "--color", file("map.tif"), "--ellipsoid",
                                    "moon", "-o", file("colored"), "--quiet"});
  ASSERT_EQ(made.status, 0) << made.err;
  const std::vector<std::string> look = with({"--at", "10,20,200km"}, kSmall);
  const std::string camera = "\n[sun]\noverhead = \"0,0\"\n";
  const std::string bare =
      shot(with({write("bare.toml", "planet = \"colored\"" + camera + "[layers]\ncolor = false\n")}, look));
  EXPECT_EQ(bare, shot(with({write("plain.toml", "planet = \"planet\"" + camera)}, look)));
  EXPECT_NE(bare, shot(with({write("whole.toml", "planet = \"colored\"" + camera)}, look)));
}

TEST_F(Scenes, APictureOfOneIsThatOfTheSameWords) {
  const std::string scene = write("s.toml", R"(
planet = "procedural:3"
[picture]
size = "64x48"
detail = 16
fov = 40
exaggeration = 2
[camera]
at = "46,7,4000"
agl = true
look = "120,-10"
[sun]
time = 2026-06-21T07:00:00Z
)");
  const std::vector<std::string> words{
      "procedural:3", "--size",    "64x48", "--detail", "16",      "--exaggeration", "2",
      "--at",         "46,7,4000", "--agl", "--look",   "120,-10", "--time",         "2026-06-21T07:00:00Z"};
  const std::string picture = shot({scene});
  EXPECT_EQ(picture, shot(with(words, {"--fov", "40"})));
  EXPECT_EQ(shot({scene, "--fov", "50"}), shot(with(words, {"--fov", "50"})));  // the command line wins
  EXPECT_NE(picture, shot(with(words, {"--fov", "50"})));
  EXPECT_NE(picture, shot({scene, "--time", "2026-06-21T12:00:00Z"}));
  const Outcome pick = run_program({"pick", scene, "--pixel", "32,40", "--json"});
  EXPECT_EQ(pick.out,
            run_program(with(with({"pick"}, words), {"--fov", "40", "--pixel", "32,40", "--json"})).out);
  EXPECT_FALSE(json::parse(pick.out)["sky"].get<bool>());
}

TEST_F(Scenes, TheSunStandsWhereItIsSaidTo) {
  const auto brightness = [&](const std::string& sun) {
    const std::string scene = write("s.toml", "[camera]\nat = '20,30,3000km'\n[sun]\n" + sun);
    const std::string picture = file("sun.exr");
    const Outcome run = run_program(
        with({"shot", scene, "-o", picture, "--overwrite"}, {"--size", "16x16", "--detail", "16"}));
    EXPECT_EQ(run.status, 0) << run.err;
    std::vector<float> rgba(16 * 16 * 4);
    const auto image = OIIO::ImageInput::open(picture);
    EXPECT_TRUE(image && image->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, rgba.data()));
    return static_cast<double>(rgba[(8 * 16 + 8) * 4 + 2]);
  };
  EXPECT_NEAR(brightness("overhead = '20,30'"), brightness("azimuth = 0\naltitude = 90"), 0.01);
  EXPECT_GT(brightness("overhead = '20,30'"), 2.0 * brightness("overhead = '-20,-150'"));
}

TEST_F(Scenes, FlightsFollowTheirPaths) {
  const std::string scene = write("s.toml", R"(
[picture]
size = "64x48"
detail = 16
[path]
fps = 4
[[path.keys]]
time = 0
at = "10,20,2000km"
[[path.keys]]
time = 1
at = "12,21,1000km"
look = "30,-60"
[[path.keys]]
time = 2
at = "15,21,800km"
)");
  const auto frames = [&](const std::vector<std::string>& more) {
    const std::string stats = file("s.json");
    const Outcome run = run_program(with(
        {"fly", scene, "-o", file("####.png"), "--stats", stats, "--overwrite", "--quiet", "--wait"}, more));
    EXPECT_EQ(run.status, 0) << run.err;
    return json::parse(cli::text_of(stats))["frames"];
  };
  const json nine = frames({});
  ASSERT_EQ(nine.size(), 9u);
  EXPECT_NEAR(nine[4]["lat"].get<double>(), 12.0, 1e-9);
  EXPECT_NEAR(nine[4]["alt_m"].get<double>(), 1e6, 1.0);
  EXPECT_NEAR(nine[8]["lat"].get<double>(), 15.0, 1e-9);
  const std::string middle = cli::text_of(file("0004.png"));
  const json five = frames({"--fps", "2"});  // the same way, whatever the frames
  ASSERT_EQ(five.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(five[k]["lat"], nine[2 * k]["lat"]);
    EXPECT_EQ(five[k]["alt_m"], nine[2 * k]["alt_m"]);
  }
  EXPECT_EQ(cli::text_of(file("0002.png")), middle);
  EXPECT_EQ(shot({scene, "--moment", "1"}), middle);
  EXPECT_EQ(frames({"--frames", "3"}).size(), 3u);
  EXPECT_EQ(frames({"--frames", "2", "--to", "10 20"}).back()["lat"], 10.0);  // no path any more
}

TEST_F(Scenes, ARolledPictureIsTheLevelOneTurned) {
  // 64 pixels across 0.5 times the tangent of half of 60 degrees and 48 up, or the other way round.
  const double wide_fov = 2.0 * std::atan(std::tan(0.5) * 64.0 / 48.0);
  const auto picture = [&](const std::string& size, double fov_rad, const std::string& roll) {
    const std::string scene = write(
        "s.toml",
        "[picture]\nsize = '" + size + "'\nfov = " + std::to_string(fov_rad * 180.0 / 3.14159265358979) +
            "\ndetail = 64\n[camera]\nat = '-43.42,-106.43,1000'\nagl = true\nlook = '110,-8'\n" + roll);
    const std::string name = file("turned.exr");
    const Outcome run = run_program({"shot", scene, "-o", name, "--overwrite"});
    EXPECT_EQ(run.status, 0) << run.err;
    std::vector<float> rgba(64 * 48 * 4);
    const auto image = OIIO::ImageInput::open(name);
    EXPECT_TRUE(image && image->read_image(0, 0, 0, 4, OIIO::TypeDesc::FLOAT, rgba.data()));
    return rgba;
  };
  const std::vector<float> tall = picture("48x64", wide_fov, "");
  EXPECT_EQ(tall, picture("48x64", wide_fov, "roll = 0"));
  const auto difference = [&](const std::string& roll) {
    const std::vector<float> turned = picture("64x48", 1.0, roll);
    double sum = 0.0;
    for (std::size_t y = 0; y < 48; ++y) {
      for (std::size_t x = 0; x < 64; ++x) {
        // Clockwise the camera, so counter-clockwise the picture: its top was the right side.
        for (std::size_t c = 0; c < 3; ++c)
          sum += std::abs(turned[(y * 64 + x) * 4 + c] - tall[(x * 48 + 47 - y) * 4 + c]);
      }
    }
    return sum / (48 * 64 * 3);
  };
  EXPECT_LT(difference("roll = 90"), 0.002);  // levels and patches are chosen for a picture of other height
  EXPECT_GT(difference("roll = -90"), 0.05);
}

TEST_F(Scenes, EveryExampleIsDrawn) {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kScenes)) {
    if (entry.path().extension() != ".toml") continue;
    ++count;
    EXPECT_FALSE(shot(with({entry.path().string()}, kSmall)).empty()) << entry.path();
  }
  EXPECT_GE(count, 4u);
  for (const char* path : {"descent.toml", "tour.toml"}) {
    const Outcome run = run_program(with({"fly", kScenes + path, "-o", file(std::string(path) + "-####.png"),
                                          "--frames", "3", "--wait", "--quiet"},
                                         kSmall));
    EXPECT_EQ(run.status, 0) << run.err;
  }
}

TEST_F(Scenes, DepthOfWidePicturesIsAlongTheRayAndAgreesWithPick) {
  for (const char* projection : {"fisheye", "equirectangular"}) {
    const std::string depth = file("depth.exr");
    const std::vector<std::string> words{"procedural", "--at",    "46,7,4000", "--look", "120,-50",
                                         "--size",     "256x128", "--detail",  "16",     "--projection",
                                         projection,   "--axis",  "look"};
    const Outcome drawn =
        run_program(with(with({"shot"}, words), {"-o", depth, "--show", "depth", "--overwrite"}));
    ASSERT_EQ(drawn.status, 0) << drawn.err;
    std::vector<float> metres(256 * 128);
    const auto image = OIIO::ImageInput::open(depth);
    ASSERT_TRUE(image && image->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, metres.data()));
    std::string pixels;
    for (int k = 0; k < 256 * 128; k += 67)
      pixels += std::to_string(k % 256) + " " + std::to_string(k / 256) + "\n";
    const auto answers = run_program(with(with({"pick", "--json"}, words), {}), pixels).lines();
    std::size_t line = 0, ground = 0, apart = 0, outside = 0;
    for (int k = 0; k < 256 * 128; k += 67, ++line) {
      const json answer = json::parse(answers.at(line));
      const auto shown = static_cast<double>(metres[static_cast<std::size_t>(k)]);
      if (answer.contains("error")) {
        ++outside;
        EXPECT_EQ(shown, 0.0) << k;
        continue;
      }
      if (answer["sky"].get<bool>() || shown == 0.0) continue;
      ++ground;
      apart += std::abs(answer["distance_m"].get<double>() / shown - 1.0) > 0.1 ? 1 : 0;
    }
    EXPECT_GT(ground, 100u);
    EXPECT_LT(apart, ground / 10);  // by ridges and the horizon a pixel sees near and far
    EXPECT_EQ(outside > 10, std::string(projection) == "fisheye");
  }
}

TEST_F(Scenes, RefusesBadOnesWithOneLineThatNamesThePlace) {
  const std::string bad = write("bad.toml", "planet = \"procedural\"\n\n[picture]\nfovv = 3\n");
  for (const char* command : {"shot", "fly"}) {
    const Outcome run = run_program({command, bad, "-o", file("x.png")});
    EXPECT_EQ(run.status, 1);
    EXPECT_EQ(run.err, "globe: " + bad + ":4: picture.fovv: there is no such key; did you mean fov?\n");
  }
  const std::string empty = write("empty.toml", "");
  const std::string track = write("track.toml", "[path]\nfile = 'bad.kml'\n");
  write("bad.kml", "<kml>\n<a>\n</kml>");
  cli::expect_refusals(
      "shot",
      {cli::Refusal{{bad, "-o", file("x.png")}, 1}, cli::Refusal{{empty, "-o", file("x.png")}, 2},
       cli::Refusal{{track, "-o", file("x.png")}, 1},
       cli::Refusal{{file("none.toml"), "-o", file("x.png")}, 1},
       cli::Refusal{{"procedural", "--at", "0,0,1e6", "--fov", "171", "-o", file("x.png")}, 2},
       cli::Refusal{
           {"procedural", "--at", "0,0,1e6", "--projection", "fisheye", "--fov", "361", "-o", file("x.png")},
           2},
       cli::Refusal{{"procedural", "--at", "0,0,1e6", "--projection", "dome", "-o", file("x.png")}, 2}});
  cli::expect_refusals(
      "pick", {cli::Refusal{{bad, "--pixel", "0,0"}, 1}, cli::Refusal{{empty, "--pixel", "0,0"}, 2}});
  EXPECT_FALSE(std::filesystem::exists(file("x.png")));
}

}  // namespace
