#include "converters/convert.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <utility>

#include "converters/body.h"
#include "converters/geoid.h"
#include "converters/layer_output.h"
#include "converters/map_plan.h"
#include "converters/number_text.h"
#include "converters/output_folder.h"
#include "converters/recipe.h"
#include "converters/report.h"
#include "converters/resources.h"
#include "converters/thesis_mapping.h"
#include "globe/base/error.h"

namespace converters {
namespace {

using globe::geo::Ellipsoid;

/// What one job takes while it runs: the values of its columns, and a window of the map.
constexpr std::size_t kJobBytes = std::size_t{48} << 20;

/// A layer's maps and the jobs that convert them.
struct Task {
  PlannedLayer layer;
  std::vector<Job> jobs;

  Task(PlannedLayer planned, bool mark_voids)
      : layer(std::move(planned)),
        jobs(jobs_of(is_of_heights() ? JobLayer::kHeight : JobLayer::kColor, layer.level)) {
    if (!mark_voids || !is_of_heights()) return;
    const std::vector<Job> marks = jobs_of(JobLayer::kVoid, layer.level);
    jobs.insert(jobs.end(), marks.begin(), marks.end());
  }
  bool is_of_heights() const { return layer.kind == MapKind::kHeights; }
  std::string what() const { return is_of_heights() ? "heights" : "color"; }
};

Ellipsoid ellipsoid_of(const ConvertOptions& options) {
  return options.ellipsoid.value_or(globe::geo::kWgs84);
}

std::vector<Task> plan(const ConvertOptions& options, const Report& report) {
  const Ellipsoid ellipsoid = ellipsoid_of(options);
  report.note("ellipsoid a = " + number_text(ellipsoid.a) +
              " m, f = " + (ellipsoid.f == 0.0 ? "0" : "1/" + number_text(1.0 / ellipsoid.f)) +
              (options.ellipsoid ? "" : " (wgs84 assumed; --ellipsoid)"));
  if (options.as_thesis) {
    const double shift_m = kThesisShift_deg * std::numbers::pi / 180.0 * ellipsoid.mean_radius();
    report.warning("--as-thesis puts the ground up to " + number_text(std::round(shift_m / 1000.0)) +
                   " km from where it is; for comparison only");
  }
  const int threads = thread_count(options.threads);
  std::vector<Task> tasks;
  const auto add = [&](const std::vector<MapInput>& inputs, MapKind kind, std::optional<int> level) {
    if (!inputs.empty())
      tasks.emplace_back(plan_layer(inputs, kind, level, options, ellipsoid, threads, report),
                         options.mark_voids);
  };
  add(options.heights, MapKind::kHeights, options.level);
  add(options.colors, MapKind::kColors, options.heights.empty() ? options.level : std::nullopt);
  return tasks;
}

std::size_t jobs_in(const std::vector<Task>& tasks) {
  std::size_t all = 0;
  for (const Task& task : tasks) all += task.jobs.size();
  return all;
}

/// A conversion under way.
class Conversion {
 public:
  Conversion(const ConvertOptions& options, const Report& report, std::vector<Task> tasks,
             OutputFolder::Sharing sharing)
      : options_(options),
        report_(report),
        ellipsoid_(ellipsoid_of(options)),
        threads_(thread_count(options.threads)),
        tasks_(std::move(tasks)),
        sharing_(sharing),
        output_(options.planet, options.overwrite, recipe_of(options), sharing),
        limit_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads_)),
        arena_(threads_) {
    const std::size_t cap = memory_cap(options.memory_bytes);
    const std::size_t free = cap - std::min(cap, kReservedBytes);
    workers_ = static_cast<int>(
        std::clamp<std::size_t>(free / 2 / kJobBytes, 1, static_cast<std::size_t>(threads_)));
    const std::size_t for_jobs = static_cast<std::size_t>(workers_) * kJobBytes;
    budget_ = {free - std::min(free, for_jobs), output_.path()};
  }

  const std::vector<Task>& tasks() const { return tasks_; }

  void run_jobs(Team& team) {
    const std::size_t done = done_jobs(), all = all_jobs();
    if (done > 0) {
      report_.note("going on where " + output_.path().string() + " was left: " + std::to_string(done) +
                   " of " + std::to_string(all) + " parts are done");
    }
    for (std::size_t list = 0; list < tasks_.size(); ++list) run_jobs(team, list);
  }

  bool all_done() const { return done_jobs() == all_jobs(); }
  std::size_t done_jobs() const {
    std::size_t done = 0;
    for (const Task& task : tasks_) {
      done += static_cast<std::size_t>(std::count_if(
          task.jobs.begin(), task.jobs.end(), [&](const Job& job) { return output_.done(job).has_value(); }));
    }
    return done;
  }
  std::size_t all_jobs() const { return jobs_in(tasks_); }
  OutputFolder& output() { return output_; }

  /// Everything after the jobs: coarser levels, the files, planet.json, the name.
  void finish() {
    globe::planet::PlanetFile file;
    const std::filesystem::path name =
        options_.planet.has_filename() ? options_.planet : options_.planet.parent_path();
    file.info.name = name.filename().string();
    file.info.body = body_of(ellipsoid_);
    file.info.ellipsoid = ellipsoid_;
    file.info.vertical_datum = vertical_datum();
    file.info.tile_size = kTileSize;
    file.info.credits = options_.credits;
    for (const Task& task : tasks_) {
      std::vector<globe::planet::StoredLayer> layers = write(task);
      file.layers.insert(file.layers.end(), std::make_move_iterator(layers.begin()),
                         std::make_move_iterator(layers.end()));
      const std::vector<std::string> credits = credits_of(task.layer);
      file.info.credits.insert(file.info.credits.end(), credits.begin(), credits.end());
    }
    file.info.credits.push_back("converted by " + options_.program_version);
    globe::planet::write_planet_file(output_.path(), std::move(file));
    output_.finish();
  }

 private:
  /// Reading the map stays outside the arena: OpenImageIO has threads of its own, which do not go well with
  /// tasks that wait.
  void run_jobs(Team& team, std::size_t list) {
    Task& task = tasks_[list];
    const std::function<void(double)> progress = report_.stage("converting " + task.what());
    std::size_t first = team.claim(list);
    while (first < task.jobs.size() && output_.done(task.jobs[first])) first = team.claim(list);
    if (first >= task.jobs.size()) return;
    const std::unique_ptr<const Geoid> geoid = task.is_of_heights() ? open_geoid() : nullptr;
    const SpoolFolder spools{output_.parts().folder, sharing_ == OutputFolder::Sharing::kInTeam};
    const MapStack maps = load_layer(task.layer, budget_, report_, fate_of_voids(), spools);
    std::atomic<double> done = static_cast<double>(std::count_if(
        task.jobs.begin(), task.jobs.end(), [&](const Job& job) { return output_.done(job).has_value(); }));
    const NodeSource values = [&](const NodeRect& rect, const RowSink& sink) {
      if (geoid) {
        sample_above_ellipsoid(maps, *geoid, rect, sink);
      } else {
        sample_nodes(maps, rect, options_.voids, sink, [](double) {});
      }
    };
    const NodeSource marks = [&](const NodeRect& rect, const RowSink& sink) { mark_voids(maps, rect, sink); };
    const auto run = [&](const Job& job) {
      const NodeSource& nodes = job.layer == JobLayer::kVoid ? marks : values;
      double before = 0;
      const Range range = run_job(job, nodes, ellipsoid_, output_.parts(), [&](double now) {
        const double all = done += now - before;
        before = now;
        progress(std::min(1.0, all / static_cast<double>(task.jobs.size())));
      });
      output_.mark_done(job, range);
    };
    std::atomic<std::size_t> given = first;  // to the first worker
    arena_.execute([&] {
      tbb::parallel_for(
          0, workers_, 1,
          [&](int) {
            std::size_t k = given.exchange(task.jobs.size());
            if (k >= task.jobs.size()) k = team.claim(list);
            for (; k < task.jobs.size(); k = team.claim(list)) {
              // A worker that waits for its own blocks must not begin another's job meanwhile.
              if (!output_.done(task.jobs[k])) tbb::this_task_arena::isolate([&] { run(task.jobs[k]); });
            }
          },
          tbb::simple_partitioner{});
    });
    if (sharing_ == OutputFolder::Sharing::kAlone) {  // others may still need them
      for (std::size_t k = 0; k < task.layer.maps.size(); ++k)
        std::filesystem::remove(spool_file(spools, task.layer.kind, k));
    }
  }

  std::string fate_of_voids() const {
    if (options_.mark_voids) return "filled from around it and marked";
    return options_.voids == Gaps::kFill ? "filled from around it" : "set to 0";
  }

  /// 1 where nothing valid of any map is in reach of the node, else 0.
  static void mark_voids(const MapStack& maps, const NodeRect& rect, const RowSink& sink) {
    const RowSink mark = [&](int i, int j, int count, const float*, const float* weights) {
      std::vector<float> marks(static_cast<std::size_t>(count));
      std::transform(weights, weights + count, marks.begin(), [](float w) { return w > 0.0F ? 0.0F : 1.0F; });
      sink(i, j, count, marks.data(), weights);
    };
    sample_nodes(maps, rect, Gaps::kZero, mark, [](double) {});
  }

  std::unique_ptr<const Geoid> open_geoid() {
    if (options_.geoid.empty()) return nullptr;
    return converters::open_geoid(options_.geoid, {ellipsoid_, options_.latitude}, budget_);
  }

  void sample_above_ellipsoid(const MapStack& maps, const Geoid& geoid, const NodeRect& rect,
                              const RowSink& sink) const {
    std::vector<float> heights(static_cast<std::size_t>(rect.ni) * static_cast<std::size_t>(rect.nj));
    std::vector<float> weights(heights.size());
    sample_rect(maps, rect, options_.voids, heights.data(), weights.data());
    geoid.add(rect, heights.data());
    for (int j = 0; j < rect.nj; ++j) {
      const auto first = static_cast<std::size_t>(j) * static_cast<std::size_t>(rect.ni);
      sink(rect.i0, rect.j0 + j, rect.ni, heights.data() + first, weights.data() + first);
    }
  }

  /// By name, by what --geoid makes of it, or as the files of the heights name it.
  std::string vertical_datum() const {
    if (options_.datum) return *options_.datum;
    if (!options_.geoid.empty()) return "ellipsoid";
    for (const Task& task : tasks_) {
      if (task.is_of_heights()) return datum_of(task.layer).value_or("unknown");
    }
    return "unknown";
  }

  Range range_of(const Task& task) const {
    Range all = output_.done(task.jobs.front()).value();
    for (const Job& job : task.jobs) {
      if (job.layer == JobLayer::kVoid) continue;
      const Range range = output_.done(job).value();
      all = {std::min(all.min, range.min), std::max(all.max, range.max)};
    }
    return all;
  }

  std::vector<globe::planet::StoredLayer> write(const Task& task) {
    std::vector<globe::planet::StoredLayer> stored;
    arena_.execute([&] {
      std::vector<LayerOutput> layers;
      if (task.is_of_heights()) {
        layers = height_layers(task.layer.level, range_of(task), output_.parts(), ellipsoid_, budget_);
        if (options_.mark_voids) layers.push_back(void_layer(task.layer.level, output_.parts(), budget_));
      } else {
        layers.push_back(color_layer(task.layer.level, output_.parts(), budget_));
      }
      stored = write_layers(layers, output_.path(), report_.stage("writing " + task.what()));
    });
    return stored;
  }

  const ConvertOptions& options_;
  const Report& report_;
  Ellipsoid ellipsoid_;
  int threads_;
  std::vector<Task> tasks_;
  OutputFolder::Sharing sharing_;
  OutputFolder output_;
  tbb::global_control limit_;
  tbb::task_arena arena_;
  int workers_ = 1;  ///< jobs at a time
  MemoryBudget budget_;
};

/// One job of the list of all, by its number.
class OneJob : public Team {
 public:
  OneJob(const std::vector<Task>& tasks, std::size_t number) {
    std::size_t first = 0;
    for (const Task& task : tasks) {
      const std::size_t count = task.jobs.size();
      given_.push_back(number >= first && number - first < count ? number - first : count);
      first += count;
    }
  }
  std::size_t claim(std::size_t list) override {
    return std::exchange(given_[list], std::numeric_limits<std::size_t>::max());
  }
  bool gather(bool all_done) override { return all_done; }

 private:
  std::vector<std::size_t> given_;
};

}  // namespace

std::vector<Job> list_jobs(const ConvertOptions& options, const ConvertListener& listener) {
  const Report report(listener);
  std::vector<Job> jobs;
  for (const Task& task : plan(options, report)) jobs.insert(jobs.end(), task.jobs.begin(), task.jobs.end());
  return jobs;
}

void convert(const ConvertOptions& options, const ConvertListener& listener) {
  const Report report(listener);
  Conversion conversion(options, report, plan(options, report), OutputFolder::Sharing::kAlone);
  Alone team(conversion.tasks().size());
  conversion.run_jobs(team);
  conversion.finish();
}

void convert_with(Team& team, const ConvertOptions& options, const ConvertListener& listener) {
  const Report report(listener);
  Conversion conversion(options, report, plan(options, report), OutputFolder::Sharing::kInTeam);
  conversion.run_jobs(team);
  if (team.gather(conversion.all_done()) && conversion.output().take_over()) conversion.finish();
}

bool convert_job(int number, const ConvertOptions& options, const ConvertListener& listener) {
  const Report report(listener);
  std::vector<Task> tasks = plan(options, report);
  if (number < 0 || static_cast<std::size_t>(number) >= jobs_in(tasks)) {
    throw globe::UsageError("--job " + std::to_string(number),
                            "there are jobs 0 to " + std::to_string(jobs_in(tasks) - 1), "see --jobs");
  }
  OneJob team(tasks, static_cast<std::size_t>(number));
  Conversion conversion(options, report, std::move(tasks), OutputFolder::Sharing::kInTeam);
  conversion.run_jobs(team);
  if (!team.gather(conversion.all_done())) {
    report.note("job " + std::to_string(number) + " is done, " + std::to_string(conversion.done_jobs()) +
                " of " + std::to_string(conversion.all_jobs()));
    return false;
  }
  if (conversion.output().take_over()) conversion.finish();
  return true;
}

}  // namespace converters
