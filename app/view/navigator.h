#pragma once

#include <deque>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "app/view/eye.h"
#include "app/view/glide.h"

namespace app::view {

/// What a person's hands do with the camera of a window, moment by moment: no window and no OpenGL in it.
///
/// A drag keeps the place that was grabbed under the pointer, and lets the planet roll on when it is let go;
/// the wheel comes nearer to the place under the pointer; a turning drag swings around the place in the
/// middle; what begins over the sky looks around. Keys fly at a speed that goes with the height above ground.
/// It never comes nearer to the ground than least_clearance.
class Navigator {
 public:
  /// What is known of the world.
  struct World {
    /// The place that is seen at a pixel in the picture drawn last, ECEF; nothing: sky.
    std::function<std::optional<glm::dvec3>(glm::dvec2 pixel)> seen_at;
    /// Of a position in ECEF over the ground at hand, metres.
    std::function<double(const glm::dvec3&)> height_above_ground;
  };

  Navigator(const Eye& eye, World world, const Standpoint& start);

  const Eye& eye() const { return eye_; }
  void resize(glm::dvec2 size) { eye_.size = size; }

  const Standpoint& stand() const { return stand_; }
  globe::render::Camera camera() const { return eye_.camera(stand_); }
  /// Puts it somewhere at once.
  void jump_to(const Standpoint& stand);
  /// Raises it to least_clearance by heights above ground that are better than those at hand.
  void keep_clear_of(const std::function<double(const glm::dvec3&)>& height_above_ground);
  /// Flies there; `to` is as it will stand.
  void fly_to(const Standpoint& to);
  /// Flies to where a place lies in the middle of the picture, so many metres off, seen from above by
  /// `pitch_deg`.
  void look_at(const glm::dvec3& place, double distance_m, double heading_deg, double pitch_deg);

  enum class Grip { kGrab, kSwing, kLook };
  void press(Grip grip, glm::dvec2 pixel, double time_s);
  void move(glm::dvec2 pixel, double time_s);
  void release(double time_s);
  bool is_held() const { return held_.has_value(); }
  /// Nearer by so many notches of a wheel, toward what is at the pixel.
  void zoom(double notches, glm::dvec2 pixel);
  /// Flies to three quarters of the way to what is at the pixel.
  void double_click(glm::dvec2 pixel);

  /// Keys that are held, each -1 to 1: forward, right and up in heights above ground to a second; to the
  /// right and up in degrees to a second, times kTurn.
  struct Drive {
    glm::dvec3 go{0.0};
    glm::dvec2 turn{0.0};
    bool is_idle() const { return go == glm::dvec3(0.0) && turn == glm::dvec2(0.0); }
  };
  void drive(const Drive& drive);

  /// Lets time pass. @return whether it moved, or goes on moving
  bool advance(double seconds);
  bool is_moving() const;

  static constexpr double kTurn = 45.0;

 private:
  struct Held {
    Grip grip;
    std::optional<glm::dvec3> place;
    glm::dvec2 pixel;
  };
  struct Push {
    double time_s;
    glm::dvec3 turn;
  };
  struct Zooming {
    double notches = 0;
    glm::dvec2 pixel{0.0};
    glm::dvec3 place{0.0};
  };

  void stop();
  void keep_clear();
  double above() const;
  glm::dvec3 place_at(glm::dvec2 pixel) const;
  void hold(const Held& held, glm::dvec2 pixel, double time_s);
  void roll(double seconds);
  void zoom_by(double notches);
  void go(double seconds);

  Eye eye_;
  World world_;
  Standpoint stand_;
  std::optional<Held> held_;
  std::deque<Push> pushes_;  ///< of the drag, the last ones
  glm::dvec3 rolling_{0.0};  ///< radians a second
  Zooming zooming_;
  Drive drive_;
  std::optional<Glide> glide_;
  double glided_s_ = 0;
};

}  // namespace app::view
