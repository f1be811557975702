#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cstddef>
#include <cstdint>

#include "globe/base/parallel_blocks.h"
#include "globe/base/vector_width.h"
#include "globe/htm/descent.h"
#include "globe/htm/trixel.h"

namespace globe::htm {
namespace {

constexpr std::size_t kBlock = 512;

struct Answers {
  std::array<std::uint64_t, kBlock> id, certain;
};

GLOBE_FOR_EVERY_VECTOR_WIDTH void find_short(const double* __restrict x, const double* __restrict y,
                                             const double* __restrict z, std::size_t count, const Goal& goal,
                                             Answers& __restrict answers) {
  const Goal same = goal;
  for (std::size_t k = 0; k < count; ++k) {
    const Found found = find<kShort>(x[k], y[k], z[k], same);
    answers.id[k] = found.id;
    answers.certain[k] = found.certain;
  }
}

GLOBE_FOR_EVERY_VECTOR_WIDTH void find_long(const double* __restrict x, const double* __restrict y,
                                            const double* __restrict z, std::size_t count, const Goal& goal,
                                            Answers& __restrict answers) {
  const Goal same = goal;
  for (std::size_t k = 0; k < count; ++k) {
    const Found found = find<kLong>(x[k], y[k], z[k], same);
    answers.id[k] = found.id;
    answers.certain[k] = found.certain;
  }
}

/// A part of `trixels_at`: at most kBlock directions. Returns how many took the walk.
std::size_t find_block(const DirectionArrays& u, int level, std::span<Trixel> result,
                       std::uint64_t& exact_calls) {
  Answers answers;
  const bool is_deep = level > kDeepestOfShort;
  const Goal goal = is_deep ? goal_at<kLong>(level) : goal_at<kShort>(level);
  (is_deep ? find_long : find_short)(u.x.data(), u.y.data(), u.z.data(), result.size(), goal, answers);
  std::size_t walked = 0;
  for (std::size_t k = 0; k < result.size(); ++k) {
    if (answers.certain[k] != 0) {
      result[k] = {answers.id[k] >> (2 * (goal.level - level))};
    } else {
      ++walked;
      result[k] = trixel_by_walk({u.x[k], u.y[k], u.z[k]}, level, &exact_calls);
    }
  }
  return walked;
}

/// Blocks on all threads. @param directions  first and count to the DirectionArrays of that part
template <typename Directions>
std::size_t find_all(int level, std::span<Trixel> result, std::uint64_t* exact_calls,
                     const Directions& directions) {
  assert(level >= 0 && level <= kMaxLevel);
  std::atomic<std::uint64_t> exact{0};
  std::atomic<std::size_t> walked{0};
  for_each_block(result.size(), kBlock, [&](std::size_t first, std::size_t count) {
    std::uint64_t exact_here = 0;
    directions(first, count, [&](const DirectionArrays& u) {
      walked += find_block(u, level, result.subspan(first, count), exact_here);
    });
    if (exact_here != 0) exact += exact_here;
  });
  if (exact_calls != nullptr) *exact_calls += exact;
  return walked;
}

}  // namespace

std::size_t trixels_at(const DirectionArrays& u, int level, std::span<Trixel> result,
                       std::uint64_t* exact_calls) {
  assert(u.x.size() == result.size() && u.y.size() == result.size() && u.z.size() == result.size());
  return find_all(level, result, exact_calls, [&](std::size_t first, std::size_t count, const auto& find) {
    find({u.x.subspan(first, count), u.y.subspan(first, count), u.z.subspan(first, count)});
  });
}

std::size_t trixels_at(std::span<const dvec3> directions, int level, std::span<Trixel> result,
                       std::uint64_t* exact_calls) {
  assert(directions.size() == result.size());
  return find_all(level, result, exact_calls, [&](std::size_t first, std::size_t count, const auto& find) {
    std::array<double, kBlock> x, y, z;
    for (std::size_t k = 0; k < count; ++k) {
      x[k] = directions[first + k].x;
      y[k] = directions[first + k].y;
      z[k] = directions[first + k].z;
    }
    find({{x.data(), count}, {y.data(), count}, {z.data(), count}});
  });
}

}  // namespace globe::htm
