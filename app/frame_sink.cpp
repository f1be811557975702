#include "app/frame_sink.h"

#include <cassert>

#include "globe/base/error.h"

namespace app {

FrameSink::FrameSink(const FrameOutput& output)
    : writer_(make_frame_writer(output)),
      frame_bytes_(static_cast<std::size_t>(output.width) * static_cast<std::size_t>(output.height) * 4),
      thread_([this] { work(); }) {}

FrameSink::~FrameSink() {
  {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
  }
  stop();
}

void FrameSink::write(std::span<const std::uint8_t> rgba) {
  assert(rgba.size() == frame_bytes_);
  std::vector<std::uint8_t> frame(rgba.begin(), rgba.end());
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return failure_ || waiting_.size() < kMaxWaiting; });
  if (failure_) std::rethrow_exception(failure_);
  waiting_.push_back(std::move(frame));
  ++count_;
  changed_.notify_all();
}

void FrameSink::finish() {
  stop();
  if (failure_) std::rethrow_exception(failure_);
  if (count_ == 0) throw globe::Error("the film", "it has no frames", "ask for one at least");
  writer_->finish();
}

void FrameSink::stop() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void FrameSink::work() {
  while (true) {
    std::vector<std::uint8_t> frame;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return closed_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      frame = std::move(waiting_.front());
      waiting_.pop_front();
    }
    changed_.notify_all();
    try {
      writer_->write(frame);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      failure_ = std::current_exception();
      changed_.notify_all();
      return;
    }
  }
}

}  // namespace app
