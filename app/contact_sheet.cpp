#include "app/contact_sheet.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace app {
namespace {

constexpr std::uint8_t kGapShade = 24;
/// OpenImageIO looks for it below /usr/share/fonts; on Debian it comes with ffmpeg. Its own default is not
/// there.
constexpr const char* kFont = "DejaVuSans";
/// 1280x720 to 480x270 takes 40 ms; lanczos3, a little crisper, 230 (one thread).
constexpr const char* kFilter = "triangle";

/// Evenly spread over 0 to frames - 1, both ends included.
std::vector<int> spread(int frames, int cells) {
  const int count = std::min(frames, cells);
  std::vector<int> result;
  result.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    result.push_back(count == 1 ? 0 : static_cast<int>(std::lround(double(k) * (frames - 1) / (count - 1))));
  }
  return result;
}

OIIO::ImageSpec rgba_spec(int width, int height) { return {width, height, 4, OIIO::TypeDesc::UINT8}; }

/// Light letters with a dark outline; without a font, or without FreeType, the picture stays as it is.
void draw_caption(OIIO::ImageBuf& cell, const std::string& caption) {
  const int size = std::max(10, cell.spec().height / 16);
  const float white[4] = {1, 1, 1, 1};
  OIIO::ImageBufAlgo::render_text(cell, size / 2, cell.spec().height - size / 2, caption, size, kFont, white,
                                  OIIO::ImageBufAlgo::TextAlignX::Left,
                                  OIIO::ImageBufAlgo::TextAlignY::Bottom, std::max(1, size / 12));
  // Taking the message clears it: OpenImageIO prints those that nobody took.
  static_cast<void>(cell.geterror());
}

}  // namespace

ContactSheet::ContactSheet(int frames, int width, int height, const ContactSheetLayout& layout)
    : layout_(layout), frame_width_(width), frame_height_(height) {
  assert(frames > 0 && width > 0 && height > 0 && layout.columns > 0 && layout.rows > 0);
  frames_ = spread(frames, layout.columns * layout.rows);
  layout_.cell_width = std::min(layout.cell_width, width);
  cell_height_ = std::max(1, static_cast<int>(std::lround(double(layout_.cell_width) * height / width)));
  const int cells = static_cast<int>(frames_.size());
  const int columns = std::min(layout.columns, cells);
  const int rows = (cells + layout.columns - 1) / layout.columns;
  width_ = layout.gap + columns * (layout_.cell_width + layout.gap);
  height_ = layout.gap + rows * (cell_height_ + layout.gap);
  rgba_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 4);
  for (std::size_t i = 0; i < rgba_.size(); ++i) rgba_[i] = i % 4 == 3 ? 255 : kGapShade;
}

bool ContactSheet::wants(int frame) const {
  return std::binary_search(frames_.begin(), frames_.end(), frame);
}

void ContactSheet::add(int frame, std::span<const std::uint8_t> rgba, const std::string& caption) {
  assert(wants(frame));
  assert(rgba.size() == static_cast<std::size_t>(frame_width_) * static_cast<std::size_t>(frame_height_) * 4);
  std::vector<std::uint8_t> opaque(rgba.begin(), rgba.end());
  for (std::size_t i = 3; i < opaque.size(); i += 4) opaque[i] = 255;
  const OIIO::ImageBuf source(rgba_spec(frame_width_, frame_height_), opaque.data());
  OIIO::ImageBuf cell(rgba_spec(layout_.cell_width, cell_height_));
  OIIO::ImageBufAlgo::resize(cell, source, kFilter, 0.0f, OIIO::ROI(), 1);
  if (!caption.empty()) draw_caption(cell, caption);

  const int index =
      static_cast<int>(std::lower_bound(frames_.begin(), frames_.end(), frame) - frames_.begin());
  const int x = layout_.gap + index % layout_.columns * (layout_.cell_width + layout_.gap);
  const int y = layout_.gap + index / layout_.columns * (cell_height_ + layout_.gap);
  std::uint8_t* corner =
      rgba_.data() +
      (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)) * 4;
  cell.get_pixels(OIIO::ROI(0, layout_.cell_width, 0, cell_height_, 0, 1, 0, 4), OIIO::TypeDesc::UINT8,
                  corner, 4, static_cast<OIIO::stride_t>(width_) * 4);
}

void ContactSheet::write(const std::filesystem::path& path, bool overwrite) const {
  write_image(path, picture(), overwrite);
}

}  // namespace app
