#include "globe/gl/shader_source.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "globe/base/error.h"
#include "globe/gl/embedded_shaders.h"

namespace globe::gl {
namespace {

std::optional<std::string> read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

/// The name in `#include "name"`, if the line is one.
std::optional<std::string> included_name(const std::string& line) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*"([^"]*)"\s*(//.*)?$)re");
  std::smatch match;
  if (!std::regex_match(line, match, pattern)) return std::nullopt;
  return match[1].str();
}

std::string line_directive(std::size_t line, std::size_t file) {
  return "#line " + std::to_string(line) + " " + std::to_string(file) + "\n";
}

class Assembler {
 public:
  Assembler(ShaderSource& source, const ShaderReader& reader) : source_(source), reader_(reader) {}

  /// @param asked_by  "file:line" of the include, empty for the entry file
  void append(const std::string& name, const std::string& asked_by) {
    if (std::find(source_.files.begin(), source_.files.end(), name) != source_.files.end()) return;
    const std::optional<std::string> text = reader_(name);
    if (!text) {
      throw Error("shader " + (asked_by.empty() ? name : asked_by), "there is no file " + name,
                  "build the program anew, or complete the folder GLOBE_SHADER_DIR");
    }
    const std::size_t file = source_.files.size();
    source_.files.push_back(name);
    source_.text += line_directive(1, file);
    std::istringstream lines(*text);
    std::string line;
    for (std::size_t number = 1; std::getline(lines, line); ++number) {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      if (const auto included = included_name(line)) {
        append(*included, name + ":" + std::to_string(number));
        source_.text += line_directive(number + 1, file);
      } else {
        source_.text += line;
        source_.text += '\n';
      }
    }
  }

 private:
  ShaderSource& source_;
  const ShaderReader& reader_;
};

}  // namespace

std::optional<std::string> read_shader(const std::string& name) {
  if (const char* folder = std::getenv("GLOBE_SHADER_DIR"); folder != nullptr && *folder != '\0') {
    return read_file(std::string(folder) + "/" + name);
  }
  const auto files = embedded_shaders();
  const auto found =
      std::find_if(files.begin(), files.end(), [&](const EmbeddedShader& file) { return name == file.name; });
  if (found == files.end()) return std::nullopt;
  return std::string(found->text);
}

ShaderSource assemble_shader(const std::string& name, const std::vector<std::string>& defines,
                             const ShaderReader& reader) {
  ShaderSource source;
  source.text = "#version 450 core\n";
  for (const std::string& define : defines) source.text += "#define " + define + "\n";
  Assembler(source, reader).append(name, "");
  return source;
}

std::string log_with_names(const std::string& log, const std::vector<std::string>& files) {
  // Source number and line in the dialects of Mesa, NVIDIA and the rest; each at the start of a line of the
  // log.
  static const std::regex pattern(R"re(^(ERROR: |WARNING: )?(\d+)(?::(\d+)(?:\(\d+\))?|\((\d+)\))\s*:\s*)re");
  std::ostringstream result;
  std::istringstream lines(log);
  std::string line;
  while (std::getline(lines, line)) {
    if (line.empty()) continue;
    if (result.tellp() > 0) result << '\n';
    std::smatch match;
    if (!std::regex_search(line, match, pattern)) {
      result << line;
      continue;
    }
    const std::size_t file = std::stoul(match[2].str());
    result << (file < files.size() ? files[file] : "(generated)") << ':'
           << (match[3].matched ? match[3].str() : match[4].str()) << ": " << match[1].str()
           << match.suffix().str();
  }
  return result.str();
}

}  // namespace globe::gl
