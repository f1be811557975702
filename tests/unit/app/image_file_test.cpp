#include "app/image_file.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "globe/base/error.h"
#include "tests/temporary_folder.h"

namespace app {
namespace {

using tests::bytes_of;
using tests::TemporaryFolder;
using Names = std::set<std::string>;

std::vector<std::uint8_t> ramp(int width, int height) {
  std::vector<std::uint8_t> rgba(static_cast<std::size_t>(width * height) * 4);
  for (std::size_t i = 0; i < rgba.size(); ++i) rgba[i] = static_cast<std::uint8_t>(i * 7);
  return rgba;
}

TEST(ImageFile, PngHoldsTheColoursTopRowFirst) {
  const TemporaryFolder folder;
  const auto rgba = ramp(5, 3);
  write_image(folder / "a.png", {5, 3, rgba}, false);
  const auto input = OIIO::ImageInput::open((folder / "a.png").string());
  ASSERT_TRUE(input);
  EXPECT_EQ(input->spec().nchannels, 3);
  std::vector<std::uint8_t> seen(5 * 3 * 3);
  ASSERT_TRUE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, seen.data()));
  for (std::size_t i = 0; i < 15; ++i) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(seen[3 * i + c], rgba[4 * i + c]);
  }
}

TEST(ImageFile, ExrHoldsTheFloatsExactly) {
  const TemporaryFolder folder;
  const std::vector<float> depth = {0.1f, 1e8f, 3.0f, 1.0f / 3.0f, 12345.678f, 0.0f};
  write_image(folder / "a.exr", 3, 2, {"Z"}, depth, false);
  const auto input = OIIO::ImageInput::open((folder / "a.exr").string());
  ASSERT_TRUE(input);
  EXPECT_EQ(input->spec().channelnames, std::vector<std::string>{"Z"});
  std::vector<float> seen(6);
  ASSERT_TRUE(input->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, seen.data()));
  EXPECT_EQ(seen, depth);
}

TEST(ImageFile, BytesDoNotDependOnTheClock) {
  const TemporaryFolder folder;
  const auto rgba = ramp(16, 16);
  const std::vector<float> floats(16 * 16 * 3, 0.25f);
  const auto write_both = [&](const std::string& name) {
    write_image(folder / (name + ".png"), {16, 16, rgba}, false);
    write_image(folder / (name + ".exr"), 16, 16, {"R", "G", "B"}, floats, false);
  };
  write_both("first");
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  write_both("second");
  EXPECT_EQ(bytes_of(folder / "first.png"), bytes_of(folder / "second.png"));
  EXPECT_EQ(bytes_of(folder / "first.exr"), bytes_of(folder / "second.exr"));
  for (const char* name : {"first.png", "first.exr"}) {
    const std::string bytes = bytes_of(folder / name);
    EXPECT_EQ(bytes.find("OpenImageIO"), std::string::npos) << name;
    EXPECT_EQ(bytes.find(folder.contents().begin()->c_str()), std::string::npos) << name;
  }
}

TEST(ImageFile, RefusesWhatExistsAndWhatItCannotWrite) {
  const TemporaryFolder folder;
  const auto rgba = ramp(4, 4);
  write_image(folder / "a.png", {4, 4, rgba}, false);
  EXPECT_THROW(write_image(folder / "a.png", {4, 4, rgba}, false), globe::Error);
  EXPECT_NO_THROW(write_image(folder / "a.png", {4, 4, rgba}, true));
  EXPECT_THROW(write_image(folder / "a.bmp", {4, 4, rgba}, false), globe::UsageError);
  EXPECT_THROW(write_image(folder / "a.exr", {4, 4, rgba}, false), globe::UsageError);
  EXPECT_THROW(write_image(folder / "gone/a.png", {4, 4, rgba}, false), globe::Error);
  EXPECT_EQ(folder.contents(), Names{"a.png"});
}

}  // namespace
}  // namespace app
