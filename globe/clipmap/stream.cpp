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

constexpr double kStepCost = 1.5;  ///< levels filled from nothing in one step, strips counted by their share
constexpr double kStripCost = 0.15;
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

bool still_holds(const Settings& settings, const ClipmapState& state, const Target& target) {
  if (state.finest_level() < target.finest) return false;
  for (int level = settings.base_level; level <= target.finest; ++level) {
    const auto& data = state.levels[static_cast<std::size_t>(level - settings.base_level)];
    if (!(data->lighting == target.lighting)) return false;
    if (level == settings.base_level) continue;
    if (!(nearest_lattice_node(nadir(target.u, level), settings.unit()) == data->region.centre)) return false;
  }
  return true;
}

StateUpdate advance(const Settings& settings, const planet::Surface& surface, const Target& target,
                    const ClipmapState* before, Stride stride) {
  const int wanted = target.finest - settings.base_level + 1;
  const auto held_at = [&](int k) -> const LevelData* {
    const auto index = static_cast<std::size_t>(k);
    return before != nullptr && index < before->levels.size() ? before->levels[index].get() : nullptr;
  };
  const auto in_place = [&](int k) {
    const LevelData* held = held_at(k);
    if (held == nullptr) return false;
    const GridPoint point = nadir(target.u, settings.base_level + k);
    return k == 0 || nearest_lattice_node(point, settings.unit()) == held->region.centre;
  };
  const auto is_lit = [&](int k) { return held_at(k)->lighting == target.lighting; };
  int count = wanted;
  int last_lit = wanted;  // levels beyond it keep the light they have, if that is all that is wrong with them
  if (stride == Stride::kStep) {
    double cost = 0.0;
    int lit = 0;
    last_lit = -1;
    for (count = 0; count < wanted && cost < kStepCost; ++count) {
      if (in_place(count)) {
        lit += is_lit(count) ? 0 : 1;
        if (lit <= kLitPerStep) last_lit = count;
        continue;
      }
      const LevelData* held = held_at(count);
      const bool overlaps =
          held != nullptr && share_kept(settings, *held, nadir(target.u, settings.base_level + count)) > 0.5;
      cost += overlaps ? kStripCost : 1.0;
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
    updates[index] =
        update_level(settings, surface, make_region(settings, nadir(target.u, settings.base_level + k)),
                     target.lighting, held_at(k));
    state->levels[index] = updates[index].data;
  });
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

int Stream::pending() const {
  const std::lock_guard lock(mutex_);
  if (!job_) return 0;
  return job_->target.finest - settings_.base_level + 1;
}

void Stream::work(const std::stop_token& stop) {
  // Drawing comes first: half the cores, and this thread gives way (on Linux niceness is a thread's own).
  setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness);
  tbb::task_arena arena(std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / 2));
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
      arena.execute(
          [&] { result = advance(settings_, *surface_, job.target, job.before.get(), Stride::kStep); });
    } catch (...) {
      failure = std::current_exception();
    }
    const std::lock_guard lock(mutex_);
    busy_ = false;
    job_.reset();
    result_ = std::move(result);
    failure_ = failure;
  }
}

}  // namespace globe::clipmap
