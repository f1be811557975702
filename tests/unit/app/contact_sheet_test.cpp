#include "app/contact_sheet.h"

#include <gtest/gtest.h>

#include "globe/base/error.h"
#include "tests/temporary_folder.h"

namespace app {
namespace {

using tests::TemporaryFolder;

std::vector<std::uint8_t> shade(int width, int height, std::uint8_t value) {
  return std::vector<std::uint8_t>(static_cast<std::size_t>(width * height) * 4, value);
}

std::vector<int> wanted(const ContactSheet& sheet, int frames) {
  std::vector<int> result;
  for (int k = 0; k < frames; ++k) {
    if (sheet.wants(k)) result.push_back(k);
  }
  return result;
}

std::uint8_t red_at(const Picture& picture, int x, int y) {
  return picture.rgba[static_cast<std::size_t>(y * picture.width + x) * 4];
}

TEST(ContactSheet, SpreadsItsCellsOverTheFlight) {
  EXPECT_EQ(wanted(ContactSheet(300, 64, 36), 300),
            (std::vector<int>{0, 27, 54, 82, 109, 136, 163, 190, 217, 245, 272, 299}));
  EXPECT_EQ(wanted(ContactSheet(12, 64, 36), 12).size(), 12u);
  EXPECT_EQ(wanted(ContactSheet(5, 64, 36), 5), (std::vector<int>{0, 1, 2, 3, 4}));
  EXPECT_EQ(wanted(ContactSheet(1, 64, 36), 1), (std::vector<int>{0}));
}

TEST(ContactSheet, HasTheShapeOfItsLayout) {
  const ContactSheetLayout layout{.columns = 4, .rows = 3, .cell_width = 320, .gap = 6};
  const Picture full = ContactSheet(300, 1280, 720, layout).picture();
  EXPECT_EQ(full.width, 4 * 320 + 5 * 6);
  EXPECT_EQ(full.height, 3 * 180 + 4 * 6);
  const Picture two = ContactSheet(2, 1280, 720, layout).picture();
  EXPECT_EQ(two.width, 2 * 320 + 3 * 6);
  EXPECT_EQ(two.height, 180 + 2 * 6);
}

TEST(ContactSheet, PutsEachFrameIntoItsCell) {
  const ContactSheetLayout layout{.columns = 2, .rows = 2, .cell_width = 20, .gap = 4};
  ContactSheet sheet(4, 40, 20, layout);
  for (int k = 0; k < 4; ++k) sheet.add(k, shade(40, 20, static_cast<std::uint8_t>(50 * (k + 1))));
  const Picture picture = sheet.picture();
  for (int k = 0; k < 4; ++k) {
    const int x = 4 + k % 2 * 24, y = 4 + k / 2 * 14;
    EXPECT_EQ(red_at(picture, x, y), 50 * (k + 1));
    EXPECT_EQ(red_at(picture, x + 19, y + 9), 50 * (k + 1));
    EXPECT_LT(red_at(picture, x - 1, y), 40);
    EXPECT_LT(red_at(picture, x + 20, y), 40);
    EXPECT_LT(red_at(picture, x, y + 10), 40);
  }
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) ASSERT_EQ(picture.rgba[i], 255);
}

TEST(ContactSheet, ScalesDownByFilteringNotBySkipping) {
  ContactSheet sheet(1, 64, 32, {.columns = 1, .rows = 1, .cell_width = 16, .gap = 0});
  std::vector<std::uint8_t> stripes(64 * 32 * 4);
  for (std::size_t i = 0; i < stripes.size(); ++i) stripes[i] = (i / 4) % 2 == 0 ? 255 : 0;
  sheet.add(0, stripes);
  EXPECT_NEAR(red_at(sheet.picture(), 8, 4), 128, 2);
}

TEST(ContactSheet, CaptionsStayInTheirCell) {
  const ContactSheetLayout layout{.columns = 2, .rows = 1, .cell_width = 200, .gap = 4};
  ContactSheet sheet(2, 200, 100, layout);
  sheet.add(0, shade(200, 100, 60), "12,345 km above everything there is to see from here");
  sheet.add(1, shade(200, 100, 60));
  const Picture picture = sheet.picture();
  int lettered = 0;
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) {
      lettered += red_at(picture, 4 + x, 4 + y) != 60;
      ASSERT_EQ(red_at(picture, 208 + x, 4 + y), 60);
    }
  }
  if (std::filesystem::exists("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf")) {
    EXPECT_GT(lettered, 500);
  }
}

TEST(ContactSheet, WritesAPng) {
  const TemporaryFolder folder;
  ContactSheet sheet(3, 32, 32);
  for (int k = 0; k < 3; ++k) sheet.add(k, shade(32, 32, 100));
  sheet.write(folder / "sheet.png", false);
  EXPECT_THROW(sheet.write(folder / "sheet.png", false), globe::Error);
  EXPECT_EQ(folder.contents(), (std::set<std::string>{"sheet.png"}));
}

}  // namespace
}  // namespace app
