#include "globe/render/loader.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "globe/clipmap/morph.h"

namespace globe::render {
namespace {

constexpr double kNewest = 0.2;    ///< weight of the newest latency
constexpr int kFarthestLead = 30;  ///< frames
constexpr int kFarthest = 100;     ///< frames to look ahead; each look is twice as far as the one before
constexpr int kDeepestAhead = 3;   ///< levels finer than what is wanted now

}  // namespace

Loader::Loader(const clipmap::Settings& settings, std::shared_ptr<const planet::Surface> surface,
               int max_level, bool ahead)
    : settings_(settings),
      surface_(std::move(surface)),
      max_level_(max_level),
      ahead_(ahead),
      textures_(settings) {}

Loader::Uploaded Loader::load_whole(const clipmap::Target& target) {
  stream_.reset();
  textures_.abandon();
  if (state_ && clipmap::still_holds(settings_, *state_, target)) {
    follow(target);
    return {};
  }
  clipmap::StateUpdate update =
      clipmap::advance(settings_, *surface_, target, state_.get(), clipmap::Stride::kWhole);
  state_ = update.state;
  const double begin = UploadQueue::steady_milliseconds();
  const std::size_t bytes = textures_.apply(std::move(update));
  return {bytes, UploadQueue::steady_milliseconds() - begin};
}

Loader::Uploaded Loader::load_some(const clipmap::Target& target, double height_m, double ms) {
  ++frame_;
  forecast_.note({target.u, height_m});
  if (!stream_) stream_ = std::make_unique<clipmap::Stream>(settings_, surface_);
  Uploaded sum;
  do {
    const double begin = UploadQueue::steady_milliseconds();
    if (!textures_.loading()) {
      auto update = stream_->take();
      if (!update) break;
      textures_.begin(std::move(*update));
      loading_asked_at_ = asked_at_;
      arrival_noted_ = false;
    }
    if (!textures_.is_loaded()) {
      sum.bytes += textures_.upload(ms - sum.ms);
      sum.ms += UploadQueue::steady_milliseconds() - begin;
    }
    if (!textures_.is_loaded()) break;
    if (!std::exchange(arrival_noted_, true))
      latency_frames_ += kNewest * (frame_ - loading_asked_at_ - latency_frames_);
  } while (swap_if_due(target) && sum.ms < ms);
  follow(target);
  ask(target);
  return sum;
}

bool Loader::swap_if_due(const clipmap::Target& target) {
  const clipmap::ClipmapState& next = *textures_.loading();
  const auto ready = [&](const clipmap::ClipmapState& state, const clipmap::Target& there) {
    return clipmap::levels_ready(settings_, state, there);
  };
  const int all = target.finest - settings_.base_level + 1;
  const int drawn = ready(*state_, target), loaded = ready(next, target);
  if (loaded < all && loaded <= drawn) {
    const bool nearer =
        drawn < all && glm::distance(target.u, next.target.u) < glm::distance(target.u, state_->target.u);
    if (!nearer) {
      const bool will_be_better = any_horizon([&](int frames) {
        const clipmap::Target later = target_in(frames, target);
        return ready(next, later) > ready(*state_, later);
      });
      if (!will_be_better) {
        textures_.abandon();
        stream_->forget();  // it was computed from what is abandoned
      }
      return false;
    }
  }
  state_ = textures_.swap();
  return true;
}

void Loader::follow(const clipmap::Target& target) {
  const int in_place = clipmap::levels_in_place(settings_, *state_, target.u);
  const int wanted = target.finest - settings_.base_level + 1;
  if (in_place < std::min(wanted, static_cast<int>(state_->levels.size()))) return;
  auto moved = std::make_shared<clipmap::ClipmapState>(*state_);
  moved->target.u = target.u;
  moved->target.finest = settings_.base_level + in_place - 1;
  state_ = std::move(moved);
}

void Loader::ask(const clipmap::Target& target) {
  if (!stream_->is_idle()) return;
  const auto head = textures_.loading() ? textures_.loading() : state_;
  const auto request = [&](const clipmap::Target& wanted) {
    stream_->request(wanted, head);
    asked_at_ = frame_;
  };
  const bool asked = any_horizon([&](int frames) {
    clipmap::Target there = target_in(frames, target);
    if (clipmap::still_holds(settings_, *head, there)) return false;
    // The next finer level, where it is at hand, comes along.
    there.finest = std::max(there.finest, std::min(target.finest + 1, head->finest_level()));
    request(there);
    return true;
  });
  if (asked || target.finest >= max_level_) return;
  // Nothing is missing: make the next finer level ready, so that it is there when the camera comes down to
  // it.
  clipmap::Target finer = target;
  ++finer.finest;
  if (!clipmap::still_holds(settings_, *head, finer) && clipmap::still_holds(settings_, *head, target))
    request(finer);
}

clipmap::Target Loader::target_in(int frames, const clipmap::Target& now) const {
  const Forecast::Place place = forecast_.ahead(frames);
  const auto finest =
      clipmap::finest_level(settings_, surface_->root_edge(), std::max(place.height_m, 0.1), max_level_);
  return {place.u, std::min(finest.level, now.finest + kDeepestAhead), now.lighting};
}

template <class Visit>
bool Loader::any_horizon(const Visit& visit) const {
  if (!ahead_ || !forecast_.is_moving()) return visit(0);
  const int first = std::clamp(static_cast<int>(std::lround(latency_frames_)), 1, kFarthestLead);
  for (int frames = first; frames <= kFarthest; frames *= 2) {
    if (visit(frames)) return true;
  }
  return false;
}

int Loader::queued_jobs() const {
  return static_cast<int>(textures_.queued_jobs()) + (stream_ ? stream_->pending() : 0);
}

void Loader::await_computing() const {
  if (stream_) stream_->await();
}

}  // namespace globe::render
