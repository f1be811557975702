#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/image_file.h"

namespace app {

/// How a contact sheet is laid out.
struct ContactSheetLayout {
  int columns = 4;
  int rows = 3;
  int cell_width = 480;  ///< pixels; a cell has the frames' shape
  int gap = 6;           ///< pixels between cells and around them
};

/// A flight at a glance: frames spread evenly over it, first and last included, scaled down side by side.
class ContactSheet {
 public:
  /// @param frames         how many frames the flight has, at least 1
  /// @param width, height  size of the frames
  ContactSheet(int frames, int width, int height, const ContactSheetLayout& layout = {});

  /// Whether a frame, 0 to frames - 1, has a cell. A flight with fewer frames than cells shows each once.
  bool wants(int frame) const;

  /// Puts a frame that is wanted into its cell (RGBA, top row first, of the size given before). The caption,
  /// a few words, is drawn in its lower left corner where a font is found, else left out.
  void add(int frame, std::span<const std::uint8_t> rgba, const std::string& caption = "");

  Picture picture() const { return {width_, height_, rgba_}; }

  /// Writes what was added, as PNG. See write_image.
  void write(const std::filesystem::path& path, bool overwrite) const;

 private:
  ContactSheetLayout layout_;
  int frame_width_, frame_height_;
  int cell_height_ = 0;
  int width_ = 0, height_ = 0;
  std::vector<int> frames_;  ///< the frame of each cell
  std::vector<std::uint8_t> rgba_;
};

}  // namespace app
