#include "globe/render/upload_queue.h"

#include <algorithm>
#include <chrono>
#include <tuple>
#include <utility>

namespace globe::render {
namespace {

using clipmap::NodeRect;

constexpr double kFirstPace = 1e-6;   ///< milliseconds a byte: 1 GB/s, until something was measured
constexpr double kNewestPace = 0.25;  ///< weight of the newest measurement

std::pair<NodeRect, NodeRect> halves(const NodeRect& rect) {
  NodeRect first = rect, second = rect;
  if (rect.height() > 1) {
    first.j1 = rect.j0 + rect.height() / 2 - 1;
    second.j0 = first.j1 + 1;
  } else {
    first.i1 = rect.i0 + rect.width() / 2 - 1;
    second.i0 = first.i1 + 1;
  }
  return {first, second};
}

}  // namespace

std::size_t UploadJob::bytes() const {
  return static_cast<std::size_t>(nodes.width()) * static_cast<std::size_t>(nodes.height()) * node_bytes;
}

UploadQueue::UploadQueue(Clock clock) : clock_(std::move(clock)) { ms_a_byte_.fill(kFirstPace); }

void UploadQueue::add(const UploadJob& job) {
  bytes_ += job.bytes();
  jobs_.push_back(job);
}

void UploadQueue::clear() {
  jobs_.clear();
  bytes_ = 0;
}

std::size_t UploadQueue::run(double ms, const std::function<void(const UploadJob&)>& perform) {
  const double begin = clock_();
  double now = begin;
  std::size_t done = 0;
  while (!jobs_.empty()) {
    const double left = ms - (now - begin);
    UploadJob job = jobs_.front();
    jobs_.pop_front();
    while (!job.is_whole() && job.bytes() > kSmallestBytes &&
           static_cast<double>(job.bytes()) > affordable(job, left)) {
      UploadJob rest = job;
      std::tie(job.nodes, rest.nodes) = halves(job.nodes);
      jobs_.push_front(rest);
    }
    if (done > 0 && static_cast<double>(job.bytes()) > affordable(job, left)) {
      jobs_.push_front(job);
      break;
    }
    perform(job);
    const double after = clock_();
    note(job, after - now);
    now = after;
    done += job.bytes();
    bytes_ -= job.bytes();
  }
  return done;
}

double UploadQueue::affordable(const UploadJob& job, double ms) const {
  return std::max(ms, 0.0) / ms_a_byte_[static_cast<std::size_t>(job.kind)];
}

void UploadQueue::note(const UploadJob& job, double took_ms) {
  double& pace = ms_a_byte_[static_cast<std::size_t>(job.kind)];
  // A clock too coarse to see the job says nothing of it.
  if (took_ms > 0.0) pace += kNewestPace * (took_ms / static_cast<double>(job.bytes()) - pace);
}

double UploadQueue::steady_milliseconds() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace globe::render
