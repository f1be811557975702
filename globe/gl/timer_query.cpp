#include "globe/gl/timer_query.h"

namespace globe::gl {

void TimerQuery::destroy(GLuint id) { glDeleteQueries(1, &id); }

TimerQuery TimerQuery::create() {
  TimerQuery result;
  GLuint ids[2] = {};
  glCreateQueries(GL_TIMESTAMP, 2, ids);
  result.begin_ = Name<&TimerQuery::destroy>(ids[0]);
  result.end_ = Name<&TimerQuery::destroy>(ids[1]);
  return result;
}

void TimerQuery::begin() const { glQueryCounter(begin_.id(), GL_TIMESTAMP); }
void TimerQuery::end() const { glQueryCounter(end_.id(), GL_TIMESTAMP); }

std::optional<double> TimerQuery::milliseconds() const {
  GLint available = GL_FALSE;
  glGetQueryObjectiv(end_.id(), GL_QUERY_RESULT_AVAILABLE, &available);
  if (available == GL_FALSE) return std::nullopt;
  return wait_milliseconds();
}

double TimerQuery::wait_milliseconds() const {
  GLuint64 begun = 0, ended = 0;
  glGetQueryObjectui64v(begin_.id(), GL_QUERY_RESULT, &begun);
  glGetQueryObjectui64v(end_.id(), GL_QUERY_RESULT, &ended);
  return static_cast<double>(ended - begun) * 1e-6;
}

}  // namespace globe::gl
