#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "app/region_options.h"
#include "globe/base/error.h"
#include "globe/htm/cover.h"

/// A region as it is written is refused, or its inner cover lies in its outer one. The first byte chooses the
/// option, and its edges; no files are read.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kLongest = 2000;
  if (size < 1 || size > kLongest) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  app::RegionOptions options;
  if (data[0] % 3 == 0) options.cone = text;
  if (data[0] % 3 == 1) options.box = text;
  if (data[0] % 3 == 2) options.polygon = text;
  if (data[0] & 64) options.edges = "map";
  if (data[0] & 128) options.complement = true;
  if (text.empty() || text.find_first_of("/~") != std::string::npos || text.find("json") != std::string::npos)
    return 0;
  try {
    const auto region = app::make_region(options);
    const auto outer = globe::htm::cover(*region, {3, false, 0});
    for (const auto& inner : globe::htm::cover(*region, {3, true, 0})) {
      bool held = false;
      for (const auto& range : outer) held = held || (range.first <= inner.first && inner.last <= range.last);
      if (!held) std::abort();
    }
  } catch (const globe::Error&) {
  }
  return 0;
}
