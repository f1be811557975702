#pragma once

#include <glm/vec3.hpp>

namespace globe::render {

/// Where a camera will be, from where it was in the last frames: its nadir going on along a great circle by
/// the same angle a frame, its height growing or shrinking by the same factor.
///
/// Either is expected to stay what it is where the last two steps have little to do with each other: of a
/// jump, or of ground that rises and falls below, nothing is foreseen.
class Forecast {
 public:
  struct Place {
    glm::dvec3 u{0, 0, 1};  ///< unit normal
    double height_m = 1;    ///< above ground, > 0
  };

  /// The camera of the next frame.
  void note(const Place& place);

  /// Its place so many frames after the last one noted.
  Place ahead(int frames) const;

  bool is_moving() const { return turns_ || grows_; }

 private:
  Place last_;
  glm::dvec3 turn_{0.0};  ///< axis of the last step, as long as its angle
  double growth_ = 1.0;   ///< height over height before
  int noted_ = 0;
  bool turns_ = false;
  bool grows_ = false;
};

}  // namespace globe::render
