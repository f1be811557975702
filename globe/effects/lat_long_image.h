#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace globe::effects {

/// A picture of a whole planet: columns go east from 180 W, rows south from the north pole, each pixel an
/// area.
struct LatLongImage {
  int width = 0, height = 0;
  int channels = 0;                  ///< 1: grey, 3: red, green, blue; others of the file are left out
  std::vector<std::uint8_t> pixels;  ///< row by row, as the file has them (sRGB)

  /// Bilinear, as numbers of 0 to 255; across the date line, and at the poles as the last row. Grey comes in
  /// all three.
  std::array<float, 3> at(double lat_deg, double lon_deg) const;
};

/// Reads any file that OpenImageIO does. Throws Refused for one that is none, or not twice as wide as high.
LatLongImage read_lat_long_image(const std::filesystem::path& file);

}  // namespace globe::effects
