#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "globe/gl/debug_log.h"

struct GLFWwindow;

namespace globe::gl {

struct Modifiers {
  bool shift = false, control = false, alt = false;
};

enum class MouseButton { kLeft, kRight, kMiddle };

/// What happened to a window. Places are in pixels of its picture from the left and the top, times in seconds
/// of one clock.
struct PointerMoved {
  glm::dvec2 at{0.0};
  double time_s = 0;
};
struct ButtonChanged {
  MouseButton button = MouseButton::kLeft;
  bool down = false;
  Modifiers modifiers;
  glm::dvec2 at{0.0};
  double time_s = 0;
};
/// Of a wheel or two fingers; up and left are positive, notches of a wheel 1.
struct Scrolled {
  glm::dvec2 by{0.0};
  Modifiers modifiers;
  glm::dvec2 at{0.0};
};
/// A key by its place, as GLFW numbers it (GLFW_KEY_A is 65).
struct KeyChanged {
  int key = 0;
  int scancode = 0;
  bool down = false;
  bool repeated = false;
  Modifiers modifiers;
};
/// A character that was typed, of Unicode.
struct CharacterTyped {
  unsigned code = 0;
};
struct PointerEntered {
  bool inside = false;
};
/// Without focus, keys that were down are to be taken as released.
struct FocusChanged {
  bool focused = false;
};
using WindowEvent = std::variant<PointerMoved, ButtonChanged, Scrolled, KeyChanged, CharacterTyped,
                                 PointerEntered, FocusChanged>;

/// A window on the screen with an OpenGL 4.5 core context (GLFW), current on the thread that made it.
///
/// It is a debug context without depth or samples of its own: draw into a Framebuffer and show() that. One
/// window at a time. Destroy it after every object made in its context.
class Window {
 public:
  /// Throws Error where there is no screen, or none that OpenGL 4.5 draws on.
  Window(const std::string& title, int width, int height);
  Window(const Window&) = delete;
  Window& operator=(const Window&) = delete;
  ~Window();

  /// Lets the system deliver what happened; `seconds`: waits for something to happen, so long at most.
  void poll();
  void wait(double seconds);
  /// What happened since the last call, in its order.
  std::vector<WindowEvent> take_events();

  /// Pixels of its picture; 0 x 0 while it is minimised.
  glm::ivec2 size() const;
  /// How much larger than usual the screen shows text: 2 on many small screens with many pixels.
  float content_scale() const;

  bool close_requested() const;
  void request_close();

  bool is_full_screen() const { return windowed_.has_size; }
  void set_full_screen(bool on);
  void set_title(const std::string& title);
  void set_clipboard(const std::string& text);

  /// Copies a finished picture into the window (glBlitNamedFramebuffer).
  /// @param framebuffer  of one sample; its upper left corner comes to the window's
  void show(unsigned framebuffer, glm::ivec2 size) const;
  /// Brings what was drawn to the screen, at its pace where it has one.
  void swap();

  const std::string& renderer() const { return renderer_; }
  const std::string& version() const { return version_; }
  bool is_software() const;
  /// The driver's complaints so far (see DebugLog).
  const std::vector<std::string>& errors() const { return log_->messages(); }

  GLFWwindow* handle() const { return window_.get(); }

 private:
  struct Library {
    Library();
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;
    ~Library();
  };
  struct Destroy {
    void operator()(GLFWwindow* window) const;
  };
  struct Windowed {
    bool has_size = false;
    int x = 0, y = 0, width = 0, height = 0;
  };

  static std::unique_ptr<GLFWwindow, Destroy> open(const std::string& title, int width, int height);
  void listen();
  glm::dvec2 pixel_at(glm::dvec2 place) const;

  std::unique_ptr<Library> library_;
  std::unique_ptr<GLFWwindow, Destroy> window_;
  std::unique_ptr<DebugLog> log_;
  std::string renderer_, version_;
  std::vector<WindowEvent> events_;
  glm::dvec2 pointer_{0.0};  ///< at the event delivered last: GLFW tells where it is by now
  Windowed windowed_;        ///< where it goes back to from full screen
};

}  // namespace globe::gl
