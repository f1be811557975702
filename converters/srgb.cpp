#include "converters/srgb.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace converters {
namespace {

constexpr int kBuckets = 4096;

/// `upper[c]`: linear value above which the byte is more than c. `start[b]`: the byte at the lower end of a
/// bucket.
struct EncodeTable {
  std::array<float, 256> upper;
  std::array<std::uint8_t, kBuckets + 1> start;

  EncodeTable() {
    for (std::size_t c = 0; c < 256; ++c)
      upper[c] = static_cast<float>(linear_from_srgb((double(c) + 0.5) / 255.0));
    upper[255] = INFINITY;
    std::uint8_t byte = 0;
    for (std::size_t b = 0; b <= kBuckets; ++b) {
      while (static_cast<float>(b) / kBuckets > upper[byte]) ++byte;
      start[b] = byte;
    }
  }
};

}  // namespace

double linear_from_srgb(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

const std::array<float, 256>& linear_from_srgb_bytes() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> made{};
    for (std::size_t c = 0; c < made.size(); ++c)
      made[c] = static_cast<float>(linear_from_srgb(double(c) / 255.0));
    return made;
  }();
  return table;
}

std::uint8_t srgb_byte_from_linear(float linear) {
  static const EncodeTable table;
  if (!(linear > 0.0F)) return 0;
  if (linear >= 1.0F) return 255;
  std::uint8_t byte = table.start[static_cast<std::size_t>(linear * kBuckets)];
  while (linear > table.upper[byte]) ++byte;
  return byte;
}

}  // namespace converters
