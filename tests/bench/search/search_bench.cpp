// globe_search_bench [POINTS [FOLDER]]: the index of features beside SQLite's own R*Tree and a full scan of
// the same points, in one run: what building takes, and the same questions one after the other, each way in
// turn. Prints a Markdown table. FOLDER takes the databases, and is left empty.

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "globe/search/feature_index.h"
#include "globe/search/index_writer.h"
#include "tests/bench/search/full_scan.h"
#include "tests/bench/search/points.h"
#include "tests/bench/search/rtree.h"

namespace {

namespace fs = std::filesystem;
using bench::Answer;
using bench::Finder;
using bench::Point;
using Clock = std::chrono::steady_clock;

constexpr double kRadius_m = 50e3;
constexpr std::size_t kNearest = 10;
constexpr std::size_t kQuestions = 200;  ///< of each kind; half from anywhere, half from where points are
constexpr std::size_t kScans = 40;       ///< of those, by the full scan

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Index final : public Finder {
 public:
  explicit Index(const fs::path& path) : index_(path) {}

  Answer within(const Point& near, double radius_m) override {
    globe::search::Query query;
    query.near = globe::geo::Geodetic{near.lat_deg, near.lon_deg, 0.0};
    query.radius_m = radius_m;
    return answer(query);
  }
  Answer nearest(const Point& near, std::size_t count) override {
    globe::search::Query query;
    query.near = globe::geo::Geodetic{near.lat_deg, near.lon_deg, 0.0};
    query.count = count;
    return answer(query);
  }

 private:
  Answer answer(const globe::search::Query& query) {
    Answer result;
    for (const globe::search::Hit& hit : index_.find(query)) result.emplace_back(hit.distance_m, hit.id);
    return result;
  }

  globe::search::FeatureIndex index_;
};

void build_index(const fs::path& path, std::uint64_t count) {
  globe::search::IndexWriter writer(path, globe::geo::kWgs84, true);
  bench::for_each_point(count, [&](std::int64_t, const Point& at, const std::string& name) {
    globe::search::NewFeature feature;
    feature.geometry.points.push_back({at.lat_deg, at.lon_deg, 0.0});
    feature.name = name;
    writer.add(std::move(feature));
  });
  writer.finish();
}

/// What one way costs.
struct Way {
  std::string name;
  std::function<void(const fs::path&, std::uint64_t)> build;
  std::function<std::unique_ptr<Finder>(const fs::path&)> open;
  std::size_t questions = kQuestions;
  fs::path path = {};
  double build_s = 0;
  double peak_mib = 0;
  std::unique_ptr<Finder> finder = nullptr;
  std::vector<double> within_ms = {}, nearest_ms = {};
};

/// Builds in a process of its own, whose memory is then known.
void build(Way& way, std::uint64_t count) {
  std::fprintf(stderr, "building: %s\n", way.name.c_str());
  const auto start = Clock::now();
  const pid_t child = fork();
  if (child == 0) {
    try {
      way.build(way.path, count);
      _exit(0);
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
      _exit(1);
    }
  }
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || status != 0) std::exit(1);
  way.build_s = seconds_since(start);
  way.peak_mib = static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// The median and what lies in its 95 % interval by ranks, and the 99th percentile: "1.23 (1.11-1.35)",
/// "4.5".
std::string median_text(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  const auto at = [&](double rank) {
    return values[static_cast<std::size_t>(std::clamp(std::round(rank), 0.0, n - 1.0))];
  };
  const double half = 0.98 * std::sqrt(n);  // 1.96 standard deviations of a binomial with p = 1/2
  char text[80];
  std::snprintf(text, sizeof text, "%.3g (%.3g-%.3g)", at(0.5 * (n - 1.0)), at(0.5 * n - half),
                at(0.5 * n + half));
  return text;
}

std::string p99_text(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  char text[40];
  std::snprintf(text, sizeof text, "%.3g",
                values[static_cast<std::size_t>(0.99 * static_cast<double>(values.size() - 1))]);
  return text;
}

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name")) return line.substr(line.find(": ") + 2);
  return "unknown processor";
}

/// Asks all ways the same, each in turn; the answers must agree.
void ask(std::vector<Way>& ways, const std::vector<Point>& places, std::vector<std::size_t>& found,
         bool timed) {
  for (std::size_t k = 0; k < places.size(); ++k) {
    Answer within, nearest;
    for (std::size_t w = 0; w < ways.size(); ++w) {
      Way& way = ways[(w + k) % ways.size()];  // no way is always the first
      if (k >= way.questions || (!timed && way.questions < kQuestions)) continue;
      auto start = Clock::now();
      Answer answer = way.finder->within(places[k], kRadius_m);
      if (timed) way.within_ms.push_back(1e3 * seconds_since(start));
      start = Clock::now();
      Answer ten = way.finder->nearest(places[k], kNearest);
      if (timed) way.nearest_ms.push_back(1e3 * seconds_since(start));
      const bool first = nearest.empty();
      if (!first && (answer != within || ten != nearest)) {
        std::fprintf(stderr, "the answers differ at %.17g,%.17g\n", places[k].lat_deg, places[k].lon_deg);
        std::exit(1);
      }
      if (first && timed) found.push_back(answer.size());
      within = std::move(answer);
      nearest = std::move(ten);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000000;
  const fs::path folder = (argc > 2 ? fs::path(argv[2]) : fs::temp_directory_path()) /
                          ("globe-search-bench-" + std::to_string(getpid()));
  fs::create_directory(folder);
  std::vector<Way> ways;
  ways.push_back({"globe index", build_index, [](const fs::path& p) { return std::make_unique<Index>(p); }});
  ways.push_back({"R*Tree of SQLite", bench::build_rtree, bench::open_rtree});
  ways.push_back({"full scan", bench::build_table, bench::open_table, kScans});
  for (std::size_t k = 0; k < ways.size(); ++k) {
    ways[k].path = folder / (std::to_string(k) + ".db");
    build(ways[k], count);
  }
  std::vector<Point> places;
  bench::Points points(bench::kSeed + 1);
  while (places.size() < kQuestions) places.push_back(points.next());
  for (Way& way : ways) way.finder = way.open(way.path);
  std::vector<std::size_t> found;
  std::fprintf(stderr, "asking\n");
  ask(ways, places, found, false);
  ask(ways, places, found, true);

  std::sort(found.begin(), found.end());
  std::printf(
      "%llu points, half of them in 2000 heaps; %zu questions of each kind, half of them from the heaps\n"
      "(the full scan: %zu), each way in turn, warm; 50 km hold %zu points (median; %zu at most). All\n"
      "answers agree. %s, SQLite %s, one thread.\n\n",
      static_cast<unsigned long long>(count), kQuestions, kScans, found[found.size() / 2], found.back(),
      processor().c_str(), sqlite3_libversion());
  std::printf(
      "| way | build s | MiB | peak MiB building | 50 km, ms: median (95 %%) | p99 | 10 nearest, ms: median "
      "(95 %%) | p99 |\n"
      "| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const Way& way : ways) {
    std::printf("| %s | %.0f | %.0f | %.0f | %s | %s | %s | %s |\n", way.name.c_str(), way.build_s,
                static_cast<double>(fs::file_size(way.path)) / 1048576.0, way.peak_mib,
                median_text(way.within_ms).c_str(), p99_text(way.within_ms).c_str(),
                median_text(way.nearest_ms).c_str(), p99_text(way.nearest_ms).c_str());
  }
  ways.clear();
  fs::remove_all(folder);
  return 0;
}
