#include "flat/fractal/hash.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

namespace globe::flat::fractal {
namespace {

template <class Key>
double share_lost(int side, const Key& key) {
  std::vector<std::uint64_t> keys;
  for (std::int64_t z = 0; z < side; ++z) {
    for (std::int64_t x = 0; x < side; ++x) keys.push_back(key(x, z));
  }
  std::sort(keys.begin(), keys.end());
  const auto kept = std::unique(keys.begin(), keys.end()) - keys.begin();
  return 1.0 - static_cast<double>(kept) / static_cast<double>(keys.size());
}

TEST(FractalHash, EveryPostHasAKeyOfItsOwn) {
  EXPECT_EQ(share_lost(512, [](std::int64_t x, std::int64_t z) { return post_hash(row_key(1, 3, z), x); }),
            0.0);
  // Christopoulos' key, for comparison.
  EXPECT_NEAR(
      share_lost(512, [](std::int64_t x,
                         std::int64_t z) { return static_cast<std::uint64_t>(7 * x * z + 5 * x + 9 * z); }),
      0.22, 0.01);
}

TEST(FractalHash, AChangedBitOfSeedOrPlaceChangesHalfTheBits) {
  const std::uint64_t before = post_hash(row_key(77, 5, -123), 456);
  const auto changed = [&](std::uint64_t after) { return std::popcount(before ^ after); };
  int sum = 0;
  for (int bit = 0; bit < 64; ++bit) {
    const std::uint64_t flip = std::uint64_t{1} << bit;
    for (const int count : {changed(post_hash(row_key(77 ^ flip, 5, -123), 456)),
                            changed(post_hash(row_key(77, 5, std::int64_t(std::uint64_t(-123) ^ flip)), 456)),
                            changed(post_hash(row_key(77, 5, -123), std::int64_t(456 ^ flip)))}) {
      EXPECT_GE(count, 12);  // 5 deviations of 4 bits from 32
      EXPECT_LE(count, 52);
      sum += count;
    }
  }
  EXPECT_NEAR(sum / (3 * 64.0), 32.0, 1.5);
}

TEST(FractalHash, VariatesHaveMeanZeroDeviationOneAndNoNeighboursInStep) {
  double sum = 0, squares = 0, along = 0, across = 0;
  constexpr int kSide = 512;
  for (int j = 0; j < kSide; ++j) {
    const std::uint64_t row = row_key(9, 2, j), next = row_key(9, 2, j + 1);
    for (int i = 0; i < kSide; ++i) {
      const double v = static_cast<double>(variate(post_hash(row, i)));
      EXPECT_LE(std::abs(v), static_cast<double>(kLargestVariate));
      sum += v;
      squares += v * v;
      along += v * static_cast<double>(variate(post_hash(row, i + 1)));
      across += v * static_cast<double>(variate(post_hash(next, i)));
    }
  }
  constexpr double kCount = double(kSide) * kSide;
  constexpr double kFiveDeviations = 5.0 / kSide;
  EXPECT_NEAR(sum / kCount, 0.0, kFiveDeviations);
  EXPECT_NEAR(squares / kCount, 1.0, 1.5 * kFiveDeviations);
  EXPECT_NEAR(along / kCount, 0.0, kFiveDeviations);
  EXPECT_NEAR(across / kCount, 0.0, kFiveDeviations);
}

}  // namespace
}  // namespace globe::flat::fractal
