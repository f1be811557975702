#pragma once

#include <glm/vec2.hpp>
#include <memory>

#include "globe/gl/window.h"

struct ImGuiContext;

namespace app::view {

/// Dear ImGui in a window. While nothing of it is shown nothing of it runs.
class Overlay {
 public:
  /// Nothing where ImGui cannot start there, which takes OpenGL by GLX or EGL and libGL.
  static std::unique_ptr<Overlay> start(const globe::gl::Window& window);
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;
  ~Overlay();

  /// Tells it what happened to the window. Keys and buttons that go down and up again between two frames are
  /// lost on it.
  void hear(const globe::gl::Window& window, const globe::gl::WindowEvent& event);

  /// Between these two calls widgets are described; end() draws them into the window.
  void begin();
  void end(const globe::gl::Window& window);

  /// Whether widgets lie at a pixel of the window, by the frame before, or hold the pointer.
  bool has_pointer(const globe::gl::Window& window, glm::dvec2 pixel) const;
  /// Whether a text is being typed.
  bool has_keyboard() const;

 private:
  Overlay() = default;

  struct Destroy {
    void operator()(ImGuiContext* context) const;
  };
  std::unique_ptr<ImGuiContext, Destroy> context_;
};

}  // namespace app::view
