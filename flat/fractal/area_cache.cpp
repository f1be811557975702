#include "flat/fractal/area_cache.h"

#include <algorithm>
#include <string>

#include "globe/base/error.h"

namespace globe::flat::fractal {

BlockMaker::BlockMaker(const Settings& settings, int log2_cells, int cached_areas)
    : ground_(settings),
      log2_cells_(log2_cells),
      log2_blocks_(std::min(settings.iterations - log2_cells, 7)) {
  if (log2_cells < 2 || log2_cells > 6 || log2_cells > settings.iterations) {
    throw UsageError("blocks of 2^" + std::to_string(log2_cells) + " cells",
                     "not between 2^2 and 2^6, or more than the iterations make",
                     "give 2 to 6, and no more than the iterations");
  }
  if (cached_areas < 0 || cached_areas > 4096)
    throw UsageError("--cached-areas " + std::to_string(cached_areas), "not a number of areas",
                     "give 0 to 4096");
  areas_.resize(static_cast<std::size_t>(cached_areas));
}

PostRect BlockMaker::area_rect(const BlockKey& area) const {
  const std::int64_t side = blocks_per_area();
  return {area.x * side - 1, area.y * side - 1, static_cast<int>(side) + 3, static_cast<int>(side) + 3, 1};
}

const BlockMaker::Area& BlockMaker::area(const BlockKey& key) {
  ++now_;
  Area* oldest = &areas_.front();
  for (Area& kept : areas_) {
    if (kept.last_used > 0 && kept.key == key) {
      ++counts_.hits;
      kept.last_used = now_;
      return kept;
    }
    if (kept.last_used < oldest->last_used) oldest = &kept;
  }
  ++counts_.misses;
  const PostRect rect = area_rect(key);
  oldest->key = key;
  oldest->last_used = now_;
  oldest->heights.resize(static_cast<std::size_t>(rect.columns) * static_cast<std::size_t>(rect.rows));
  ground_.heights(ground_.settings().iterations - log2_cells_, rect, oldest->heights, workspace_);
  return *oldest;
}

void BlockMaker::make(const BlockKey& key, std::span<float> out) {
  ++counts_.blocks;
  const int depth = ground_.settings().iterations;
  const PostRect rect{key.x * cells() - 1, key.y * cells() - 1, posts_with_rim(), posts_with_rim(), 1};
  if (areas_.empty()) {
    ground_.heights(depth, rect, out, workspace_);
    return;
  }
  const BlockKey home{key.x >> log2_blocks_, key.y >> log2_blocks_};
  const Area& kept = area(home);
  ground_.heights_from(depth - log2_cells_, area_rect(home), kept.heights, depth, rect, out, workspace_);
}

}  // namespace globe::flat::fractal
