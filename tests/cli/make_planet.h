#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/cli/run_program.h"
#include "tests/temporary_folder.h"

namespace cli {

/// Converts a map of 64 x 32 samples, metres 0 to 999, to FOLDER/planet (level 4); gives its path.
inline std::string make_planet(const std::filesystem::path& folder, const std::vector<std::string>& options) {
  constexpr int kWidth = 64, kHeight = 32;
  std::vector<float> samples;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) samples.push_back(static_cast<float>((x * 37 + y * 91) % 1000));
  }
  const std::string map = (folder / "map.tif").string();
  const auto output = OIIO::ImageOutput::create(map);
  EXPECT_TRUE(output && output->open(map, OIIO::ImageSpec(kWidth, kHeight, 1, OIIO::TypeDesc::FLOAT)));
  EXPECT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, samples.data()) && output->close());
  std::vector<std::string> words{"convert", map, "-o", (folder / "planet").string(), "--quiet"};
  words.insert(words.end(), options.begin(), options.end());
  const Outcome made = run_program(words);
  EXPECT_EQ(made.status, 0) << made.err;
  return (folder / "planet").string();
}

/// Converts the map that make_planet left in the folder as colours, to a planet without heights; gives its
/// path.
inline std::string make_color_planet(const std::filesystem::path& folder) {
  const std::string planet = (folder / "colors").string();
  const Outcome made =
      run_program({"convert", "--color", (folder / "map.tif").string(), "-o", planet, "--quiet"});
  EXPECT_EQ(made.status, 0) << made.err;
  return planet;
}

}  // namespace cli
