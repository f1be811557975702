// What a point costs on one thread at level 20, here and in the libraries a user might pick instead.
//
//   build/release/tests/bench/globe_index_bench       (30 repetitions, random interleaving, one thread)
//
// Prints a table in Markdown: medians over the repetitions, and their ratios to the best known rival with the
// 95 % interval of a bootstrap.

#include <benchmark/benchmark.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "globe/geo/ellipsoid.h"
#include "globe/htm/trixel.h"
#include "globe/planet/trixels.h"
#include "tests/bench/peers/peers.h"

namespace {

using globe::geo::normal_from_degrees;
using globe::htm::dvec3;
using globe::htm::Trixel;
using globe::htm::trixel_at;

constexpr int kLevel = 20;
constexpr std::size_t kPoints = 100'000;

/// Points uniform on the sphere, and their trixels and cells.
struct Inputs {
  std::vector<double> lat_deg, lon_deg;
  std::vector<dvec3> u;
  std::vector<Trixel> trixels;
  std::vector<std::uint64_t> cells;
};

const Inputs& inputs() {
  static const Inputs made = [] {
    Inputs in;
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (std::size_t k = 0; k < kPoints; ++k) {
      in.lat_deg.push_back(std::asin(unit(random)) * (180 / M_PI));
      in.lon_deg.push_back(180 * unit(random));
      in.u.push_back(normal_from_degrees(in.lat_deg.back(), in.lon_deg.back()));
      in.trixels.push_back(trixel_at(in.u.back(), kLevel));
    }
    in.cells.resize(kPoints);
#ifdef GLOBE_HAVE_S2
    peers::s2_from_vectors(in.u, in.cells);
    peers::s2_parents(kLevel, in.cells);
#endif
    return in;
  }();
  return made;
}

void add(const std::string& name, const std::function<void()>& work) {
  benchmark::RegisterBenchmark(name.c_str(), [work](benchmark::State& state) {
    for (auto _ : state) {
      work();
      benchmark::ClobberMemory();
    }
  });
}

/// Every repetition of every benchmark, nanoseconds a point, and in the end the table.
class Table : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override {
    std::printf("%d cores, %.0f MHz; %zu points, level %d, one thread\n\n", context.cpu_info.num_cpus,
                context.cpu_info.cycles_per_second / 1e6, kPoints, kLevel);
    return true;
  }

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type == Run::RT_Iteration && !run.error_occurred)
        ns_[run.run_name.function_name].push_back(1e9 * run.cpu_accumulated_time /
                                                  static_cast<double>(run.iterations) / double(kPoints));
    }
  }

  void Finalize() override {
    std::printf("| what | ns a point | rival | rival / this (95 %% interval) |\n|---|---|---|---|\n");
    for (const auto& [name, rival] : rows_) {
      if (!ns_.contains(name)) continue;
      std::printf("| %s | %.1f | ", name.c_str(), median(ns_[name]));
      if (rival.empty() || !ns_.contains(rival)) {
        std::printf("| |\n");
        continue;
      }
      const auto [low, high] = ratio_interval(ns_[rival], ns_[name]);
      std::printf("%s | %.2f (%.2f to %.2f) |\n", rival.c_str(), median(ns_[rival]) / median(ns_[name]), low,
                  high);
    }
  }

  /// A row of the table. @param rival  another row's name, or empty
  void add_row(const std::string& name, const std::string& rival) { rows_.emplace_back(name, rival); }

 private:
  static double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                     values.end());
    return values[values.size() / 2];
  }

  static std::pair<double, double> ratio_interval(const std::vector<double>& over,
                                                  const std::vector<double>& under) {
    std::mt19937_64 random(2);
    const auto resampled = [&](const std::vector<double>& values) {
      std::vector<double> sample(values.size());
      for (double& value : sample) value = values[random() % values.size()];
      return median(std::move(sample));
    };
    std::vector<double> ratios(2000);
    for (double& ratio : ratios) ratio = resampled(over) / resampled(under);
    std::sort(ratios.begin(), ratios.end());
    return {ratios[50], ratios[1949]};
  }

  std::map<std::string, std::vector<double>> ns_;
  std::vector<std::pair<std::string, std::string>> rows_;
};

void add_ours(Table& table) {
  static std::vector<Trixel> result(kPoints);
  const Inputs& in = inputs();
  const auto row = [&](const std::string& name, const std::string& rival, const std::function<void()>& work) {
    add(name, work);
    table.add_row(name, rival);
  };
  row("globe, many, from degrees", "S2 leaf from degrees",
      [&in] { globe::planet::trixels_from_degrees(in.lat_deg, in.lon_deg, kLevel, result); });
  row("globe, many, from vectors", "S2 leaf from vectors",
      [&in] { globe::htm::trixels_at(in.u, kLevel, result); });
  row("globe, one by one, from degrees", "exact walk, from vectors", [&in] {
    for (std::size_t k = 0; k < kPoints; ++k)
      result[k] = trixel_at(normal_from_degrees(in.lat_deg[k], in.lon_deg[k]), kLevel);
  });
  row("globe, one by one, from vectors", "exact walk, from vectors", [&in] {
    for (std::size_t k = 0; k < kPoints; ++k) result[k] = trixel_at(in.u[k], kLevel);
  });
  row("exact walk, from vectors", "", [&in] {
    for (std::size_t k = 0; k < kPoints; ++k) result[k] = globe::htm::trixel_by_walk(in.u[k], kLevel);
  });
  row("globe, three corners", "S2 four corners", [&in] {
    for (const Trixel& t : in.trixels) benchmark::DoNotOptimize(globe::htm::corners(t));
  });
  row("globe, centre", "", [&in] {
    for (const Trixel& t : in.trixels) benchmark::DoNotOptimize(globe::htm::center(t));
  });
  row("globe, three neighbours", "S2 four neighbours", [&in] {
    for (const Trixel& t : in.trixels) benchmark::DoNotOptimize(globe::htm::neighbors(t));
  });
}

void add_rivals(Table& table) {
  static std::vector<std::uint64_t> ids(kPoints);
  [[maybe_unused]] const Inputs& in = inputs();
  [[maybe_unused]] const auto row = [&](const std::string& name, const std::function<void()>& work) {
    add(name, work);
    table.add_row(name, "");
  };
#ifdef GLOBE_HAVE_S2
  row("S2 leaf from degrees", [&in] { peers::s2_from_degrees(in.lat_deg, in.lon_deg, ids); });
  row("S2 leaf from vectors", [&in] { peers::s2_from_vectors(in.u, ids); });
  row("S2 four corners", [&in] { benchmark::DoNotOptimize(peers::s2_corners(in.cells)); });
  row("S2 four neighbours", [&in] { benchmark::DoNotOptimize(peers::s2_neighbors(in.cells)); });
#endif
#ifdef GLOBE_HAVE_HEALPIX
  row("HEALPix 2^20 from degrees", [&in] { peers::healpix_from_degrees(in.lat_deg, in.lon_deg, ids); });
  row("HEALPix 2^20 from vectors", [&in] { peers::healpix_from_vectors(in.u, ids); });
#endif
}

}  // namespace

int main(int argc, char** argv) {
  const oneapi::tbb::global_control one_thread(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  std::vector<char*> arguments(argv, argv + argc);
  std::string interleaved = "--benchmark_enable_random_interleaving=true",
              repetitions = "--benchmark_repetitions=30", short_runs = "--benchmark_min_time=0.02";
  arguments.insert(arguments.begin() + 1, {interleaved.data(), repetitions.data(), short_runs.data()});
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return 2;
  Table table;
  add_ours(table);
  add_rivals(table);
  benchmark::RunSpecifiedBenchmarks(&table);
  std::vector<Trixel> result(kPoints);
  const std::size_t walked =
      globe::planet::trixels_from_degrees(inputs().lat_deg, inputs().lon_deg, kLevel, result);
  std::printf("\n%zu of %zu points took the exact walk.\n", walked, kPoints);
  return 0;
}
