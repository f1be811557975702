#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <set>

#include "app/view/session.h"
#include "globe/gl/window.h"

namespace app::view {

/// Has what a person does with pointer and keys act on a session.
class Hands {
 public:
  /// @param has_pointer, has_keyboard  whether widgets take what happens at a pixel, or what is typed
  Hands(Session& session, std::function<bool(glm::dvec2)> has_pointer, std::function<bool()> has_keyboard)
      : session_(session), has_pointer_(std::move(has_pointer)), has_keyboard_(std::move(has_keyboard)) {}

  void take(const globe::gl::WindowEvent& event);
  /// Moves the camera by the keys that are held.
  void drive();

 private:
  struct Click {
    glm::dvec2 at{-1e6};
    double time_s = -1e6;
  };

  void handle(const globe::gl::PointerMoved& event);
  void handle(const globe::gl::ButtonChanged& event);
  void handle(const globe::gl::Scrolled& event);
  void handle(const globe::gl::KeyChanged& event);
  void handle(const globe::gl::CharacterTyped& /*event*/) {}
  void handle(const globe::gl::PointerEntered& /*event*/) {}
  void handle(const globe::gl::FocusChanged& event);
  void press(const globe::gl::ButtonChanged& event);
  void click(const globe::gl::ButtonChanged& event);
  void strike(const globe::gl::KeyChanged& event);

  Session& session_;
  std::function<bool(glm::dvec2)> has_pointer_;
  std::function<bool()> has_keyboard_;
  std::optional<globe::gl::MouseButton> button_;  ///< that holds the picture
  Click pressed_, clicked_;
  std::set<int> held_;
  bool fast_ = false;
};

}  // namespace app::view
