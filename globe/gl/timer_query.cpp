#include "globe/gl/timer_query.h"

namespace globe::gl {

void TimerQuery::destroy(GLuint id) { glDeleteQueries(1, &id); }

TimerQuery TimerQuery::create() {
  TimerQuery result;
  GLuint id = 0;
  glCreateQueries(GL_TIME_ELAPSED, 1, &id);
  result.name_ = Name<&TimerQuery::destroy>(id);
  return result;
}

void TimerQuery::begin() const { glBeginQuery(GL_TIME_ELAPSED, name_.id()); }
void TimerQuery::end() const { glEndQuery(GL_TIME_ELAPSED); }

std::optional<double> TimerQuery::milliseconds() const {
  GLint available = GL_FALSE;
  glGetQueryObjectiv(name_.id(), GL_QUERY_RESULT_AVAILABLE, &available);
  if (available == GL_FALSE) return std::nullopt;
  return wait_milliseconds();
}

double TimerQuery::wait_milliseconds() const {
  GLuint64 nanoseconds = 0;
  glGetQueryObjectui64v(name_.id(), GL_QUERY_RESULT, &nanoseconds);
  return static_cast<double>(nanoseconds) * 1e-6;
}

}  // namespace globe::gl
