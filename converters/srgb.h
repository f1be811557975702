#pragma once

#include <array>
#include <cstdint>

namespace converters {

/// Linear light, 0 to 1, of an sRGB value 0 to 1 (IEC 61966-2-1).
double linear_from_srgb(double encoded);

/// Linear light of every byte.
const std::array<float, 256>& linear_from_srgb_bytes();

/// The sRGB byte nearest to a linear value; values outside [0, 1] are clamped, NaN gives 0. Exact: the byte's
/// encoded value differs from that of the argument by at most half a step.
std::uint8_t srgb_byte_from_linear(float linear);

}  // namespace converters
