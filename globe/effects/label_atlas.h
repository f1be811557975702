#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <string>
#include <utility>

#include "globe/effects/label_font.h"
#include "globe/gl/texture.h"

namespace globe::effects {

/// Pictures of texts on the GPU, made as they are first asked for.
class LabelAtlas {
 public:
  explicit LabelAtlas(LabelFont font) : font_(std::move(font)) {}

  /// Width and height of a text's picture, pixels.
  glm::ivec2 size_of(const std::string& text) { return measured(text).size; }
  /// Where it lies in texture(): x, y, width, height in texels, its top row first. A full texture forgets all
  /// texts: what was said before holds no more where is_anew() tells so.
  glm::ivec4 place_of(const std::string& text);
  /// Whether the texture was emptied since it was asked last.
  bool is_anew();

  /// Channels as in TextPicture.
  const gl::Texture& texture() const { return texture_; }
  std::size_t bytes() const { return texture_.width() == 0 ? 0 : texture_.bytes(); }

 private:
  struct Text {
    glm::ivec2 size{0};
    glm::ivec4 place{0};
    bool is_there = false;  ///< in the texture
  };
  Text& measured(const std::string& text);

  LabelFont font_;
  std::map<std::string, Text> texts_;
  gl::Texture texture_;
  glm::ivec2 next_{0};  ///< where the next text goes
  int row_ = 0;         ///< height of the row it goes to
  bool anew_ = false;
};

}  // namespace globe::effects
