#include <cstdint>
#include <numeric>
#include <utility>

#include "globe/gl/buffer.h"
#include "globe/gl/framebuffer.h"
#include "globe/gl/sync.h"
#include "globe/gl/texture.h"
#include "globe/gl/timer_query.h"
#include "globe/gl/vertex_array.h"
#include "tests/render/gl_fixture.h"

namespace globe::gl {
namespace {

class ObjectsGlTest : public GlTest {};

const ShaderReader kEmptyProgram = shaders_from(
    {{"empty.vert", "void main() { gl_Position = vec4(0.0); }\n"}, {"empty.frag", "void main() {}\n"}});

TEST(Objects, EmptyOnesNeedNoContext) {
  Buffer buffer;
  Texture texture;
  VertexArray vertex_array;
  Framebuffer framebuffer;
  Program program;
  TimerQuery timer;
  Sync sync;
  Buffer moved = std::move(buffer);
  EXPECT_EQ(moved.id() + texture.id() + vertex_array.id() + framebuffer.id() + program.id(), 0u);
}

TEST_F(ObjectsGlTest, OwnOneNameAndDeleteIt) {
  GLuint buffer = 0, texture = 0, array = 0, framebuffer = 0, program = 0;
  {
    const Buffer a(16);
    const Texture b = Texture::flat(GL_R8, 4, 4);
    const VertexArray c = VertexArray::create();
    const Framebuffer d(4, 4);
    const Program e({{"empty.vert", "empty.frag"}, {}, {}, kEmptyProgram});
    buffer = a.id(), texture = b.id(), array = c.id(), framebuffer = d.id(), program = e.id();
    EXPECT_TRUE(glIsBuffer(buffer) && glIsTexture(texture) && glIsVertexArray(array) &&
                glIsFramebuffer(framebuffer) && glIsProgram(program));
  }
  EXPECT_FALSE(glIsBuffer(buffer) || glIsTexture(texture) || glIsVertexArray(array) ||
               glIsFramebuffer(framebuffer) || glIsProgram(program));
}

TEST_F(ObjectsGlTest, MoveHandsTheNameOver) {
  Buffer first(16);
  const GLuint id = first.id();
  Buffer second = std::move(first);
  EXPECT_EQ(second.id(), id);
  Buffer third(32);
  third = std::move(second);
  EXPECT_EQ(third.id(), id);
  EXPECT_EQ(third.size(), 16u);
  EXPECT_TRUE(glIsBuffer(id));
}

TEST_F(ObjectsGlTest, BufferReadsBackWhatWasUploaded) {
  std::vector<std::uint32_t> values(1000);
  std::iota(values.begin(), values.end(), 7u);
  Buffer buffer = Buffer::of(values);
  EXPECT_EQ(buffer.read<std::uint32_t>(0, values.size()), values);
  const std::vector<std::uint32_t> patch = {1, 2, 3};
  buffer.upload(40, std::span<const std::uint32_t>(patch));
  std::copy(patch.begin(), patch.end(), values.begin() + 10);
  EXPECT_EQ(buffer.read<std::uint32_t>(0, values.size()), values);
}

TEST_F(ObjectsGlTest, FencePassesOnceTheWorkIsDone) {
  const Buffer buffer(1024);
  const Sync sync = Sync::create();
  sync.wait();
  EXPECT_TRUE(sync.passed());
}

TEST_F(ObjectsGlTest, TimerMeasuresSomething) {
  const TimerQuery timer = TimerQuery::create();
  const Framebuffer framebuffer(512, 512);
  timer.begin();
  framebuffer.clear_color(1, 0, 0, 1);
  timer.end();
  const double waited = timer.wait_milliseconds();
  EXPECT_GE(waited, 0.0);
  EXPECT_LT(waited, 10000.0);
  EXPECT_EQ(timer.milliseconds(), waited);
}

/// Vertices of a float and an integer attribute, captured by transform feedback.
TEST_F(ObjectsGlTest, VertexArrayFeedsFloatsAndIntegers) {
  struct Vertex {
    float x, y;
    std::int32_t key;
    std::uint8_t color[4];
  };
  const std::vector<Vertex> vertices = {{0.5f, 1.5f, -7, {0, 51, 255, 0}},
                                        {2.5f, 3.5f, 1 << 30, {255, 0, 0, 102}}};
  const std::vector<std::uint32_t> indices = {1, 0};
  const Buffer vertex_buffer = Buffer::of(vertices);
  const Buffer index_buffer = Buffer::of(indices);
  VertexArray array = VertexArray::create();
  array.set_vertices(0, vertex_buffer, 0, sizeof(Vertex));
  array.set_attribute(0, {.location = 0, .components = 2, .offset = offsetof(Vertex, x)});
  array.set_attribute(
      0, {.location = 1, .type = GL_INT, .offset = offsetof(Vertex, key), .kind = Attribute::Kind::kInteger});
  array.set_attribute(0, {.location = 2,
                          .components = 4,
                          .type = GL_UNSIGNED_BYTE,
                          .offset = offsetof(Vertex, color),
                          .kind = Attribute::Kind::kNormalized});
  array.set_indices(index_buffer);

  const Program program(
      {{"capture.vert"}, {}, {"seen_position", "seen_key", "seen_color"}, shaders_from({{"capture.vert", R"(
layout(location = 0) in vec2 position;
layout(location = 1) in int key;
layout(location = 2) in vec4 color;
out vec2 seen_position;
flat out int seen_key;
out vec4 seen_color;
void main() {
  seen_position = position;
  seen_key = key;
  seen_color = color;
  gl_Position = vec4(0.0);
}
)"}})});
  struct Seen {
    float x, y;
    std::int32_t key;
    float color[4];
  };
  const Buffer captured(2 * sizeof(Seen));
  const Framebuffer framebuffer(1, 1);  // without one, drawing is an error even when nothing is rasterised
  framebuffer.bind();
  captured.bind_base(GL_TRANSFORM_FEEDBACK_BUFFER, 0);
  program.use();
  array.bind();
  glEnable(GL_RASTERIZER_DISCARD);
  glBeginTransformFeedback(GL_POINTS);
  glDrawElements(GL_POINTS, 2, GL_UNSIGNED_INT, nullptr);
  glEndTransformFeedback();
  glDisable(GL_RASTERIZER_DISCARD);
  const auto seen = captured.read<Seen>(0, 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const Vertex& vertex = vertices[indices[i]];
    EXPECT_EQ(seen[i].x, vertex.x);
    EXPECT_EQ(seen[i].y, vertex.y);
    EXPECT_EQ(seen[i].key, vertex.key);
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_FLOAT_EQ(seen[i].color[c], static_cast<float>(vertex.color[c]) / 255);
  }
}

}  // namespace
}  // namespace globe::gl
