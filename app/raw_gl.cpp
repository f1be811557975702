#include "app/raw_gl.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <string>

namespace app {
namespace {

using globe::gl::Buffer;
using globe::gl::Texture;

constexpr int kCells = 32;
constexpr int kNodes = kCells + 1;
constexpr int kTrianglesPerBlock = 2 * kCells * kCells;
constexpr int kColorSide = 1024;

int blocks_for(int triangles) { return (triangles + kTrianglesPerBlock - 1) / kTrianglesPerBlock; }

/// Columns and rows of at least so many blocks, each about square on the screen.
glm::ivec2 arrangement(const RawGlLoad& load) {
  const int count = std::max(1, blocks_for(load.triangles_on_screen));
  const double shape = double(load.height) / load.width;
  const int rows = std::clamp(static_cast<int>(std::lround(std::sqrt(count * shape))), 1, count);
  return {(count + rows - 1) / rows, rows};
}

/// The field is [-1, 1]² at height 0, seen from (0, 0, 1) straight down and filling the screen with a margin
/// of 2 % for the heights' parallax. Reversed depth, far plane at infinity.
glm::mat4 clip_from_field() {
  constexpr float kMargin = 1.02f;
  constexpr float kNear = 0.1f;
  glm::mat4 matrix(0.0f);
  matrix[0][0] = kMargin;
  matrix[1][1] = kMargin;
  matrix[3][2] = kNear;
  matrix[2][3] = -1.0f;
  matrix[3][3] = 1.0f;
  return matrix;
}

/// Hills a few cells wide, low enough to hide nothing behind them.
std::vector<float> hills(int width, int height) {
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const float amplitude = std::min(0.01f, 1.0f / static_cast<float>(width));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      values.push_back(amplitude * std::sin(0.6f * static_cast<float>(x)) *
                       std::cos(0.4f * static_cast<float>(y)));
    }
  }
  return values;
}

/// Spots of green and brown.
std::vector<std::uint8_t> ground_colors() {
  std::vector<std::uint8_t> rgba;
  rgba.reserve(std::size_t{kColorSide} * kColorSide * 4);
  for (std::uint32_t i = 0; i < std::uint32_t{kColorSide} * kColorSide; ++i) {
    const std::uint32_t hash = (i * 2654435761u) >> 24;
    rgba.insert(rgba.end(), {static_cast<std::uint8_t>(80 + hash / 4),
                             static_cast<std::uint8_t>(110 + hash / 8), static_cast<std::uint8_t>(60), 255});
  }
  return rgba;
}

std::vector<std::uint16_t> block_indices() {
  std::vector<std::uint16_t> indices;
  for (int y = 0; y < kCells; ++y) {
    for (int x = 0; x < kCells; ++x) {
      const int corner = y * kNodes + x;
      for (const int node :
           {corner, corner + 1, corner + kNodes, corner + 1, corner + kNodes + 1, corner + kNodes}) {
        indices.push_back(static_cast<std::uint16_t>(node));
      }
    }
  }
  return indices;
}

}  // namespace

RawGl::RawGl(const RawGlLoad& load)
    : blocks_(arrangement(load)),
      blocks_off_screen_(blocks_for(load.triangles_off_screen)),
      framebuffer_(load.width, load.height),
      program_(
          {{"bench/raw_gl.vert", "bench/raw_gl.frag"}, {"NODES_PER_SIDE " + std::to_string(kNodes)}, {}}) {
  make_field();
  make_mesh();
  program_.set(program_.uniform("clip_from_field"), clip_from_field());
  program_.set(program_.uniform("field_cells"), glm::vec2(blocks_ * kCells));
}

void RawGl::make_field() {
  const glm::ivec2 nodes = blocks_ * kCells + 1;
  heights_ = Texture::flat(GL_R32F, nodes.x, nodes.y);
  heights_.upload({0, 0, nodes.x, nodes.y}, hills(nodes.x, nodes.y).data());
  colors_ = Texture::flat(GL_RGBA8, kColorSide, kColorSide);
  colors_.upload({0, 0, kColorSide, kColorSide}, ground_colors().data());
  colors_.set_filter(GL_LINEAR, GL_LINEAR);
}

void RawGl::make_mesh() {
  indices_ = Buffer::of(block_indices());
  mesh_ = globe::gl::VertexArray::create();
  mesh_.set_indices(indices_);
  const int count = blocks_.x * blocks_.y;
  for (int i = 0; i < count + blocks_off_screen_; ++i) {
    const glm::ivec2 first = glm::ivec2(i % count % blocks_.x, i % count / blocks_.x) * kCells;
    // The extra blocks stand in columns to the right of the screen, one screen away.
    const int away = i < count ? 0 : 2 * blocks_.x * kCells;
    draws_.emplace_back(first.x, first.y, first.x + away, first.y);
  }
}

void RawGl::operator()() {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glEnable(GL_CULL_FACE);
  framebuffer_.bind();
  framebuffer_.clear_color(0.53f, 0.71f, 0.91f, 1.0f);
  framebuffer_.clear_depth(0.0f);
  program_.use();
  mesh_.bind();
  heights_.bind(0);
  colors_.bind(1);
  const GLint block = program_.uniform("block");
  for (const glm::ivec4& draw : draws_) {
    program_.set(block, draw);
    glDrawElements(GL_TRIANGLES, kCells * kCells * 6, GL_UNSIGNED_SHORT, nullptr);
  }
  glFinish();
}

int RawGl::triangles_on_screen() const { return blocks_.x * blocks_.y * kTrianglesPerBlock; }
int RawGl::triangles_off_screen() const { return blocks_off_screen_ * kTrianglesPerBlock; }

}  // namespace app
