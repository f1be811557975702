#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <vector>

#include "globe/gl/name.h"
#include "globe/gl/shader_source.h"

namespace globe::gl {

/// What a program is built from.
struct ProgramSources {
  std::vector<std::string> files;     ///< one a stage, told by .vert .tesc .tese .geom .frag .comp
  std::vector<std::string> defines;   ///< "NAME" or "NAME VALUE", for every stage
  std::vector<std::string> captured;  ///< outputs recorded by transform feedback, interleaved
  ShaderReader reader = read_shader;
};

/// A linked program.
class Program {
 public:
  Program() = default;
  /// Throws Error naming file and line when a stage does not compile or the stages do not link.
  explicit Program(const ProgramSources& sources);

  GLuint id() const { return name_.id(); }
  void use() const;

  /// Location of a uniform; -1, to which setting does nothing, when the program does not use it. Ask once,
  /// not a frame. (glGetUniformLocation)
  GLint uniform(const char* name) const;

  /// (glProgramUniform*)
  void set(GLint location, int value) const;
  void set(GLint location, unsigned value) const;
  void set(GLint location, float value) const;
  void set(GLint location, const glm::ivec2& value) const;
  void set(GLint location, const glm::ivec4& value) const;
  void set(GLint location, const glm::vec2& value) const;
  void set(GLint location, const glm::vec3& value) const;
  void set(GLint location, const glm::vec4& value) const;
  void set(GLint location, const glm::mat3& value) const;
  void set(GLint location, const glm::mat4& value) const;

 private:
  static void destroy(GLuint id);

  Name<&Program::destroy> name_;
};

}  // namespace globe::gl
