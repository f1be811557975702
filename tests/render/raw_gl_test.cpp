#include "app/raw_gl.h"

#include "tests/render/gl_fixture.h"

namespace app {
namespace {

class RawGlTest : public GlTest {
 protected:
  void TearDown() override {
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDepthFunc(GL_LESS);
    glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
    GlTest::TearDown();
  }
};

/// Samples that passed the depth test, as a multiple of the screen.
double coverage(RawGl& draw) {
  GLuint query = 0;
  glGenQueries(1, &query);
  glBeginQuery(GL_SAMPLES_PASSED, query);
  draw();
  glEndQuery(GL_SAMPLES_PASSED);
  GLuint samples = 0;
  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &samples);
  glDeleteQueries(1, &query);
  return double(samples) / (double(draw.framebuffer().width()) * draw.framebuffer().height());
}

TEST_F(RawGlTest, CoversTheScreenOnceWhateverTheLoad) {
  for (const int triangles : {1, 2048, 30000, 70000, 500000}) {
    RawGl draw({.width = 320, .height = 180, .triangles_on_screen = triangles, .triangles_off_screen = 5000});
    EXPECT_EQ(coverage(draw), 1.0) << triangles;
    EXPECT_GE(draw.triangles_on_screen(), triangles);
    EXPECT_LE(draw.triangles_on_screen(), triangles * 1.2 + 2048);
    EXPECT_EQ(draw.triangles_off_screen(), 3 * 2048);
    const auto rgba = draw.framebuffer().read_rgba8();
    for (std::size_t i = 0; i < rgba.size(); i += 4) ASSERT_LT(rgba[i + 2], 100) << "sky at pixel " << i / 4;
  }
}

TEST_F(RawGlTest, DrawsTheTrianglesItSays) {
  RawGl draw({.triangles_on_screen = 70000, .triangles_off_screen = 100000});
  GLuint query = 0;
  glGenQueries(1, &query);
  glBeginQuery(GL_PRIMITIVES_GENERATED, query);
  draw();
  glEndQuery(GL_PRIMITIVES_GENERATED);
  GLuint primitives = 0;
  glGetQueryObjectuiv(query, GL_QUERY_RESULT, &primitives);
  glDeleteQueries(1, &query);
  EXPECT_EQ(primitives, static_cast<GLuint>(draw.triangles_on_screen() + draw.triangles_off_screen()));
}

TEST_F(RawGlTest, DrawsTheSameEveryTime) {
  RawGl draw({.width = 320, .height = 180});
  draw();
  const auto first = draw.framebuffer().read_rgba8();
  draw();
  EXPECT_EQ(draw.framebuffer().read_rgba8(), first);
}

}  // namespace
}  // namespace app
