#include "app/view/hands.h"

#include <GLFW/glfw3.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace app::view {
namespace {

namespace gl = globe::gl;
using Grip = Navigator::Grip;

constexpr double kClickReach = 4.0;        ///< pixels that a click may stray
constexpr double kDoubleClickTime = 0.4;   ///< seconds
constexpr double kDoubleClickReach = 8.0;  ///< pixels
constexpr double kFast = 5.0;
constexpr double kWholeGlobe = 2.4;  ///< radii above the ground from which all of it is seen

Grip grip_of(const gl::ButtonChanged& event) {
  if (event.button == gl::MouseButton::kMiddle) return Grip::kLook;
  const bool swings = event.button == gl::MouseButton::kRight || event.modifiers.shift;
  return event.modifiers.control ? Grip::kLook : swings ? Grip::kSwing : Grip::kGrab;
}

}  // namespace

void Hands::take(const gl::WindowEvent& event) {
  std::visit([&](const auto& happened) { handle(happened); }, event);
}

void Hands::handle(const gl::PointerMoved& event) {
  session_.pointer = event.at;
  if (!button_) return;
  session_.on_path = false;
  session_.navigator.move(event.at, event.time_s);
}

void Hands::handle(const gl::ButtonChanged& event) {
  session_.pointer = event.at;
  if (event.down) {
    if (!button_ && !has_pointer_(event.at)) press(event);
    return;
  }
  if (button_ != event.button) return;
  button_.reset();
  session_.navigator.release(event.time_s);
  if (event.button == gl::MouseButton::kLeft && glm::distance(event.at, pressed_.at) < kClickReach)
    click(event);
}

void Hands::press(const gl::ButtonChanged& event) {
  button_ = event.button;
  pressed_ = {event.at, event.time_s};
  session_.on_path = false;
  session_.navigator.press(grip_of(event), event.at, event.time_s);
}

void Hands::click(const gl::ButtonChanged& event) {
  const bool again = event.time_s - clicked_.time_s < kDoubleClickTime &&
                     glm::distance(event.at, clicked_.at) < kDoubleClickReach;
  clicked_ = again ? Click{} : Click{event.at, event.time_s};
  if (session_.measure.is_on()) {
    if (const auto place = session_.canvas.seen_at(event.at)) {
      session_.measure.add(session_.geodetic_of(*place), [&](double lat_deg, double lon_deg) {
        return session_.scenery.ground_m(lat_deg, lon_deg);
      });
    }
  } else if (again) {
    session_.navigator.double_click(event.at);
  }
}

void Hands::handle(const gl::Scrolled& event) {
  if (has_pointer_(event.at)) return;
  session_.on_path = false;
  session_.navigator.zoom(event.by.y, event.at);
}

void Hands::handle(const gl::KeyChanged& event) {
  fast_ = event.modifiers.shift;
  if (!event.down) {
    held_.erase(event.key);
    return;
  }
  if (has_keyboard_() && !event.modifiers.control) return;
  if (!event.repeated && !event.modifiers.control) held_.insert(event.key);
  if (!event.repeated) strike(event);
}

void Hands::handle(const gl::FocusChanged& /*event*/) {
  held_.clear();
  fast_ = false;
}

void Hands::strike(const gl::KeyChanged& event) {
  Navigator& navigator = session_.navigator;
  const Standpoint& stand = navigator.stand();
  const auto turn_to = [&](double heading_deg, double pitch_deg) {
    session_.on_path = false;
    const auto middle = session_.canvas.seen_at(0.5 * navigator.eye().size);
    if (middle) {
      navigator.look_at(*middle, glm::distance(*middle, navigator.camera().position), heading_deg, pitch_deg);
    } else {
      navigator.fly_to({stand.place, {heading_deg, pitch_deg, 0.0}});
    }
  };
  if (event.modifiers.control) {
    if (event.key == GLFW_KEY_Q || event.key == GLFW_KEY_W) session_.closes = true;
    if (event.key == GLFW_KEY_F) {
      session_.shows_overlay = true;
      session_.search.wants_keyboard = true;
    }
    return;
  }
  switch (event.key) {
    case GLFW_KEY_TAB:
    case GLFW_KEY_F1:
      session_.shows_overlay = !session_.shows_overlay;
      break;
    case GLFW_KEY_F11:
      session_.window.set_full_screen(!session_.window.is_full_screen());
      break;
    case GLFW_KEY_ESCAPE:
      session_.window.set_full_screen(false);
      break;
    case GLFW_KEY_N:
      turn_to(0.0, stand.look.pitch_deg);
      break;
    case GLFW_KEY_U:
      turn_to(stand.look.heading_deg, -90.0);
      break;
    case GLFW_KEY_HOME: {
      globe::geo::Geodetic place = stand.place;
      place.h_m = kWholeGlobe * session_.scenery.ellipsoid().mean_radius();
      session_.on_path = false;
      navigator.fly_to({place, {0.0, -90.0, 0.0}});
      break;
    }
    case GLFW_KEY_SPACE:
      session_.running = !session_.running;
      if (session_.running && session_.flight) {
        if (session_.moment_s >= session_.flight->duration_s()) session_.moment_s = 0.0;
        session_.on_path = true;
      }
      break;
    case GLFW_KEY_P:
    case GLFW_KEY_F12:
      session_.save_picture();
      break;
    case GLFW_KEY_V:
      session_.toggle_recording();
      break;
    case GLFW_KEY_C:
      session_.window.set_clipboard(session_.shot_line("picture.png"));
      session_.tell("the command is copied");
      break;
    case GLFW_KEY_M:
      session_.measure.set_on(!session_.measure.is_on());
      break;
    default:
      break;
  }
}

void Hands::drive() {
  const auto axis = [&](int positive, int negative) {
    return static_cast<double>(held_.count(positive)) - static_cast<double>(held_.count(negative));
  };
  Navigator::Drive drive;
  const double pace = fast_ ? kFast : 1.0;
  drive.go = pace * glm::dvec3(axis(GLFW_KEY_W, GLFW_KEY_S), axis(GLFW_KEY_D, GLFW_KEY_A),
                               axis(GLFW_KEY_R, GLFW_KEY_F));
  drive.turn = {axis(GLFW_KEY_RIGHT, GLFW_KEY_LEFT), axis(GLFW_KEY_UP, GLFW_KEY_DOWN)};
  if (!drive.is_idle()) session_.on_path = false;
  session_.navigator.drive(drive);
}

}  // namespace app::view
