#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace app {

/// One thing to measure: `run` does it once. Made ready by `prepare`, which is not measured.
struct Benchmark {
  std::string name;
  double items = 1;  ///< of a run, for items_per_s
  std::function<void()> run;
  std::function<void()> settle = {};  ///< waits, unmeasured, for what the run left going in the background
};

/// A benchmark by name, made only when it is asked for.
struct BenchmarkEntry {
  std::string name;
  std::function<Benchmark()> prepare;
};

/// Times of one benchmark over all rounds, nanoseconds.
struct BenchmarkResult {
  std::string name;
  double items = 1;
  std::vector<double> ns;
};

/// Lower and upper end of the confidence interval of the median, by order statistics: the narrowest pair of
/// values, as far from either end, between which it lies in 95 % or more of all cases, by the binomial
/// distribution itself; of fewer than six values the least and the largest, which hold it less often.
struct Interval {
  double low = 0;
  double high = 0;
};
Interval median_interval(std::vector<double> values);

/// Runs all of them once a round, one after the other, so that what else the machine does falls on all alike.
std::vector<BenchmarkResult> run_interleaved(std::vector<Benchmark>& benchmarks, int rounds);

/// What `globe bench` knows (app/bench_geometry.cpp, app/bench_cover.cpp, app/bench_lines.cpp,
/// app/bench_convert.cpp, app/bench_flight.cpp, app/bench_flat.cpp).
std::vector<BenchmarkEntry> geometry_benchmarks();
std::vector<BenchmarkEntry> cover_benchmarks();
std::vector<BenchmarkEntry> line_benchmarks();
std::vector<BenchmarkEntry> convert_benchmarks();
std::vector<BenchmarkEntry> flight_benchmarks(int rounds);
/// Wagner's Table 1: his minimum and full scenes, without morphing, with it on the processor and on the GPU.
std::vector<BenchmarkEntry> flat_benchmarks(int rounds);

}  // namespace app
