#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <string>

#include "app/view/eye.h"
#include "globe/geo/ellipsoid.h"
#include "tests/window/screen.h"

// `globe view` as a person has it: real events of keys and pointer on a screen without glass. What it did is
// told by how it remembers to have been left, and by other commands.

namespace {

namespace geo = globe::geo;
using app::Standpoint;
using nlohmann::json;
using window::rest;
using window::Screen;
using window::ViewProgram;

constexpr int kWidth = 640, kHeight = 480;

/// What a command writes.
std::string output_of(const std::string& command) {
  std::FILE* pipe = popen(command.c_str(), "r");
  std::string out;
  for (int c = 0; (c = std::fgetc(pipe)) != EOF;) out += static_cast<char>(c);
  pclose(pipe);
  return out;
}

std::string words_of(const Standpoint& stand) {
  char text[200];
  std::snprintf(text, sizeof text, "--at %.17g,%.17g,%.17g --look %.17g,%.17g", stand.place.lat_deg,
                stand.place.lon_deg, stand.place.h_m, stand.look.heading_deg, stand.look.pitch_deg);
  return text;
}

/// What `globe pick` sees at a pixel, ECEF.
glm::dvec3 picked(const Standpoint& stand, int x, int y) {
  const json answer =
      json::parse(output_of(std::string(GLOBE_PROGRAM) + " pick procedural " + words_of(stand) + " --size " +
                            std::to_string(kWidth) + "x" + std::to_string(kHeight) + " --pixel " +
                            std::to_string(x) + "," + std::to_string(y) + " --json"));
  return geo::ecef_from_geodetic(geo::kWgs84, {answer["lat"], answer["lon"], answer["height_m"]});
}

double miss(const Standpoint& stand, const glm::dvec3& place, int x, int y) {
  const app::view::Eye eye{geo::kWgs84, 60.0, {kWidth, kHeight}};
  const auto seen = eye.pixel_of(eye.camera(stand), place);
  return seen ? glm::distance(*seen, glm::dvec2(x + 0.5, y + 0.5)) : 1e9;
}

Standpoint stand_of(const json& left) {
  return {{left["lat"], left["lon"], left["alt_m"]}, {left["heading"], left["pitch"]}};
}

class View : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v Xvfb xdotool >/dev/null") != 0)
      GTEST_SKIP() << "Xvfb or xdotool is missing: ./dev test installs them";
    screen_ = std::make_unique<Screen>();
    ASSERT_TRUE(screen_->is_there());
  }

  /// A window on the built-in planet, at rest.
  std::unique_ptr<ViewProgram> open(const Standpoint& stand, const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"procedural", "--folder", folder_.path().string(), "--size",
                                   std::to_string(kWidth) + "x" + std::to_string(kHeight)};
    char at[128], look[64];
    std::snprintf(at, sizeof at, "%.17g,%.17g,%.17g", stand.place.lat_deg, stand.place.lon_deg,
                  stand.place.h_m);
    std::snprintf(look, sizeof look, "%.17g,%.17g", stand.look.heading_deg, stand.look.pitch_deg);
    words.insert(words.end(), {"--at", at, "--look", look});
    words.insert(words.end(), more.begin(), more.end());
    auto program = std::make_unique<ViewProgram>(*screen_, words, folder_.path());
    EXPECT_TRUE(program->await_rest()) << program->text("err");
    return program;
  }

  void drag(const char* button, int x0, int y0, int x1, int y1) const {
    screen_->move_to(x0, y0);
    screen_->hands({"mousedown", button});
    for (int k = 1; k <= 8; ++k) {
      screen_->move_to(x0 + (x1 - x0) * k / 8, y0 + (y1 - y0) * k / 8);
      rest(30);
    }
    rest(1000);  // nothing rolls on
    screen_->hands({"mouseup", button});
    rest(200);
  }

  std::unique_ptr<Screen> screen_;
  tests::TemporaryFolder folder_;
};

TEST_F(View, GrabAndDragKeepsThePlaceUnderThePointer) {
  const Standpoint start{{35.0, -100.0, 3e6}, {30.0, -80.0}};
  const auto program = open(start, {"--overlay", "off"});
  drag("1", 320, 240, 460, 150);
  ASSERT_TRUE(program->await_rest());
  EXPECT_EQ(program->close(), 0) << program->text("err");
  const Standpoint end = stand_of(program->left());
  EXPECT_GT(miss(end, picked(start, 320, 240), 320, 240), 100.0);
  EXPECT_LT(miss(end, picked(start, 320, 240), 460, 150), 2.0);
}

TEST_F(View, TheWheelKeepsThePlaceUnderThePointer) {
  const Standpoint start{{-20.0, 60.0, 8e6}, {0.0, -90.0}};
  const auto program = open(start, {"--overlay", "off"});
  screen_->move_to(420, 170);
  for (int k = 0; k < 8; ++k) screen_->hands({"click", "4"});
  rest(700);
  ASSERT_TRUE(program->await_rest());
  EXPECT_EQ(program->close(), 0) << program->text("err");
  const Standpoint end = stand_of(program->left());
  EXPECT_LT(end.place.h_m, 2.5e6);
  EXPECT_LT(miss(end, picked(start, 420, 170), 420, 170), 2.0);
}

TEST_F(View, ARightDragTiltsAroundTheMiddle) {
  const Standpoint start{{10.0, 20.0, 2e6}, {0.0, -90.0}};
  const auto program = open(start);
  drag("3", 420, 300, 420, 240);
  ASSERT_TRUE(program->await_rest());
  EXPECT_EQ(program->close(), 0) << program->text("err");
  const Standpoint end = stand_of(program->left());
  EXPECT_GT(end.look.pitch_deg, -80.0);
  EXPECT_LT(miss(end, picked(start, kWidth / 2, kHeight / 2), kWidth / 2, kHeight / 2), 2.0);
}

TEST_F(View, ASearchFliesToThePlace) {
  const auto program = open({{0.0, 0.0, 1.5e7}, {0.0, -90.0}});
  screen_->hands({"key", "ctrl+f"});
  rest(300);
  screen_->hands({"type", "--delay", "60", "10.25 N 20.5 E"});
  screen_->hands({"key", "Return"});
  rest(1500);
  ASSERT_TRUE(program->await_rest());
  EXPECT_EQ(program->close(), 0) << program->text("err");
  const Standpoint end = stand_of(program->left());
  EXPECT_LT(end.place.h_m, 3e4);
  const geo::Geodetic middle = geo::geodetic_from_ecef(geo::kWgs84, picked(end, kWidth / 2, kHeight / 2));
  EXPECT_NEAR(middle.lat_deg, 10.25, 0.01);
  EXPECT_NEAR(middle.lon_deg, 20.5, 0.01);
}

std::vector<std::uint8_t> pixels_of(const std::string& path) {
  const auto input = OIIO::ImageInput::open(path);
  std::vector<std::uint8_t> all;
  if (!input) return all;
  all.resize(static_cast<std::size_t>(input->spec().image_pixels()) * 3);
  input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, all.data());
  return all;
}

/// Has a picture saved, closes the window, and draws the picture anew by the command that was told.
void expect_the_same_picture(const Screen& screen, ViewProgram& program,
                             const std::filesystem::path& folder) {
  screen.hands({"key", "p"});
  const std::string file = (folder / "globe-1.png").string();
  ASSERT_TRUE(ViewProgram::await([&] { return std::filesystem::exists(file); }));
  EXPECT_EQ(program.close(), 0) << program.text("err");
  std::string line = program.text("out");
  ASSERT_TRUE(line.starts_with("globe ")) << line;
  const std::size_t name = line.rfind(" -o ");
  const std::string shot = (folder / "shot.png").string();
  output_of(GLOBE_PROGRAM + line.substr(5, name - 5) + " -o " + shot + " --device software");
  EXPECT_FALSE(pixels_of(file).empty());
  EXPECT_TRUE(pixels_of(file) == pixels_of(shot)) << line;
}

TEST_F(View, APictureIsTheOneThatItsCommandDraws) {
  const auto program = open({{36.0, -105.0, 9e5}, {20.0, -50.0}}, {"--graticule", "--with", "clouds"});
  drag("1", 500, 240, 520, 260);
  screen_->hands({"key", "space"});  // the clouds stand
  ASSERT_TRUE(program->await_rest());
  expect_the_same_picture(*screen_, *program, folder_.path());
}

TEST_F(View, APictureOfFractalGroundIsTheOneThatItsCommandDraws) {
  ViewProgram program(*screen_, {"fractal:3", "--size", "320x240", "--folder", folder_.path().string()},
                      folder_.path());
  ASSERT_TRUE(program.await_rest()) << program.text("err");
  screen_->move_to(200, 120);
  screen_->hands({"click", "4"});
  rest(700);
  ASSERT_TRUE(program.await_rest());
  expect_the_same_picture(*screen_, program, folder_.path());
}

TEST_F(View, AWindowOfAnotherSizeHasAnotherPicture) {
  const auto program = open({{36.0, -105.0, 9e6}, {0.0, -90.0}});
  screen_->hands({"search", "--name", "globe - ", "windowsize", "--sync", "500", "300"});
  rest(500);
  ASSERT_TRUE(program->await_rest());
  screen_->hands({"key", "p"});
  const std::string file = (folder_ / "globe-1.png").string();
  ASSERT_TRUE(ViewProgram::await([&] { return std::filesystem::exists(file); }));
  EXPECT_EQ(program->close(), 0) << program->text("err");
  const auto input = OIIO::ImageInput::open(file);
  EXPECT_EQ(input->spec().width, 500);
  EXPECT_EQ(input->spec().height, 300);
}

TEST_F(View, OpensAgainAsItWasLeft) {
  const Standpoint start{{51.5, 7.25, 4e6}, {15.0, -75.0}};
  ASSERT_EQ(open(start)->close(), 0);
  ViewProgram again(*screen_, {"procedural", "--size", "640x480"}, folder_.path());
  ASSERT_TRUE(again.await_rest());
  EXPECT_EQ(again.close(), 0);
  const Standpoint end = stand_of(again.left());
  EXPECT_EQ(end.place.lat_deg, 51.5);
  EXPECT_EQ(end.place.h_m, 4e6);
  EXPECT_EQ(end.look.heading_deg, 15.0);
}

/// Kilobytes that a process holds.
long resident_kb(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("VmRSS:")) return std::stol(line.substr(6));
  }
  return 0;
}

TEST_F(View, AFlightOfManyFramesHoldsNoMoreAndMoreMemory) {
  const bool full = std::getenv("GLOBE_TEST_FULL") != nullptr;
  const int frames = full ? 10'000 : 400;
  // Four times round the same ground, with caches that are soon full.
  std::ofstream scene(folder_ / "round.toml");
  scene << "planet = \"procedural\"\n[path]\n";
  for (int k = 0; k <= 16; ++k) {
    constexpr std::array kPlaces{"10,20,2000km", "12,22,30km", "13,21,5km", "11,21,200km"};
    scene << "[[path.keys]]\nat = \"" << kPlaces[static_cast<std::size_t>(k % 4)] << "\"\ntime = " << 10 * k
          << '\n';
  }
  scene.close();
  std::vector<std::string> environment = screen_->environment();
  environment.push_back("XDG_STATE_HOME=" + (folder_ / "state").string());
  const pid_t child =
      window::spawn({GLOBE_PROGRAM, "view", (folder_ / "round.toml").string(), "--play", "--frames",
                     std::to_string(frames), "--size", "96x64", "--detail", "32", "--memory", "64"},
                    environment, (folder_ / "out").string(), (folder_ / "err").string());
  std::vector<long> held;
  int status = 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    held.push_back(resident_kb(child));
    rest(full ? 1000 : 100);
  }
  std::ifstream err(folder_ / "err");
  const std::string told{std::istreambuf_iterator<char>(err), {}};
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << told;
  EXPECT_EQ(told, "");
  std::ifstream out(folder_ / "out");
  const std::string figures{std::istreambuf_iterator<char>(out), {}};
  EXPECT_TRUE(figures.starts_with("first picture ")) << figures;
  EXPECT_NE(figures.find("\nframes " + std::to_string(frames) + '\n'), std::string::npos) << figures;
  ASSERT_GT(held.size(), 8u);
  if (!full) return;
  // The last round against the second.
  const auto most = [&](std::size_t from, std::size_t to) {
    return *std::max_element(held.begin() + static_cast<std::ptrdiff_t>(from),
                             held.begin() + static_cast<std::ptrdiff_t>(to));
  };
  const std::size_t n = held.size();
  EXPECT_LT(most(n * 3 / 4, n), most(n / 4, n / 2) + 10'000);
}

TEST(ViewWithoutAScreen, SaysSoInALineAndWhatToDo) {
  const tests::TemporaryFolder folder;
  const int status = window::wait_for(
      window::spawn({"env", "-u", "DISPLAY", "-u", "WAYLAND_DISPLAY", GLOBE_PROGRAM, "view", "procedural"},
                    {}, "/dev/null", (folder / "err").string()));
  EXPECT_EQ(status, 1);
  std::ifstream err(folder / "err");
  const std::string told{std::istreambuf_iterator<char>(err), {}};
  EXPECT_TRUE(told.starts_with("globe: no window: there is no screen here")) << told;
  EXPECT_NE(told.find("globe shot and globe fly"), std::string::npos);
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1);
}

TEST(ViewOptions, ThatMakeNoSenseAreRefusedBeforeAWindowOpens) {
  for (const char* words : {"nowhere", "procedural --play", "procedural --projection fisheye",
                            "procedural --frames 0", "procedural --sun 95,0", "procedural --with nothing",
                            "procedural --without sea", "procedural --time 2026-01-01 --sun 1,2",
                            "procedural --detail 3", "procedural --features /etc/passwd"}) {
    const std::string told = output_of("env -u DISPLAY -u WAYLAND_DISPLAY " + std::string(GLOBE_PROGRAM) +
                                       " view " + words + " 2>&1");
    EXPECT_TRUE(told.starts_with("globe: ")) << words;
    EXPECT_EQ(told.find("screen"), std::string::npos) << words << ": " << told;
    EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
  }
}

}  // namespace
