#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>

namespace app {

/// Where frames go and how. `output` is one of
///   frames/####.png, frames/%04d.png   numbered pictures from 0 on; the folder is made when missing
///   out.mp4, out.gif                   by the program ffmpeg
///   -                                  Y4M (4:4:4) on standard output
struct FrameOutput {
  std::string output;
  int width = 0;
  int height = 0;
  double fps = 30.0;
  bool overwrite = false;
  std::FILE* standard_output = stdout;  ///< what "-" writes to
};

/// Encodes frame after frame in the calling thread. Destroyed without finish(), it leaves nothing behind.
class FrameWriter {
 public:
  virtual ~FrameWriter() = default;
  /// One frame of width x height RGBA bytes, top row first; alpha is ignored.
  virtual void write(std::span<const std::uint8_t> rgba) = 0;
  /// Brings everything under its final name.
  virtual void finish() = 0;
};

/// The writer for an output. Throws UsageError for an output of no known kind, Error when it exists already
/// or ffmpeg is needed and missing.
std::unique_ptr<FrameWriter> make_frame_writer(const FrameOutput& output);

/// A frame rate as a fraction: 30/1, 30000/1001 for 29.97, else thousandths.
struct FrameRate {
  int numerator;
  int denominator;
};
FrameRate frame_rate(double fps);

}  // namespace app
