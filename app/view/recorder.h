#pragma once

#include <filesystem>
#include <string>

#include "app/frame_sink.h"
#include "globe/gl/framebuffer.h"

namespace app::view {

/// A film of a window, in the time that passes: frames that come late are shown longer.
class Recorder {
 public:
  static constexpr double kFps = 30.0;

  /// Throws what make_frame_writer throws.
  Recorder(const std::filesystem::path& file, int width, int height);

  /// What is seen since `time_s` (of any clock, rising).
  void show(const globe::gl::Framebuffer& picture, double time_s);
  /// Throws Error when it could not be written.
  void finish() { sink_.finish(); }

  const std::filesystem::path& file() const { return file_; }
  double seconds() const { return static_cast<double>(frames_) / kFps; }

 private:
  std::filesystem::path file_;
  FrameSink sink_;
  std::vector<std::uint8_t> shown_;
  double begin_s_ = 0;
  std::size_t frames_ = 0;
};

/// FOLDER/globe-N.EXTENSION with the first N that is free.
std::filesystem::path free_name(const std::filesystem::path& folder, const std::string& extension);

}  // namespace app::view
