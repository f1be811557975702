#pragma once

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "globe/gl/context.h"
#include "globe/gl/program.h"

/// Makes the test program's one context when a test first asks for it, and ends it after the last test.
class GlEnvironment : public testing::Environment {
 public:
  globe::gl::Context& context() {
    if (!context_) context_ = std::make_unique<globe::gl::Context>("auto");
    context_->make_current();
    return *context_;
  }
  void TearDown() override { context_.reset(); }

 private:
  std::unique_ptr<globe::gl::Context> context_;
};

inline GlEnvironment* const gl_environment =
    static_cast<GlEnvironment*>(testing::AddGlobalTestEnvironment(new GlEnvironment));

/// For those who ask for a share of the context.
inline std::shared_ptr<globe::gl::Context> lent(globe::gl::Context& context) {
  return {&context, [](globe::gl::Context*) {}};
}

/// True when EGL offers no display of any kind: there is nothing to test on. A display without a usable
/// context is a failure, not an absence.
inline bool egl_is_absent() {
  const auto attempts = globe::gl::display_attempts("auto");
  return std::none_of(attempts.begin(), attempts.end(), [](const globe::gl::DisplayAttempt& attempt) {
    try {
      return attempt.open() != nullptr;
    } catch (const std::exception&) {
      return false;
    }
  });
}

/// Base of every test that draws: a current context, and a failure for whatever the driver complains about.
class GlTest : public testing::Test {
 protected:
  void SetUp() override {
    if (egl_is_absent()) GTEST_SKIP() << "NOTHING WAS TESTED: EGL offers no display here";
    context().clear_errors();
    // Whatever the test before left.
    for (const auto switched : {GL_DEPTH_TEST, GL_CULL_FACE, GL_BLEND, GL_POLYGON_OFFSET_LINE})
      glDisable(static_cast<GLenum>(switched));
    glDepthMask(GL_TRUE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  }
  void TearDown() override {
    if (IsSkipped()) return;
    for (const std::string& error : context().errors()) ADD_FAILURE() << "OpenGL: " << error;
  }

  static globe::gl::Context& context() { return gl_environment->context(); }
};

/// A ShaderReader over texts given in the test.
inline globe::gl::ShaderReader shaders_from(std::vector<std::pair<std::string, std::string>> files) {
  return [files = std::move(files)](const std::string& name) -> std::optional<std::string> {
    const auto found =
        std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.first == name; });
    if (found == files.end()) return std::nullopt;
    return found->second;
  };
}
