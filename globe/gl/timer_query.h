#pragma once

#include <optional>

#include "globe/gl/name.h"

namespace globe::gl {

/// GPU time between begin() and end(). One at a time may run. (GL_TIME_ELAPSED)
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

  Name<&TimerQuery::destroy> name_;
};

}  // namespace globe::gl
