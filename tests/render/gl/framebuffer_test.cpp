#include "globe/gl/framebuffer.h"

#include <array>
#include <cmath>

#include "globe/base/error.h"
#include "globe/gl/buffer.h"
#include "globe/gl/vertex_array.h"
#include "tests/hard/table.h"
#include "tests/render/gl_fixture.h"

namespace globe::gl {
namespace {

class FramebufferGlTest : public GlTest {
 protected:
  void TearDown() override {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_SCISSOR_TEST);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    glDepthFunc(GL_LESS);
    GlTest::TearDown();
  }
};

const ShaderReader kPlain = shaders_from({{"plain.vert", R"(
layout(location = 0) in vec4 position;
void main() { gl_Position = position; }
)"},
                                          {"plain.frag", R"(
uniform vec4 color;
out vec4 fragment;
void main() { fragment = color; }
)"}});

class Plain {
 public:
  Plain() : program_({{"plain.vert", "plain.frag"}, {}, {}, kPlain}), array_(VertexArray::create()) {
    array_.set_attribute(0, {.location = 0, .components = 4});
  }

  /// A triangle strip of clip-space positions.
  void draw(const std::vector<glm::vec4>& positions, const glm::vec4& color) {
    const Buffer buffer = Buffer::of(positions);
    array_.set_vertices(0, buffer, 0, sizeof(glm::vec4));
    array_.bind();
    program_.use();
    program_.set(program_.uniform("color"), color);
    glDrawArrays(GL_TRIANGLE_STRIP, 0, static_cast<GLsizei>(positions.size()));
    glFinish();
  }

 private:
  Program program_;
  VertexArray array_;
};

TEST_F(FramebufferGlTest, ReadsBackTheClearColourAndDepth) {
  const Framebuffer framebuffer(6, 4);
  framebuffer.clear_color(1.0f, 0.2f, 0.0f, 1.0f);
  framebuffer.clear_depth(0.125f);
  const auto rgba = framebuffer.read_rgba8();
  ASSERT_EQ(rgba.size(), 6u * 4 * 4);
  for (std::size_t i = 0; i < rgba.size(); i += 4) {
    ASSERT_EQ(rgba[i], 255);
    ASSERT_EQ(rgba[i + 1], 51);
    ASSERT_EQ(rgba[i + 2], 0);
    ASSERT_EQ(rgba[i + 3], 255);
  }
  EXPECT_EQ(framebuffer.read_depth(), std::vector<float>(24, 0.125f));
}

TEST_F(FramebufferGlTest, RowsComeTopFirst) {
  const Framebuffer framebuffer(2, 3);
  framebuffer.clear_color(0, 0, 0, 0);
  framebuffer.clear_depth(0);
  framebuffer.bind();
  glEnable(GL_SCISSOR_TEST);
  glScissor(0, 2, 2, 1);  // GL counts from the bottom: the top row
  framebuffer.clear_color(1, 1, 1, 1);
  framebuffer.clear_depth(1);
  glDisable(GL_SCISSOR_TEST);
  const auto rgba = framebuffer.read_rgba8();
  EXPECT_EQ(rgba[0], 255);
  EXPECT_EQ(rgba[8], 0);
  EXPECT_EQ(rgba[16], 0);
  EXPECT_EQ(framebuffer.read_depth(), (std::vector<float>{1, 1, 0, 0, 0, 0}));
}

TEST_F(FramebufferGlTest, FloatColourKeepsItsRange) {
  const Framebuffer framebuffer(3, 3, {.color = GL_RGBA32F});
  framebuffer.clear_color(1000.5f, -2.0f, 0.0f, 1.0f);
  const auto rgba = framebuffer.read_rgba_float();
  EXPECT_EQ(rgba[0], 1000.5f);
  EXPECT_EQ(rgba[1], -2.0f);
}

TEST_F(FramebufferGlTest, TheMiddleOfAPixelIsAtOneHalf) {
  const Framebuffer framebuffer(4, 4);
  framebuffer.clear_color(0, 0, 0, 1);
  framebuffer.bind();
  Plain plain;
  // Left edge at x = 1.5 pixels: pixel 1, whose middle lies on it, is in by the top-left rule; 0 is out.
  const float left = 1.5f / 2.0f - 1.0f;
  plain.draw({{left, -1, 0, 1}, {1, -1, 0, 1}, {left, 1, 0, 1}, {1, 1, 0, 1}}, {1, 1, 1, 1});
  const auto rgba = framebuffer.read_rgba8();
  EXPECT_EQ(rgba[0], 0);
  EXPECT_EQ(rgba[4], 255);
  EXPECT_EQ(rgba[8], 255);
}

TEST_F(FramebufferGlTest, FourSamplesSmoothAnEdge) {
  Plain plain;
  for (const int samples : {1, 4}) {
    const Framebuffer framebuffer(32, 32, {.samples = samples});
    framebuffer.clear_color(0, 0, 0, 1);
    framebuffer.clear_depth(1);
    framebuffer.bind();
    plain.draw({{-1, -1, 0, 1}, {1, -1, 0, 1}, {-1, 0.9f, 0, 1}}, {1, 1, 1, 1});
    const auto rgba = framebuffer.read_rgba8();
    int between = 0, white = 0;
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
      between += rgba[i] > 0 && rgba[i] < 255;
      white += rgba[i] == 255;
    }
    EXPECT_GT(white, 400) << samples;
    EXPECT_EQ(between > 20, samples == 4) << between;
    EXPECT_EQ(framebuffer.read_depth()[0], 1.0f);
  }
}

TEST_F(FramebufferGlTest, ImpossibleSizesAreRefusedInWords) {
  EXPECT_THROW(Framebuffer(0, 10), Error);
  EXPECT_THROW(Framebuffer(1 << 20, 10), Error);
}

/// H4: two planes tilted by 20 degrees, the farther one the nearer one scaled about the eye by 1 + 1e-6.
class DepthOrder {
 public:
  static constexpr double kNear = 0.05;
  static constexpr double kSeparation = 1e-6;
  static constexpr int kSize = 256;

  explicit DepthOrder(GLenum depth_format) : framebuffer_(kSize, kSize, {.depth = depth_format}) {}

  /// Pixels that do not show the nearer plane, over both draw orders.
  int wrong_pixels(double z) {
    return wrong_pixels(z, {z, z * (1.0 + kSeparation)}) + wrong_pixels(z, {z * (1.0 + kSeparation), z});
  }

 private:
  /// Corners of a plane through (0, 0, -z), seen in a field of 90 degrees; reversed depth, far plane at
  /// infinity.
  static std::vector<glm::vec4> plane(double z) {
    const double slope = std::tan(20.0 * 3.14159265358979 / 180.0);
    std::vector<glm::vec4> corners;
    for (const auto [x, y] : {std::array{-0.9, -0.9}, {0.9, -0.9}, {-0.9, 0.9}, {0.9, 0.9}}) {
      const double w = z / (1.0 - slope * (0.7 * x + 0.3 * y));
      corners.emplace_back(static_cast<float>(x * w), static_cast<float>(y * w), static_cast<float>(kNear),
                           static_cast<float>(w));
    }
    return corners;
  }

  int wrong_pixels(double nearest, const std::array<double, 2>& order) {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    framebuffer_.clear_color(0, 0, 0, 1);
    framebuffer_.clear_depth(0);
    framebuffer_.bind();
    for (const double z : order) {
      plain_.draw(plane(z), z == nearest ? glm::vec4(1, 0, 0, 1) : glm::vec4(0, 0, 1, 1));
    }
    const auto rgba = framebuffer_.read_rgba8();
    // Every pixel inside the planes' outline (0.9 of the half-size) must show the nearer one.
    constexpr int kMargin = kSize / 16;
    int wrong = 0;
    for (int y = kMargin; y < kSize - kMargin; ++y) {
      for (int x = kMargin; x < kSize - kMargin; ++x) {
        const auto at = static_cast<std::size_t>(y * kSize + x) * 4;
        wrong += rgba[at] != 255 || rgba[at + 2] != 0;
      }
    }
    return wrong;
  }

  Framebuffer framebuffer_;
  Plain plain_;
};

TEST_F(FramebufferGlTest, H4ReversedFloatDepthTellsAPartInAMillionApart) {
  DepthOrder float_depth(GL_DEPTH_COMPONENT32F);
  DepthOrder fixed_depth(GL_DEPTH_COMPONENT24);
  int wrong = 0, control = 0;
  for (const double z : {1.0, 1e2, 1e4, 1e6, 4e7}) {
    wrong += float_depth.wrong_pixels(z);
    control += fixed_depth.wrong_pixels(z);
  }
  hard::report("H4", "wrong pixels, planes 1e-6 apart at 1 m to 4e7 m, reversed D32F, both orders", "0",
               std::to_string(wrong));
  hard::report("H4", "the same on 24-bit fixed depth (control: must fail)", "> 0", std::to_string(control));
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(control, 0);
}

}  // namespace
}  // namespace globe::gl
