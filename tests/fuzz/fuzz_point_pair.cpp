#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "app/point_pair.h"
#include "globe/base/error.h"

/// A pair is refused, or both its points lie on the planet.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const app::PointPair pair = app::parse_point_pair({reinterpret_cast<const char*>(data), size});
    for (const auto& at : {pair.a.position, pair.b.position}) {
      const bool on_the_planet = std::abs(at.lat_deg) <= 90.0 && at.lon_deg >= -180.0 && at.lon_deg < 180.0;
      if (!on_the_planet) std::abort();
    }
  } catch (const globe::Error&) {
  }
  return 0;
}
