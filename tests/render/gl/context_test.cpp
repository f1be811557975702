#include "globe/gl/context.h"

#include <stdexcept>

#include "globe/base/error.h"
#include "tests/render/gl_fixture.h"

namespace globe::gl {
namespace {

class ContextGlTest : public GlTest {};

std::string message_of(const std::vector<DisplayAttempt>& attempts) {
  try {
    Context context(attempts);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

DisplayAttempt refusing(const std::string& name, const std::string& why) {
  return {name, [why]() -> void* { throw std::runtime_error(why); }};
}

TEST_F(ContextGlTest, IsCore45AndNamesItself) {
  GLint major = 0, minor = 0, profile = 0, flags = 0;
  glGetIntegerv(GL_MAJOR_VERSION, &major);
  glGetIntegerv(GL_MINOR_VERSION, &minor);
  glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
  glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
  EXPECT_GE(major * 10 + minor, 45);
  EXPECT_TRUE(profile & GL_CONTEXT_CORE_PROFILE_BIT);
  EXPECT_TRUE(flags & GL_CONTEXT_FLAG_DEBUG_BIT);
  EXPECT_FALSE(context().renderer().empty());
  EXPECT_FALSE(context().version().empty());
  EXPECT_FALSE(context().is_lost());
}

TEST_F(ContextGlTest, CollectsErrors) {
  glEnable(GL_TRIANGLES);
  ASSERT_EQ(context().errors().size(), 1u);
  EXPECT_NE(context().errors()[0].find("GL_INVALID_ENUM"), std::string::npos) << context().errors()[0];
  context().clear_errors();
  while (glGetError() != GL_NO_ERROR) {
  }
}

TEST_F(ContextGlTest, SurvivesMoveWithItsErrorLog) {
  Context first("auto");
  Context second = std::move(first);
  second.make_current();
  glEnable(GL_TRIANGLES);
  EXPECT_EQ(second.errors().size(), 1u);
  EXPECT_TRUE(context().errors().empty());
}

TEST_F(ContextGlTest, TwoLiveSideBySide) {
  { Context other("auto"); }
  EXPECT_NE(context().renderer(), "");
  GLint units = 0;
  glGetIntegerv(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS, &units);
  EXPECT_GT(units, 0);
}

TEST_F(ContextGlTest, SoftwareDrawsOnTheCpu) {
  try {
    EXPECT_TRUE(Context("software").is_software());
  } catch (const Error& error) {
    GTEST_SKIP() << error.what();
  }
}

TEST_F(ContextGlTest, FallsThroughEveryLinkAndNamesTheRefusals) {
  const auto real = display_attempts("auto");
  std::vector<DisplayAttempt> attempts;
  for (const DisplayAttempt& attempt : real) {
    // The links before the last working one are cut one after the other.
    attempts.push_back(refusing("cut " + attempt.name, "wire " + std::to_string(attempts.size())));
    std::vector<DisplayAttempt> chain = attempts;
    chain.insert(chain.end(), real.begin(), real.end());
    const Context context(chain);
    ASSERT_GE(context.refusals().size(), attempts.size());
    for (std::size_t i = 0; i < attempts.size(); ++i) {
      EXPECT_EQ(context.refusals()[i], attempts[i].name + ": wire " + std::to_string(i));
    }
  }
}

TEST_F(ContextGlTest, EachWayOfItsOwnEitherWorksOrSaysWhy) {
  for (const DisplayAttempt& attempt : display_attempts("auto")) {
    try {
      const Context context(std::vector<DisplayAttempt>{attempt});
      EXPECT_EQ(context.display_name(), attempt.name);
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(attempt.name), std::string::npos) << error.what();
    }
  }
}

TEST(Context, NamesEveryRefusalWhenAllFail) {
  const std::string message =
      message_of({refusing("first way", "no such card"), {"second way", []() -> void* { return nullptr; }}});
  EXPECT_NE(message.find("first way: no such card"), std::string::npos) << message;
  EXPECT_NE(message.find("second way: no display"), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

TEST(Context, RefusesUnknownDevices) {
  EXPECT_THROW(display_attempts("gpu"), UsageError);
  EXPECT_THROW(display_attempts("1x"), UsageError);
  EXPECT_THROW(display_attempts(""), UsageError);
  EXPECT_THROW(display_attempts("1000"), Error);
}

TEST(Context, KnowsSoftwareRenderersByName) {
  EXPECT_TRUE(is_software_renderer("llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_TRUE(is_software_renderer("ANGLE (Google, Vulkan 1.3.0 (SwiftShader Device))"));
  EXPECT_FALSE(is_software_renderer("NVIDIA H200/PCIe/SSE2"));
}

}  // namespace
}  // namespace globe::gl
