#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "app/point.h"
#include "globe/base/error.h"

/// A point is refused, or lies on the planet.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const auto at = app::parse_point({reinterpret_cast<const char*>(data), size}).position;
    const bool on_the_planet = std::abs(at.lat_deg) <= 90.0 && at.lon_deg >= -180.0 && at.lon_deg < 180.0;
    if (!on_the_planet) std::abort();
  } catch (const globe::Error&) {
  }
  return 0;
}
