#include "app/frame_writer.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <regex>
#include <system_error>
#include <vector>

#include "app/image_file.h"
#include "app/piped_program.h"
#include "globe/base/error.h"
#include "globe/base/pending_file.h"

namespace app {
namespace {

namespace fs = std::filesystem;
using globe::Error;
using globe::PendingFile;
using globe::UsageError;

/// A file name with a number in it.
struct NumberedName {
  fs::path folder;
  std::string before, after;
  std::size_t digits = 0;

  fs::path path(std::size_t number) const {
    std::string text = std::to_string(number);
    if (text.size() < digits) text.insert(0, digits - text.size(), '0');
    return folder / (before + text + after);
  }

  /// The number in a file name of this shape.
  std::optional<std::size_t> number(const std::string& name) const {
    if (name.size() < before.size() + after.size() + 1 || !name.starts_with(before) ||
        !name.ends_with(after)) {
      return std::nullopt;
    }
    const std::string text = name.substr(before.size(), name.size() - before.size() - after.size());
    const bool all_digits = text.find_first_not_of("0123456789") == std::string::npos;
    if (!all_digits || text.size() < digits || text.size() > 9) return std::nullopt;
    return std::stoul(text);
  }
};

std::optional<NumberedName> numbered_name(const std::string& output) {
  static const std::regex pattern(R"re(^([^#%]*)(?:(#+)|%(?:0([1-9]))?d)([^#%]*)$)re");
  const fs::path path(output);
  const std::string name = path.filename().string();
  std::smatch match;
  if (!std::regex_match(name, match, pattern)) return std::nullopt;
  NumberedName result;
  result.folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  result.before = match[1].str();
  result.after = match[4].str();
  result.digits = match[2].matched   ? match[2].str().size()
                  : match[3].matched ? std::stoul(match[3].str())
                                     : 1;
  return result;
}

/// Numbered PNGs. They are written into a folder of their own inside the target folder and moved out at the
/// end. With overwrite the sequence is replaced: frames of an older, longer one that lie beyond the last go.
class PngSequence : public FrameWriter {
 public:
  PngSequence(const FrameOutput& output, NumberedName name)
      : width_(output.width), height_(output.height), name_(std::move(name)) {
    if (fs::exists(name_.folder) && !output.overwrite) {
      for (const auto& [number, path] : existing()) globe::refuse_existing(path, false);
    }
    for (fs::path missing = name_.folder; !missing.empty() && !fs::exists(missing);
         missing = missing.parent_path()) {
      made_.push_back(missing);
    }
    temporary_ = name_.folder / ("." + std::to_string(::getpid()) + ".partial");
    std::error_code failure;
    fs::create_directories(temporary_, failure);
    if (failure)
      throw Error(name_.folder.string(), failure.message(), "give a folder that can be written to");
  }

  ~PngSequence() override {
    std::error_code ignored;
    fs::remove_all(temporary_, ignored);
    if (finished_) return;
    for (const fs::path& folder : made_) fs::remove(folder, ignored);
  }

  void write(std::span<const std::uint8_t> rgba) override {
    write_png(temporary_ / name_.path(count_).filename(), {width_, height_, rgba});
    ++count_;
  }

  void finish() override {
    for (std::size_t i = 0; i < count_; ++i) {
      const fs::path path = name_.path(i);
      const fs::path written = temporary_ / path.filename();
      std::error_code failure;
      if (!globe::flush_to_disk(written)) failure = std::make_error_code(std::errc::io_error);
      if (!failure) fs::rename(written, path, failure);
      if (failure) throw Error(path.string(), failure.message(), "check the disk and its free space");
    }
    for (const auto& [number, path] : existing()) {
      if (number >= count_) fs::remove(path);
    }
    finished_ = true;
  }

 private:
  std::vector<std::pair<std::size_t, fs::path>> existing() const {
    std::vector<std::pair<std::size_t, fs::path>> found;
    for (const auto& entry : fs::directory_iterator(name_.folder)) {
      if (const auto number = name_.number(entry.path().filename().string()))
        found.emplace_back(*number, entry.path());
    }
    return found;
  }

  int width_, height_;
  NumberedName name_;
  fs::path temporary_;
  std::vector<fs::path> made_;  ///< folders that were not there before, innermost first
  std::size_t count_ = 0;
  bool finished_ = false;
};

std::vector<std::string> ffmpeg_input(const FrameOutput& output) {
  const FrameRate rate = frame_rate(output.fps);
  return {"ffmpeg",
          "-hide_banner",
          "-loglevel",
          "error",
          "-y",
          "-f",
          "rawvideo",
          "-pix_fmt",
          "rgb0",
          "-video_size",
          std::to_string(output.width) + "x" + std::to_string(output.height),
          "-framerate",
          std::to_string(rate.numerator) + "/" + std::to_string(rate.denominator),
          "-i",
          "pipe:0",
          "-an"};
}

/// H.264 that every player shows: 4:2:0, so even sizes (an odd picture gets one more black row or column),
/// colours labelled BT.709. Preset faster takes two thirds of medium's time for files 4 % larger. A fixed
/// number of threads, since x264's bytes depend on it.
std::vector<std::string> mp4_arguments() {
  const std::string even = "pad=ceil(iw/2)*2:ceil(ih/2)*2";
  const std::string to_bt709 =
      "scale=out_color_matrix=bt709:out_range=tv:flags=bicubic+accurate_rnd+full_chroma_int+bitexact";
  return {"-vf",
          even + "," + to_bt709 + ",format=yuv420p",
          "-c:v",
          "libx264",
          "-preset",
          "faster",
          "-crf",
          "18",
          "-threads",
          "4",
          "-colorspace",
          "bt709",
          "-color_primaries",
          "bt709",
          "-color_trc",
          "iec61966-2-1",
          "-movflags",
          "+faststart",
          "-fflags",
          "+bitexact",
          "-flags:v",
          "+bitexact",
          "-f",
          "mp4"};
}

/// A palette for each frame: one for the whole flight would have ffmpeg hold every frame in memory.
std::vector<std::string> gif_arguments() {
  return {"-filter_complex",
          "split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:dither=bayer:bayer_scale=4",
          "-fflags",
          "+bitexact",
          "-flags:v",
          "+bitexact",
          "-f",
          "gif"};
}

/// A film by way of ffmpeg.
class Film : public FrameWriter {
 public:
  Film(const FrameOutput& output, std::vector<std::string> encoding)
      : file_(output.output, output.overwrite),
        program_(
            arguments(output, std::move(encoding), file_.temporary()),
            "install ffmpeg (Debian: apt install ffmpeg) or write numbered pictures, -o 'frames/####.png'") {}

  void write(std::span<const std::uint8_t> rgba) override { program_.write(rgba); }
  void finish() override {
    program_.finish();
    file_.publish();
  }

 private:
  static std::vector<std::string> arguments(const FrameOutput& output, std::vector<std::string> encoding,
                                            const fs::path& path) {
    std::vector<std::string> result = ffmpeg_input(output);
    result.insert(result.end(), encoding.begin(), encoding.end());
    result.push_back("file:" + path.string());
    return result;
  }

  PendingFile file_;
  PipedProgram program_;
};

/// Y4M, 4:4:4, limited range. The format does not say which matrix: the one that players assume for the size,
/// BT.709 for large pictures and BT.601 for small.
class Y4m : public FrameWriter {
 public:
  explicit Y4m(const FrameOutput& output)
      : file_(output.standard_output),
        planes_(static_cast<std::size_t>(output.width) * static_cast<std::size_t>(output.height) * 3),
        yuv_from_rgb_(output.width >= 1280 || output.height > 576 ? limited_range(0.2126, 0.0722)
                                                                  : limited_range(0.299, 0.114)) {
    const FrameRate rate = frame_rate(output.fps);
    std::fprintf(file_, "YUV4MPEG2 W%d H%d F%d:%d Ip A1:1 C444 XCOLORRANGE=LIMITED\n", output.width,
                 output.height, rate.numerator, rate.denominator);
  }

  void write(std::span<const std::uint8_t> rgba) override {
    const std::size_t count = planes_.size() / 3;
    for (std::size_t plane = 0; plane < 3; ++plane) {
      const auto [red, green, blue, offset] = yuv_from_rgb_[plane];
      std::uint8_t* levels = planes_.data() + plane * count;
      for (std::size_t i = 0; i < count; ++i) {
        const int level = red * rgba[4 * i] + green * rgba[4 * i + 1] + blue * rgba[4 * i + 2] + offset;
        levels[i] = static_cast<std::uint8_t>(level >> kFractionBits);
      }
    }
    if (std::fputs("FRAME\n", file_) < 0 ||
        std::fwrite(planes_.data(), 1, planes_.size(), file_) != planes_.size()) {
      throw Error("standard output", "it takes no more", "check the program that reads from the pipe");
    }
  }

  void finish() override {
    if (std::fflush(file_) != 0) {
      throw Error("standard output", "it takes no more", "check the program that reads from the pipe");
    }
  }

 private:
  /// Coefficients of red, green, blue and 1, fixed point with kFractionBits.
  using Row = std::array<int, 4>;
  static constexpr int kFractionBits = 16;

  /// Limited range (16 to 235, 16 to 240), for the shares of red and blue in brightness.
  static std::array<Row, 3> limited_range(double red, double blue) {
    const double green = 1.0 - red - blue;
    constexpr double kY = 219.0 / 255.0, kC = 112.0 / 255.0;
    const double u = kC / (1.0 - blue), v = kC / (1.0 - red);
    return {row(kY * red, kY * green, kY * blue, 16.0), row(-u * red, -u * green, kC, 128.0),
            row(kC, -v * green, -v * blue, 128.0)};
  }

  /// The offset carries the half that rounds.
  static Row row(double red, double green, double blue, double offset) {
    const auto fixed = [](double value) {
      return static_cast<int>(std::lround(std::ldexp(value, kFractionBits)));
    };
    return {fixed(red), fixed(green), fixed(blue), fixed(offset + 0.5)};
  }

  std::FILE* file_;
  std::vector<std::uint8_t> planes_;
  std::array<Row, 3> yuv_from_rgb_;
};

}  // namespace

FrameRate frame_rate(double fps) {
  if (!(fps > 0.0 && fps <= 1000.0)) {
    throw UsageError("--fps", "it must be above 0 and at most 1000", "give frames a second, such as 30");
  }
  const double whole = std::round(fps);
  if (fps == whole) return {static_cast<int>(whole), 1};
  const double ntsc = std::ceil(fps);
  if (std::abs(fps - ntsc * 1000.0 / 1001.0) < 0.005) return {static_cast<int>(ntsc) * 1000, 1001};
  return {std::max(1, static_cast<int>(std::lround(fps * 1000.0))), 1000};
}

std::unique_ptr<FrameWriter> make_frame_writer(const FrameOutput& output) {
  frame_rate(output.fps);
  if (output.output == "-") return std::make_unique<Y4m>(output);
  const fs::path path(output.output);
  const auto name = numbered_name(output.output);
  if (path.extension() == ".png" && name) return std::make_unique<PngSequence>(output, *name);
  if (path.extension() == ".mp4") return std::make_unique<Film>(output, mp4_arguments());
  if (path.extension() == ".gif") return std::make_unique<Film>(output, gif_arguments());
  throw UsageError("output '" + output.output + "'", "no kind of film",
                   "give out.mp4, out.gif, frames/####.png or - (Y4M)");
}

}  // namespace app
