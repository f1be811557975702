#pragma once

#include <optional>

#include "globe/gl/name.h"

namespace globe::gl {

/// GPU time between begin() and end(), which may overlap others'. (glQueryCounter)
///
/// Two time stamps rather than GL_TIME_ELAPSED: llvmpipe 22.3 never takes the starting time of that when it
/// begins before a framebuffer was ever drawn to, and answers the machine's uptime.
class TimerQuery {
 public:
  TimerQuery() = default;
  static TimerQuery create();

  void begin() const;
  void end() const;

  /// Milliseconds of the last begin() and end(); nothing while the GPU is still at it.
  std::optional<double> milliseconds() const;
  /// The same, waiting for it.
  double wait_milliseconds() const;

 private:
  static void destroy(GLuint id);

  Name<&TimerQuery::destroy> begin_, end_;
};

}  // namespace globe::gl
