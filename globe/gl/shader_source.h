#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace globe::gl {

/// Text of a shader file by its name under shaders/ ("lib/morph.glsl"); nothing when there is no such file.
using ShaderReader = std::function<std::optional<std::string>(const std::string& name)>;

/// Reads the files built into the program, or those under the folder $GLOBE_SHADER_DIR when it is set.
std::optional<std::string> read_shader(const std::string& name);

/// One stage ready to compile, and the files its lines came from: the text says `#line N F`, F counts in
/// `files`.
struct ShaderSource {
  std::string text;
  std::vector<std::string> files;
};

/// Puts `#version 450 core` and the defines in front of a file and its includes in their places.
///
/// An include is a line `#include "lib/x.glsl"`, named from the top of shaders/ wherever it stands. A file
/// comes in once a stage, later mentions are empty. Files carry no #version of their own.
/// @param defines  "NAME" or "NAME VALUE"
/// Throws Error, naming file and line, for a file that is missing.
ShaderSource assemble_shader(const std::string& name, const std::vector<std::string>& defines,
                             const ShaderReader& reader = read_shader);

/// A compiler's log with the source numbers turned into file names: "0:12(3): error" (Mesa), "0(12) : error"
/// (NVIDIA) and "ERROR: 0:12:" (others) become "surface.vert:12: ...".
std::string log_with_names(const std::string& log, const std::vector<std::string>& files);

}  // namespace globe::gl
