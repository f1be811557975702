#include "globe/effects/label_atlas.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

namespace globe::effects {
namespace {

constexpr int kSide = 1024;  ///< texels

}  // namespace

LabelAtlas::Text& LabelAtlas::measured(const std::string& text) {
  const auto [at, is_new] = texts_.try_emplace(text);
  if (is_new) at->second.size = glm::min(font_.size_of(text), glm::ivec2(kSide));
  return at->second;
}

glm::ivec4 LabelAtlas::place_of(const std::string& text) {
  if (texture_.width() == 0) {
    texture_ = gl::Texture::flat(GL_RG8, kSide, kSide);
    texture_.set_filter(GL_NEAREST, GL_NEAREST);
  }
  Text& it = measured(text);
  if (it.is_there) return it.place;
  if (next_.x + it.size.x > kSide) {
    next_ = {0, next_.y + row_};
    row_ = 0;
  }
  if (next_.y + it.size.y > kSide) {
    for (auto& [words, other] : texts_) other.is_there = false;
    next_ = {0, 0};
    row_ = 0;
    anew_ = true;
  }
  const TextPicture picture = font_.draw(text);
  texture_.upload({next_.x, next_.y, it.size.x, it.size.y, 0, 0}, picture.texels.data(), picture.width);
  it.place = {next_.x, next_.y, it.size.x, it.size.y};
  it.is_there = true;
  next_.x += it.size.x;
  row_ = std::max(row_, it.size.y);
  return it.place;
}

bool LabelAtlas::is_anew() { return std::exchange(anew_, false); }

}  // namespace globe::effects
