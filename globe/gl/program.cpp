#include "globe/gl/program.h"

#include <array>
#include <cassert>
#include <glm/gtc/type_ptr.hpp>
#include <string_view>

#include "globe/base/error.h"

namespace globe::gl {
namespace {

constexpr const char* kWhatToDo = "correct the shader, or unset GLOBE_SHADER_DIR to use the built-in ones";

void destroy_shader(GLuint id) { glDeleteShader(id); }
using ShaderName = Name<&destroy_shader>;

GLenum stage_of(const std::string& file) {
  struct Stage {
    std::string_view suffix;
    GLenum stage;
  };
  constexpr std::array<Stage, 6> stages = {{{".vert", GL_VERTEX_SHADER},
                                            {".tesc", GL_TESS_CONTROL_SHADER},
                                            {".tese", GL_TESS_EVALUATION_SHADER},
                                            {".geom", GL_GEOMETRY_SHADER},
                                            {".frag", GL_FRAGMENT_SHADER},
                                            {".comp", GL_COMPUTE_SHADER}}};
  for (const Stage& stage : stages) {
    if (file.ends_with(stage.suffix)) return stage.stage;
  }
  assert(false && "shader file with an unknown suffix");
  return 0;
}

template <class GetParameter, class GetLog>
std::string info_log(GLuint id, GetParameter get_parameter, GetLog get_log) {
  GLint length = 0;
  get_parameter(id, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  get_log(id, length, &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return log;
}

ShaderName compile(const std::string& file, const ProgramSources& sources) {
  const ShaderSource source = assemble_shader(file, sources.defines, sources.reader);
  ShaderName shader(glCreateShader(stage_of(file)));
  const char* text = source.text.c_str();
  glShaderSource(shader.id(), 1, &text, nullptr);
  glCompileShader(shader.id());
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader.id(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;
  const std::string log = info_log(
      shader.id(), [](auto... a) { glGetShaderiv(a...); }, [](auto... a) { glGetShaderInfoLog(a...); });
  throw Error("shader " + file, "it does not compile: " + log_with_names(log, source.files), kWhatToDo);
}

std::string listed(const std::vector<std::string>& files) {
  std::string result;
  for (const std::string& file : files) result += (result.empty() ? "" : " + ") + file;
  return result;
}

}  // namespace

void Program::destroy(GLuint id) { glDeleteProgram(id); }

Program::Program(const ProgramSources& sources) : name_(glCreateProgram()) {
  std::vector<ShaderName> shaders;
  for (const std::string& file : sources.files) {
    shaders.push_back(compile(file, sources));
    glAttachShader(id(), shaders.back().id());
  }
  std::vector<const char*> captured;
  for (const std::string& output : sources.captured) captured.push_back(output.c_str());
  if (!captured.empty()) {
    glTransformFeedbackVaryings(id(), static_cast<GLsizei>(captured.size()), captured.data(),
                                GL_INTERLEAVED_ATTRIBS);
  }
  glLinkProgram(id());
  for (const ShaderName& shader : shaders) glDetachShader(id(), shader.id());
  GLint linked = GL_FALSE;
  glGetProgramiv(id(), GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return;
  const std::string log = info_log(
      id(), [](auto... a) { glGetProgramiv(a...); }, [](auto... a) { glGetProgramInfoLog(a...); });
  throw Error("shaders " + listed(sources.files), "they do not link: " + log_with_names(log, {}), kWhatToDo);
}

void Program::use() const { glUseProgram(id()); }

GLint Program::uniform(const char* name) const { return glGetUniformLocation(id(), name); }

void Program::set(GLint location, int value) const { glProgramUniform1i(id(), location, value); }
void Program::set(GLint location, unsigned value) const { glProgramUniform1ui(id(), location, value); }
void Program::set(GLint location, float value) const { glProgramUniform1f(id(), location, value); }
void Program::set(GLint location, const glm::ivec2& value) const {
  glProgramUniform2iv(id(), location, 1, glm::value_ptr(value));
}
void Program::set(GLint location, const glm::ivec4& value) const {
  glProgramUniform4iv(id(), location, 1, glm::value_ptr(value));
}
void Program::set(GLint location, const glm::vec2& value) const {
  glProgramUniform2fv(id(), location, 1, glm::value_ptr(value));
}
void Program::set(GLint location, const glm::vec3& value) const {
  glProgramUniform3fv(id(), location, 1, glm::value_ptr(value));
}
void Program::set(GLint location, const glm::vec4& value) const {
  glProgramUniform4fv(id(), location, 1, glm::value_ptr(value));
}
void Program::set(GLint location, const glm::mat3& value) const {
  glProgramUniformMatrix3fv(id(), location, 1, GL_FALSE, glm::value_ptr(value));
}
void Program::set(GLint location, const glm::mat4& value) const {
  glProgramUniformMatrix4fv(id(), location, 1, GL_FALSE, glm::value_ptr(value));
}

}  // namespace globe::gl
