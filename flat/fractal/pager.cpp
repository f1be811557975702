#include "flat/fractal/pager.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "globe/base/error.h"

namespace globe::flat::fractal {
namespace {

PagerSettings checked(const PagerSettings& settings) {
  if (settings.log2_blocks < 2 || settings.log2_blocks > 8) {
    throw UsageError("2^" + std::to_string(settings.log2_blocks) + " blocks a side",
                     "not between 2^2 and 2^8", "give 2 to 8");
  }
  if (settings.log2_cells + settings.log2_blocks > 12) {
    throw UsageError("2^" + std::to_string(settings.log2_blocks) + " blocks of 2^" +
                         std::to_string(settings.log2_cells) + " cells a side",
                     "more than 4096 cells a side", "give smaller blocks, or fewer");
  }
  if (!(settings.slack >= 0.0 && settings.slack <= 1.0))
    throw UsageError("--slack " + std::to_string(settings.slack), "not a share of a block", "give 0 to 1");
  return settings;
}

}  // namespace

std::int64_t steps_to_hold(double place, double middle, double slack) {
  const double off = place - middle;
  const double reach = 0.5 + 0.5 * slack;
  if (off > reach) return static_cast<std::int64_t>(std::ceil(off - reach));
  if (off < -reach) return -static_cast<std::int64_t>(std::ceil(-off - reach));
  return 0;
}

Pager::Pager(const Settings& settings, const PagerSettings& pager)
    : pager_(checked(pager)), maker_(settings, pager.log2_cells, pager.cached_areas) {
  const auto count = static_cast<std::size_t>(blocks()) * static_cast<std::size_t>(blocks());
  const auto posts = static_cast<std::size_t>(posts_with_rim());
  blocks_.resize(count);
  heights_.resize(count * posts * posts);
}

int Pager::slot(const BlockKey& key) const {
  const std::int64_t mask = blocks() - 1;
  return static_cast<int>((key.y & mask) * blocks() + (key.x & mask));
}

std::span<const float> Pager::heights(int slot) const {
  const auto posts = static_cast<std::size_t>(posts_with_rim());
  return std::span<const float>(heights_).subspan(static_cast<std::size_t>(slot) * posts * posts,
                                                  posts * posts);
}

bool Pager::move_to(const glm::dvec2& posts) {
  const glm::dvec2 place = posts / static_cast<double>(cells());
  if (empty_) {
    middle_ = {std::llround(place.x), std::llround(place.y)};
  } else {
    const std::int64_t east = steps_to_hold(place.x, static_cast<double>(middle_.x), pager_.slack);
    const std::int64_t north = steps_to_hold(place.y, static_cast<double>(middle_.y), pager_.slack);
    if (east == 0 && north == 0) return false;
    middle_ = {middle_.x + east, middle_.y + north};
  }
  ++moves_;
  fill();
  empty_ = false;
  return true;
}

void Pager::fill() {
  const BlockKey corner = first();
  const int rim_posts = posts_with_rim();
  const auto size = static_cast<std::size_t>(rim_posts) * static_cast<std::size_t>(rim_posts);
  for (std::int64_t y = corner.y; y < corner.y + blocks(); ++y) {
    for (std::int64_t x = corner.x; x < corner.x + blocks(); ++x) {
      const int at = slot({x, y});
      Block& block = blocks_[static_cast<std::size_t>(at)];
      if (!empty_ && block.key == BlockKey{x, y}) continue;
      const std::span<float> posts =
          std::span<float>(heights_).subspan(static_cast<std::size_t>(at) * size, size);
      block.key = {x, y};
      maker_.make(block.key, posts);
      block.lowest_m = block.highest_m = posts[static_cast<std::size_t>(rim_posts) + 1];
      for (int j = 1; j < rim_posts - 1; ++j) {
        for (int i = 1; i < rim_posts - 1; ++i) {
          const float height = posts[static_cast<std::size_t>(j * rim_posts + i)];
          block.lowest_m = std::min(block.lowest_m, height);
          block.highest_m = std::max(block.highest_m, height);
        }
      }
    }
  }
}

Pager::Counts Pager::counts() const {
  const BlockMaker::Counts& made = maker_.counts();
  return {moves_, made.blocks, made.hits, made.misses};
}

}  // namespace globe::flat::fractal
