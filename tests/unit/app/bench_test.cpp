#include "app/bench.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "app/flight_stats.h"

namespace app {
namespace {

TEST(Percentile, IsTheNearestRank) {
  const std::vector<double> values{5, 1, 4, 2, 3};
  EXPECT_EQ(percentile(values, 50), 3);
  EXPECT_EQ(percentile(values, 99), 5);
  EXPECT_EQ(percentile(values, 1), 1);
  EXPECT_EQ(percentile({}, 50), 0);
}

TEST(MedianInterval, HoldsTheMedianInNineteenOfTwentyRuns) {
  std::mt19937_64 random(3);
  std::exponential_distribution<double> skewed;
  const double truth = 0.6931471805599453;
  int held = 0;
  constexpr int kRuns = 2000;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<double> values(60);
    for (double& value : values) value = skewed(random);
    const Interval interval = median_interval(values);
    if (interval.low <= truth && truth <= interval.high) ++held;
  }
  EXPECT_GT(held, kRuns * 93 / 100);
  EXPECT_LT(held, kRuns * 98 / 100);
}

TEST(MedianInterval, HoldsTheMedianAtLeastAsOftenAsItSaysForAnyNumberOfValues) {
  for (std::size_t count = 6; count <= 100; ++count) {
    std::vector<double> values(count);
    std::iota(values.begin(), values.end(), 0.0);
    const Interval interval = median_interval(values);
    EXPECT_EQ(interval.low + interval.high, static_cast<double>(count - 1));
    // As many of so many tosses are heads with the probability of Pascal's triangle.
    double outside = 0, of_next = 0, row = std::exp2(-static_cast<double>(count));
    for (std::size_t heads = 0; heads <= static_cast<std::size_t>(interval.low) + 1; ++heads) {
      (heads <= static_cast<std::size_t>(interval.low) ? outside : of_next) += 2.0 * row;
      row *= static_cast<double>(count - heads) / static_cast<double>(heads + 1);
    }
    EXPECT_LE(outside, 0.05) << count;
    EXPECT_GT(outside + of_next, 0.05) << count << ": could be narrower";
  }
}

TEST(RunInterleaved, RunsEveryBenchmarkOnceARound) {
  std::string order;
  std::vector<Benchmark> benchmarks{{"a", 1, [&] { order += 'a'; }, {}},
                                    {"b", 1, [&] { order += 'b'; }, [&] { order += '.'; }}};
  const auto results = run_interleaved(benchmarks, 3);
  EXPECT_EQ(order, "ab.ab.ab.");
  EXPECT_EQ(results[0].ns.size(), 3u);
  EXPECT_EQ(results[1].name, "b");
}

}  // namespace
}  // namespace app
