#include "globe/clipmap/stream.h"

#include <sys/resource.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <thread>
#include <utility>

namespace globe::clipmap {
namespace {

constexpr double kLeastCost = 0.05;  ///< of a level of which most stays; 1: filled from nothing
constexpr int kLitPerStep = 2;  ///< levels lit anew in one step because the sun moved: some 2 MB to send each
constexpr int kNiceness = 5;

/// Rough share of a level's region that stays when its nadir moves to a point.
double share_kept(const Settings& settings, const LevelData& held, const GridPoint& point) {
  const std::int64_t moved = hex_distance(images(grid_point(held.region.centre), point.d), point.at);
  return 1.0 - static_cast<double>(moved) / static_cast<double>(2 * settings.s * kSubcell);
}

}  // namespace

std::size_t StateUpdate::upload_bytes() const {
  std::size_t bytes = 0;
  for (const LevelUpdate& level : levels) bytes += level.upload_bytes();
  return bytes;
}

void make_base_ground(const Settings& settings, const planet::Surface& surface) {
  const int level = settings.base_level + settings.shading_levels_at(settings.base_level);
  const int tiles = std::max(1, planet::nodes_per_side(level) / planet::kTileCells);
  const auto all = static_cast<std::size_t>(planet::kDiamonds * tiles) * static_cast<std::size_t>(tiles);
  // Its parents are a third as many.
  if (surface.tile({0, level, 0, 0})->bytes() * (all + all / 3) > surface.cache_bytes()) return;
  tbb::parallel_for(0, planet::kDiamonds * tiles, [&](int k) {
    for (int ti = 0; ti < tiles; ++ti) surface.tile({k / tiles, level, ti, k % tiles});
  });
}

int levels_in_place(const Settings& settings, const ClipmapState& state, const dvec3& u) {
  const Nadir below(u);
  int count = 1;  // the base level always is
  for (; count < static_cast<int>(state.levels.size()); ++count) {
    const Region& region = state.levels[static_cast<std::size_t>(count)]->region;
    if (!(nearest_lattice_node(below.at(region.level), settings.unit()) == region.centre)) break;
  }
  return count;
}

int levels_ready(const Settings& settings, const ClipmapState& state, const Target& target) {
  const int wanted = target.finest - settings.base_level + 1;
  int count = 0;
  const int in_place = std::min(levels_in_place(settings, state, target.u), wanted);
  while (count < in_place && state.levels[static_cast<std::size_t>(count)]->lighting == target.lighting)
    ++count;
  return count;
}

bool still_holds(const Settings& settings, const ClipmapState& state, const Target& target) {
  return levels_ready(settings, state, target) == target.finest - settings.base_level + 1;
}

StateUpdate advance(const Settings& settings, const planet::Surface& surface, const Target& target,
                    const ClipmapState* before, Stride stride, int fills) {
  const int wanted = target.finest - settings.base_level + 1;
  const Nadir below(target.u);
  const auto held_at = [&](int k) -> const LevelData* {
    const auto index = static_cast<std::size_t>(k);
    return before != nullptr && index < before->levels.size() ? before->levels[index].get() : nullptr;
  };
  const auto in_place = [&](int k) {
    const LevelData* held = held_at(k);
    if (held == nullptr) return false;
    const GridPoint point = below.at(settings.base_level + k);
    return k == 0 || nearest_lattice_node(point, settings.unit()) == held->region.centre;
  };
  const auto is_lit = [&](int k) { return held_at(k)->lighting == target.lighting; };
  int count = wanted;
  int last_lit = wanted;  // levels beyond it keep the light they have, if that is all that is wrong with them
  if (stride == Stride::kStep) {
    double cost = 0.0;
    int lit = 0;
    last_lit = -1;
    for (count = 0; count < wanted && cost < fills - 0.5; ++count) {
      if (in_place(count)) {
        lit += is_lit(count) ? 0 : 1;
        if (lit <= kLitPerStep) last_lit = count;
        continue;
      }
      const LevelData* held = held_at(count);
      const double kept =
          held != nullptr ? share_kept(settings, *held, below.at(settings.base_level + count)) : 0.0;
      cost += std::clamp(1.0 - kept, kLeastCost, 1.0);
    }
  }
  const auto stays = [&](int k) { return in_place(k) && (is_lit(k) || k > last_lit); };
  auto state = std::make_shared<ClipmapState>();
  state->target = {target.u, settings.base_level + count - 1, target.lighting};
  state->levels.resize(static_cast<std::size_t>(count));
  std::vector<LevelUpdate> updates(static_cast<std::size_t>(count));
  tbb::parallel_for(0, count, [&](int k) {
    const auto index = static_cast<std::size_t>(k);
    if (stays(k)) {
      state->levels[index] = before->levels[index];
      return;
    }
    updates[index] = update_level(settings, surface, make_region(settings, below.at(settings.base_level + k)),
                                  target.lighting, held_at(k));
    state->levels[index] = updates[index].data;
  });
  if (count == wanted) {
    for (int k = count; held_at(k) != nullptr && in_place(k); ++k)
      state->levels.push_back(before->levels[static_cast<std::size_t>(k)]);
  }
  StateUpdate update{std::move(state), {}};
  for (LevelUpdate& level : updates) {
    if (level.data) update.levels.push_back(std::move(level));
  }
  return update;
}

Stream::Stream(Settings settings, std::shared_ptr<const planet::Surface> surface)
    : settings_(settings),
      surface_(std::move(surface)),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

Stream::~Stream() {
  thread_.request_stop();
  wake_.notify_all();
}

void Stream::request(const Target& target, std::shared_ptr<const ClipmapState> before) {
  {
    const std::lock_guard lock(mutex_);
    if (busy_ || result_) return;
    job_ = Job{target, std::move(before)};
  }
  wake_.notify_one();
}

std::optional<StateUpdate> Stream::take() {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  return std::exchange(result_, std::nullopt);
}

void Stream::forget() {
  const std::lock_guard lock(mutex_);
  result_.reset();
  if (busy_)
    unwanted_ = true;
  else
    job_.reset();
}

bool Stream::is_idle() const {
  const std::lock_guard lock(mutex_);
  return !busy_ && !result_;
}

void Stream::await() const {
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return !job_; });
}

int Stream::pending() const {
  const std::lock_guard lock(mutex_);
  if (!job_) return 0;
  return job_->target.finest - settings_.base_level + 1;
}

void Stream::work(const std::stop_token& stop) {
  // Drawing comes first: half the cores, and this thread gives way (on Linux niceness is a thread's own).
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness);
  const int threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / 2);
  tbb::task_arena arena(threads);
  for (;;) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      if (!wake_.wait(lock, stop, [this] { return job_.has_value() && !busy_ && !result_; })) return;
      job = *job_;
      busy_ = true;
    }
    std::optional<StateUpdate> result;
    std::exception_ptr failure;
    try {
      arena.execute([&] {
        result =
            advance(settings_, *surface_, job.target, job.before.get(), Stride::kStep, std::max(2, threads));
      });
    } catch (...) {
      failure = std::current_exception();
    }
    {
      const std::lock_guard lock(mutex_);
      busy_ = false;
      job_.reset();
      failure_ = failure;
      if (!std::exchange(unwanted_, false)) result_ = std::move(result);
    }
    done_.notify_all();
  }
}

}  // namespace globe::clipmap
