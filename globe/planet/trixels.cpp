#include "globe/planet/trixels.h"

#include <array>
#include <atomic>
#include <cassert>

#include "globe/base/parallel_blocks.h"
#include "globe/geo/normals.h"

namespace globe::planet {

std::size_t trixels_from_degrees(std::span<const double> lat_deg, std::span<const double> lon_deg, int level,
                                 std::span<htm::Trixel> result, std::uint64_t* exact_calls) {
  assert(lat_deg.size() == result.size() && lon_deg.size() == result.size());
  constexpr std::size_t kBlock = 512;  // its normals stay in the first-level cache
  std::atomic<std::uint64_t> exact{0};
  std::atomic<std::size_t> walked{0};
  for_each_block(result.size(), kBlock, [&](std::size_t first, std::size_t count) {
    std::array<double, kBlock> x, y, z;
    const std::span<double> xs(x.data(), count), ys(y.data(), count), zs(z.data(), count);
    geo::normals_from_degrees(lat_deg.subspan(first, count), lon_deg.subspan(first, count), xs, ys, zs);
    std::uint64_t exact_here = 0;
    walked += htm::trixels_at({xs, ys, zs}, level, result.subspan(first, count), &exact_here);
    if (exact_here != 0) exact += exact_here;
  });
  if (exact_calls != nullptr) *exact_calls += exact;
  return walked;
}

}  // namespace globe::planet
