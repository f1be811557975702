#include "globe/effects/lat_long_image.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "globe/base/one_line.h"
#include "globe/effects/entry.h"

namespace globe::effects {
namespace {

constexpr int kLargest = 16384;  ///< pixels across: what drivers take

}  // namespace

std::array<float, 3> LatLongImage::at(double lat_deg, double lon_deg) const {
  const double x = (lon_deg + 180.0) / 360.0 * width - 0.5, y = (90.0 - lat_deg) / 180.0 * height - 0.5;
  const double left = std::floor(x), top = std::floor(y);
  const auto right = static_cast<float>(x - left), down = static_cast<float>(y - top);
  const auto column = [&](int step) {
    const int k = (static_cast<int>(left) + step) % width;
    return static_cast<std::size_t>(k < 0 ? k + width : k);
  };
  const auto row = [&](int step) {
    return static_cast<std::size_t>(std::clamp(static_cast<int>(top) + step, 0, height - 1));
  };
  std::array<float, 3> sum{};
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const float share = (i == 0 ? 1.0f - right : right) * (j == 0 ? 1.0f - down : down);
      const std::uint8_t* pixel = pixels.data() + (row(j) * static_cast<std::size_t>(width) + column(i)) *
                                                      static_cast<std::size_t>(channels);
      for (std::size_t c = 0; c < 3; ++c) sum[c] += share * static_cast<float>(pixel[channels == 1 ? 0 : c]);
    }
  }
  return sum;
}

LatLongImage read_lat_long_image(const std::filesystem::path& file) {
  const std::string name = one_line(file.string());
  const auto input = OIIO::ImageInput::open(file.string());
  if (!input)
    throw Refused{name + " is no image that can be read: " + one_line(OIIO::geterror()),
                  "give a JPEG, PNG or TIFF file"};
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width != 2 * spec.height || spec.width > kLargest) {
    throw Refused{name + " has " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
                      " pixels, which is no map of a whole planet",
                  "give one twice as wide as high, at most " + std::to_string(kLargest) + " across"};
  }
  LatLongImage image{spec.width, spec.height, spec.nchannels < 3 ? 1 : 3, {}};
  image.pixels.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                      static_cast<std::size_t>(image.channels));
  if (!input->read_image(0, 0, 0, image.channels, OIIO::TypeDesc::UINT8, image.pixels.data()))
    throw Refused{name + " cannot be read to its end: " + one_line(input->geterror()), "get it anew"};
  return image;
}

}  // namespace globe::effects
