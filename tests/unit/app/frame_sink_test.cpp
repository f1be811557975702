#include "app/frame_sink.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "globe/base/error.h"
#include "tests/temporary_folder.h"

namespace app {
namespace {

using tests::bytes_of;
using tests::TemporaryFolder;
using Names = std::set<std::string>;

constexpr int kWidth = 64, kHeight = 48;

/// A picture whose colour tells its number.
std::vector<std::uint8_t> frame(int number, int width = kWidth, int height = kHeight) {
  std::vector<std::uint8_t> rgba;
  for (int i = 0; i < width * height; ++i) {
    rgba.insert(rgba.end(),
                {static_cast<std::uint8_t>(20 * number), static_cast<std::uint8_t>(i % 256), 128, 0});
  }
  return rgba;
}

FrameOutput output_of(const std::filesystem::path& path) { return {path.string(), kWidth, kHeight}; }

void film(const FrameOutput& output, int frames) {
  FrameSink sink(output);
  for (int k = 0; k < frames; ++k) sink.write(frame(k, output.width, output.height));
  sink.finish();
}

std::string message_of(const FrameOutput& output, int frames = 1) {
  try {
    film(output, frames);
  } catch (const globe::Error& error) {
    return error.what();
  }
  return "";
}

bool has_ffmpeg() { return std::system("ffmpeg -version >/dev/null 2>&1") == 0; }
bool has_ffprobe() { return std::system("ffprobe -version >/dev/null 2>&1") == 0; }

/// "width,height,pix_fmt,rate,frames" of a film's pictures.
std::string probe(const std::filesystem::path& path) {
  const std::string command =
      "ffprobe -v error -count_frames -select_streams v:0 -show_entries "
      "stream=width,height,pix_fmt,r_frame_rate,nb_read_frames -of csv=p=0 '" +
      path.string() + "'";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  char line[256] = "";
  const char* got = std::fgets(line, sizeof line, pipe);
  ::pclose(pipe);
  std::string text = got == nullptr ? "" : line;
  while (!text.empty() && text.back() == '\n') text.pop_back();
  return text;
}

class Film : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!has_ffmpeg()) GTEST_SKIP() << "no ffmpeg";
  }
};

TEST(FrameRate, IsAFractionOfWholeNumbers) {
  const auto text = [](double fps) {
    const FrameRate rate = frame_rate(fps);
    return std::to_string(rate.numerator) + "/" + std::to_string(rate.denominator);
  };
  EXPECT_EQ(text(30), "30/1");
  EXPECT_EQ(text(29.97), "30000/1001");
  EXPECT_EQ(text(23.976), "24000/1001");
  EXPECT_EQ(text(59.94), "60000/1001");
  EXPECT_EQ(text(12.5), "12500/1000");
  EXPECT_EQ(text(0.5), "500/1000");
  EXPECT_THROW(frame_rate(0), globe::UsageError);
  EXPECT_THROW(frame_rate(-1), globe::UsageError);
  EXPECT_THROW(frame_rate(std::nan("")), globe::UsageError);
}

TEST(FrameSink, NumbersPicturesFromZero) {
  const TemporaryFolder folder;
  film(output_of(folder / "frames/####.png"), 3);
  EXPECT_EQ(folder.contents(), (Names{"frames", "frames/0000.png", "frames/0001.png", "frames/0002.png"}));
  film(output_of(folder / "f%03d.png"), 2);
  EXPECT_EQ(folder.contents().count("f001.png"), 1u);
  film(output_of(folder / "wide#.png"), 11);
  EXPECT_EQ(folder.contents().count("wide10.png"), 1u);
}

TEST(FrameSink, KeepsTheOrderOfTheFrames) {
  const TemporaryFolder folder;
  film(output_of(folder / "#.png"), 10);
  for (int k = 0; k < 10; ++k) {
    const auto input = OIIO::ImageInput::open((folder / (std::to_string(k) + ".png")).string());
    ASSERT_TRUE(input);
    std::vector<std::uint8_t> rgb(kWidth * kHeight * 3);
    ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, rgb.data()));
    EXPECT_EQ(rgb[0], 20 * k);
    EXPECT_EQ(rgb[4], 1);
  }
}

TEST(FrameSink, RefusesASequenceThatExists) {
  const TemporaryFolder folder;
  film(output_of(folder / "##.png"), 5);
  EXPECT_NE(message_of(output_of(folder / "##.png")).find("--overwrite"), std::string::npos);
  FrameOutput output = output_of(folder / "##.png");
  output.overwrite = true;
  std::ofstream(folder / "notes.png") << "not of the sequence";
  film(output, 3);
  EXPECT_EQ(folder.contents(), (Names{"00.png", "01.png", "02.png", "notes.png"}));
}

TEST(FrameSink, LeavesNoPicturesBehindUnfinished) {
  const TemporaryFolder folder;
  {
    FrameSink sink(output_of(folder / "a/b/####.png"));
    for (int k = 0; k < 6; ++k) sink.write(frame(k));
  }
  EXPECT_EQ(folder.contents(), Names{});
}

TEST(FrameSink, UnknownOutputsAreAMatterOfUsage) {
  const TemporaryFolder folder;
  for (const char* name : {"a.avi", "a.png", "####.jpg", "a", "#a#.png", "%05x.png", "%s.png"}) {
    EXPECT_THROW(FrameSink(output_of(folder / name)), globe::UsageError) << name;
  }
  FrameOutput output = output_of(folder / "a.mp4");
  output.fps = -3;
  EXPECT_THROW(FrameSink{output}, globe::UsageError);
  EXPECT_EQ(folder.contents(), Names{});
}

TEST(FrameSink, AFilmWithoutFramesIsAnError) {
  const TemporaryFolder folder;
  EXPECT_NE(message_of(output_of(folder / "#.png"), 0), "");
  EXPECT_EQ(folder.contents(), Names{});
}

TEST(FrameSink, MissingFfmpegIsSaidAtOnce) {
  const TemporaryFolder folder;
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  std::string message;
  try {
    FrameSink sink(output_of(folder / "a.mp4"));
  } catch (const globe::Error& error) {
    message = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(message.find("ffmpeg: there is no such program"), std::string::npos) << message;
  EXPECT_NE(message.find("apt install ffmpeg"), std::string::npos) << message;
  EXPECT_EQ(folder.contents(), Names{});
}

TEST_P(Film, HasEveryFrame) {
  if (!has_ffprobe()) GTEST_SKIP() << "no ffprobe";
  const TemporaryFolder folder;
  FrameOutput output = output_of(folder / GetParam());
  output.fps = 25;
  film(output, 7);
  EXPECT_EQ(folder.contents(), Names{GetParam()});
  const std::string format = std::string(GetParam()) == "a.mp4" ? "yuv420p" : "bgra";
  EXPECT_EQ(probe(folder / GetParam()), "64,48," + format + ",25/1,7");
}

/// Bytes of the first frame as ffmpeg decodes it, RGBA.
std::string first_frame(const std::filesystem::path& path) {
  const std::string command =
      "ffmpeg -v error -i '" + path.string() + "' -frames:v 1 -f rawvideo -pix_fmt rgba - </dev/null";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string bytes(kWidth * kHeight * 4, '\0');
  bytes.resize(std::fread(bytes.data(), 1, bytes.size(), pipe));
  ::pclose(pipe);
  return bytes;
}

TEST_P(Film, ShowsTheColoursAndNoTransparency) {
  const TemporaryFolder folder;
  FrameSink sink(output_of(folder / GetParam()));
  std::vector<std::uint8_t> orange;
  for (int i = 0; i < kWidth * kHeight; ++i) orange.insert(orange.end(), {230, 120, 30, 0});
  for (int k = 0; k < 3; ++k) sink.write(orange);
  sink.finish();
  const std::string seen = first_frame(folder / GetParam());
  ASSERT_EQ(seen.size(), orange.size());
  constexpr int kColourLoss = 4;  // 8-bit YUV and back
  for (std::size_t i = 0; i < seen.size(); ++i) {
    const int expected = i % 4 == 3 ? 255 : orange[i];
    ASSERT_NEAR(static_cast<std::uint8_t>(seen[i]), expected, kColourLoss) << i;
  }
}

TEST_P(Film, HasTheSameBytesEveryTime) {
  const TemporaryFolder folder;
  film(output_of(folder / GetParam()), 5);
  const std::string first = bytes_of(folder / GetParam());
  FrameOutput again = output_of(folder / GetParam());
  again.overwrite = true;
  film(again, 5);
  EXPECT_EQ(bytes_of(folder / GetParam()), first);
  EXPECT_FALSE(first.empty());
}

TEST_P(Film, IsRefusedWhenItExists) {
  const TemporaryFolder folder;
  std::ofstream(folder / GetParam()) << "mine";
  EXPECT_NE(message_of(output_of(folder / GetParam())).find("--overwrite"), std::string::npos);
  EXPECT_EQ(bytes_of(folder / GetParam()), "mine");
}

TEST_P(Film, LeavesNothingBehindUnfinished) {
  const TemporaryFolder folder;
  {
    FrameSink sink(output_of(folder / GetParam()));
    for (int k = 0; k < 8; ++k) sink.write(frame(k));
  }
  EXPECT_EQ(folder.contents(), Names{});
}

INSTANTIATE_TEST_SUITE_P(FrameSink, Film, testing::Values("a.mp4", "a.gif"),
                         [](const auto& row) { return std::string(row.param).substr(2); });

TEST(FrameSink, OddSizesBecomeEvenInMp4) {
  if (!has_ffprobe()) GTEST_SKIP() << "no ffprobe";
  const TemporaryFolder folder;
  film({(folder / "a.mp4").string(), 33, 17}, 2);
  EXPECT_EQ(probe(folder / "a.mp4"), "34,18,yuv420p,30/1,2");
}

TEST(FrameSink, AnEncoderThatDiesIsReportedAndTidiedUp) {
  if (!has_ffmpeg()) GTEST_SKIP() << "no ffmpeg";
  const TemporaryFolder folder;
  const std::string path = std::getenv("PATH");
  std::ofstream(folder / "ffmpeg") << "#!/bin/sh\necho the disk is made of cheese >&2\nexit 3\n";
  std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
  setenv("PATH", (std::filesystem::path(folder / "").string() + ":" + path).c_str(), 1);
  const std::string message = message_of(output_of(folder / "a.mp4"), 300);
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(message.find("the disk is made of cheese"), std::string::npos) << message;
  EXPECT_EQ(folder.contents(), Names{"ffmpeg"});
}

TEST(FrameSink, Y4mCarriesEveryPixel) {
  std::FILE* file = std::tmpfile();
  FrameOutput output{"-", 4, 2};
  output.standard_output = file;
  FrameSink sink(output);
  // White, black, red, grey; the second row blue.
  const std::vector<std::uint8_t> rgba = {255, 255, 255, 0, 0, 0, 0,   0, 255, 0, 0,   0, 128, 128, 128, 0,
                                          0,   0,   255, 0, 0, 0, 255, 0, 0,   0, 255, 0, 0,   0,   255, 0};
  sink.write(rgba);
  sink.write(rgba);
  sink.finish();
  std::rewind(file);
  std::string text(1000, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file));
  std::fclose(file);
  const std::string header = "YUV4MPEG2 W4 H2 F30:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n";
  ASSERT_EQ(text.substr(0, header.size()), header);
  ASSERT_EQ(text.size(), header.size() + 2 * (6 + 24));
  const std::string planes = text.substr(header.size() + 6, 24);
  const auto at = [&](std::size_t i) { return static_cast<int>(static_cast<std::uint8_t>(planes[i])); };
  // BT.601 of the standard: white 235 128 128, black 16 128 128, red 81 90 240, blue 41 240 110.
  EXPECT_EQ(at(0), 235);
  EXPECT_EQ(at(1), 16);
  EXPECT_EQ(at(2), 81);
  EXPECT_EQ(at(3), 126);
  EXPECT_EQ(at(4), 41);
  EXPECT_EQ(at(8), 128);
  EXPECT_EQ(at(10), 90);
  EXPECT_EQ(at(12), 240);
  EXPECT_EQ(at(18), 240);
  EXPECT_EQ(at(20), 110);
}

TEST(FrameSink, Y4mThatNobodyTakesIsAnError) {
  std::FILE* full = std::fopen("/dev/full", "w");
  if (full == nullptr) GTEST_SKIP() << "no /dev/full";
  FrameOutput output{"-", kWidth, kHeight};
  output.standard_output = full;
  EXPECT_NE(message_of(output, 20).find("standard output"), std::string::npos);
  std::fclose(full);
}

}  // namespace
}  // namespace app
