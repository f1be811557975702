#include "app/view/recorder.h"

namespace app::view {

Recorder::Recorder(const std::filesystem::path& file, int width, int height)
    : file_(file), sink_({file.string(), width, height, kFps, false}) {}

void Recorder::show(const globe::gl::Framebuffer& picture, double time_s) {
  if (frames_ == 0) {
    begin_s_ = time_s;
    shown_ = picture.read_rgba8();
    sink_.write(shown_);
    frames_ = 1;
    return;
  }
  const double due = (time_s - begin_s_) * kFps;
  if (static_cast<double>(frames_) > due) return;
  while (static_cast<double>(frames_ + 1) <= due) {
    sink_.write(shown_);
    ++frames_;
  }
  shown_ = picture.read_rgba8();
  sink_.write(shown_);
  ++frames_;
}

std::filesystem::path free_name(const std::filesystem::path& folder, const std::string& extension) {
  for (int n = 1;; ++n) {
    std::filesystem::path path = folder / ("globe-" + std::to_string(n) + extension);
    if (!std::filesystem::exists(path)) return path;
  }
}

}  // namespace app::view
