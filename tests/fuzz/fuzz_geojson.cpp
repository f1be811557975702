#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <sstream>
#include <string>

#include "globe/base/error.h"
#include "globe/geo/geojson.h"

namespace {

void check(const globe::geo::Geodetic& at) {
  if (!(std::abs(at.lat_deg) <= 90.0) || !std::isfinite(at.lon_deg) || !std::isfinite(at.h_m)) std::abort();
}

}  // namespace

/// A file is refused, or all its places are on the planet.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream stream(std::string(reinterpret_cast<const char*>(data), size));
  try {
    globe::geo::visit_geojson(stream, "fuzz", [](globe::geo::Feature&& feature) {
      for (const auto& at : feature.geometry.points) check(at);
      for (const auto& line : feature.geometry.lines)
        for (const auto& at : line) check(at);
      for (const auto& rings : feature.geometry.polygons)
        for (const auto& ring : rings)
          for (const auto& at : ring) check(at);
    });
  } catch (const globe::Error&) {
  }
  return 0;
}
