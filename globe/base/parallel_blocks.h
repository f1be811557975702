#pragma once

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>

namespace globe {

/// Calls work(first, count) for blocks of at most `block` items that together are [0, total). More than
/// 2 * kItemsATask items are spread over the threads of the TBB arena this is called in; which thread does
/// what must not matter to `work`.
template <typename Work>
void for_each_block(std::size_t total, std::size_t block, const Work& work) {
  constexpr std::size_t kItemsATask = 8192;  // a quarter of a millisecond of look-ups
  const auto run = [&](std::size_t begin, std::size_t end) {
    for (std::size_t first = begin; first < end; first += block) work(first, std::min(block, end - first));
  };
  if (total <= 2 * kItemsATask) return run(0, total);
  oneapi::tbb::parallel_for(
      oneapi::tbb::blocked_range<std::size_t>(0, total, kItemsATask),
      [&](const oneapi::tbb::blocked_range<std::size_t>& range) { run(range.begin(), range.end()); });
}

}  // namespace globe
