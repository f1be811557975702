#pragma once

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <vector>

namespace cli {

/// A float map of heights 0 to 999 m, rough enough not to compress away.
inline void write_map(const std::filesystem::path& path, int width, int height) {
  std::vector<float> samples;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) samples.push_back(static_cast<float>((x * 37 + y * 91) % 1000));
  }
  const auto output = OIIO::ImageOutput::create(path.string());
  ASSERT_TRUE(output &&
              output->open(path.string(), OIIO::ImageSpec(width, height, 1, OIIO::TypeDesc::FLOAT)));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, samples.data()) && output->close());
}

}  // namespace cli
