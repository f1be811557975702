#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "app/frame_writer.h"

namespace app {

/// Takes the frames of a flight and encodes them in a thread of its own, so that drawing goes on meanwhile.
///
/// What appears under the final names is whole: without finish() nothing is left behind.
class FrameSink {
 public:
  /// Throws what make_frame_writer throws.
  explicit FrameSink(const FrameOutput& output);
  FrameSink(const FrameSink&) = delete;
  FrameSink& operator=(const FrameSink&) = delete;
  ~FrameSink();

  /// Copies the frame (width x height RGBA bytes, top row first) and returns; waits only while kMaxWaiting
  /// frames wait already. Throws what went wrong with an earlier one.
  void write(std::span<const std::uint8_t> rgba);

  /// Waits for the last frame and brings the output under its final name. Throws Error when anything failed,
  /// or there was no frame.
  void finish();

  static constexpr std::size_t kMaxWaiting = 4;

 private:
  void work();
  void stop();

  std::unique_ptr<FrameWriter> writer_;
  [[maybe_unused]] std::size_t frame_bytes_;  ///< for an assertion
  std::size_t count_ = 0;

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::vector<std::uint8_t>> waiting_;
  std::exception_ptr failure_;
  bool closed_ = false;

  std::thread thread_;
};

}  // namespace app
