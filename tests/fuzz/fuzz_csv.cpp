#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "globe/base/error.h"
#include "globe/search/csv_features.h"

/// Every line is a place on the planet with properties that are JSON, or is refused by its number; lines come
/// in order. With and without a header.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const globe::search::Columns& columns :
       {globe::search::Columns{}, globe::search::Columns{"1", "2", "3"}}) {
    std::istringstream stream(text);
    std::size_t before = 0;
    const auto in_order = [&](std::size_t line) {
      if (line <= before) std::abort();
      before = line;
    };
    try {
      globe::search::visit_csv(
          stream, "fuzz", columns,
          [&](globe::search::NewFeature&& feature, std::size_t line) {
            in_order(line);
            const globe::geo::Geodetic& at = feature.geometry.points.at(0);
            if (!(std::abs(at.lat_deg) <= 90.0) || !std::isfinite(at.lon_deg)) std::abort();
            if (!feature.properties.empty() && !nlohmann::json::accept(feature.properties)) std::abort();
          },
          [&](const globe::search::BadLine& bad) { in_order(bad.line); });
    } catch (const globe::Error&) {
    }
  }
  return 0;
}
