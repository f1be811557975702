#include "app/bench.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <regex>

#include "app/bench_fractal.h"
#include "app/commands.h"
#include "app/flight_stats.h"
#include "globe/base/error.h"

namespace app {
namespace {

struct BenchOptions {
  bool json = false;
  std::string filter = ".*";
  int rounds = 60;
};

std::string time_text(double ns) {
  char text[32];
  if (ns >= 1e6) {
    std::snprintf(text, sizeof text, "%.2f ms", ns / 1e6);
  } else if (ns >= 1e3) {
    std::snprintf(text, sizeof text, "%.2f us", ns / 1e3);
  } else {
    std::snprintf(text, sizeof text, "%.1f ns", ns);
  }
  return text;
}

/// Calls visit with the results of two benchmarks, if both were run.
template <class Visit>
void with_both(const std::vector<BenchmarkResult>& results, const std::string& a, const std::string& b,
               const Visit& visit) {
  const auto find = [&](const std::string& name) {
    return std::find_if(results.begin(), results.end(),
                        [&](const BenchmarkResult& r) { return r.name == name; });
  };
  const auto over = find(a), under = find(b);
  if (over != results.end() && under != results.end()) visit(over->ns, under->ns);
}

/// "A / B: median ratio, 95 % interval" of two benchmarks, round by round.
void print_ratio(const std::vector<BenchmarkResult>& results, const std::string& a, const std::string& b) {
  with_both(results, a, b, [&](const std::vector<double>& over, const std::vector<double>& under) {
    std::vector<double> ratios;
    for (std::size_t k = 0; k < over.size(); ++k) ratios.push_back(over[k] / under[k]);
    const Interval interval = median_interval(ratios);
    std::printf("%s / %s, round by round: %.2f (95 %% interval %.2f to %.2f)\n", a.c_str(), b.c_str(),
                percentile(ratios, 50), interval.low, interval.high);
  });
}

/// "A / B: ratio of the 99th percentiles".
void print_tail_ratio(const std::vector<BenchmarkResult>& results, const std::string& a,
                      const std::string& b) {
  with_both(results, a, b, [&](const std::vector<double>& over, const std::vector<double>& under) {
    std::printf("%s / %s, 99th percentiles: %.2f / %.2f ms = %.2f\n", a.c_str(), b.c_str(),
                percentile(over, 99) * 1e-6, percentile(under, 99) * 1e-6,
                percentile(over, 99) / percentile(under, 99));
  });
}

void run(const BenchOptions& options) {
  if (options.rounds < 30) {
    throw globe::UsageError("--rounds " + std::to_string(options.rounds),
                            "a median of fewer than 30 runs says little", "give 30 or more");
  }
  std::regex filter;
  try {
    filter = std::regex(options.filter);
  } catch (const std::regex_error&) {
    throw globe::UsageError("--filter " + options.filter, "not a regular expression", "try --filter 'htm.*'");
  }
  std::vector<BenchmarkEntry> entries = geometry_benchmarks();
  for (BenchmarkEntry& entry : cover_benchmarks()) entries.push_back(std::move(entry));
  for (BenchmarkEntry& entry : line_benchmarks()) entries.push_back(std::move(entry));
  for (BenchmarkEntry& entry : convert_benchmarks()) entries.push_back(std::move(entry));
  for (BenchmarkEntry& entry : flight_benchmarks(options.rounds)) entries.push_back(std::move(entry));
  for (BenchmarkEntry& entry : fractal_benchmarks()) entries.push_back(std::move(entry));
  for (BenchmarkEntry& entry : flat_benchmarks(options.rounds)) entries.push_back(std::move(entry));
  std::vector<Benchmark> chosen;
  for (const BenchmarkEntry& entry : entries) {
    if (std::regex_search(entry.name, filter)) chosen.push_back(entry.prepare());
  }
  const std::vector<BenchmarkResult> results = run_interleaved(chosen, options.rounds);
  nlohmann::json rows = nlohmann::json::array();
  if (!options.json)
    std::printf("%-32s %12s %26s %12s %12s %14s\n", "name", "median", "95 % interval", "p10", "p90",
                "items/s");
  for (const BenchmarkResult& result : results) {
    const double median = percentile(result.ns, 50);
    const Interval interval = median_interval(result.ns);
    const double p10 = percentile(result.ns, 10);
    const double p90 = percentile(result.ns, 90);
    if (options.json) {
      rows.push_back({{"name", result.name},
                      {"n", result.ns.size()},
                      {"median_ns", median},
                      {"median_low_ns", interval.low},
                      {"median_high_ns", interval.high},
                      {"p10_ns", p10},
                      {"p90_ns", p90},
                      {"items_per_s", result.items * 1e9 / median}});
    } else {
      const std::string range = time_text(interval.low) + " to " + time_text(interval.high);
      std::printf("%-32s %12s %26s %12s %12s %14.4g\n", result.name.c_str(), time_text(median).c_str(),
                  range.c_str(), time_text(p10).c_str(), time_text(p90).c_str(), result.items * 1e9 / median);
    }
  }
  if (options.json) {
    std::printf("%s\n", rows.dump(1).c_str());
  } else {
    print_ratio(results, "fly.detail64", "fly.raw_gl");
    print_ratio(results, "fly.uploads", "fly.no_uploads");
    print_tail_ratio(results, "fly.uploads", "fly.no_uploads");
    for (const std::string plain : {"fly.detail64", "draw.vertices"}) {
      for (const BenchmarkResult& result : results) {
        if (result.name.starts_with(plain + ".")) print_ratio(results, result.name, plain);
      }
    }
  }
}

}  // namespace

Interval median_interval(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  // The median lies below all but r values with the probability of at most r heads in so many tosses.
  const boost::math::binomial tosses(static_cast<double>(values.size()), 0.5);
  const auto outside = static_cast<std::size_t>(quantile(tosses, 0.025));
  return {values[outside], values[values.size() - 1 - outside]};
}

std::vector<BenchmarkResult> run_interleaved(std::vector<Benchmark>& benchmarks, int rounds) {
  std::vector<BenchmarkResult> results;
  results.reserve(benchmarks.size());
  for (const Benchmark& benchmark : benchmarks) results.push_back({benchmark.name, benchmark.items, {}});
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < benchmarks.size(); ++k) {
      const auto begin = std::chrono::steady_clock::now();
      benchmarks[k].run();
      results[k].ns.push_back(
          std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count());
      if (benchmarks[k].settle) benchmarks[k].settle();
    }
  }
  return results;
}

void add_bench(CLI::App& program) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = program.add_subcommand("bench", "Interleaved medians of the parts and of flights");
  command->add_flag("--json", options->json, "rows {name, n, median_ns, p10_ns, p90_ns, items_per_s}");
  command->add_option("--filter", options->filter, "regular expression over the names");
  command->add_option("--rounds", options->rounds, "runs of each, at least 30")->capture_default_str();
  command->callback([options] { run(*options); });
}

}  // namespace app
