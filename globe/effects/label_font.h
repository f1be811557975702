#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <vector>

namespace globe::effects {

/// A text as a picture of bytes, its top row first: two channels, the letters, and letters and halo.
struct TextPicture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> texels;
};

/// DejaVu Sans as Debian's fonts-dejavu-core has it.
inline constexpr const char* kUsualFont = "/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf";

/// A font at a size, drawn by FreeType. Texts are UTF-8, from left to right; what the font lacks is an empty
/// box, what is no UTF-8 a question mark.
class LabelFont {
 public:
  /// Throws Error when the file is no font.
  /// @param size_px  of letters  @param halo_px  around them
  LabelFont(const std::filesystem::path& file, double size_px, double halo_px);
  LabelFont(LabelFont&& other) noexcept;
  ~LabelFont();

  /// Width and height of a text's picture, pixels.
  glm::ivec2 size_of(const std::string& text) const;
  TextPicture draw(const std::string& text) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace globe::effects
