#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "globe/gl/embedded_shaders.h"
#include "globe/gl/shader_source.h"
#include "tests/temporary_folder.h"

namespace views {

/// `text` with one passage exchanged; throws when it is not there.
inline std::string exchanged(std::string text, const std::string& passage, const std::string& by) {
  const std::size_t at = text.find(passage);
  if (at == std::string::npos) throw std::runtime_error("no such passage in the shader: " + passage);
  return text.replace(at, passage.size(), by);
}

/// A reader that gives the shaders as they are but for one passage of one file: for negative controls.
inline globe::gl::ShaderReader with_exchange(const std::string& file, const std::string& passage,
                                             const std::string& by) {
  return [=](const std::string& name) -> std::optional<std::string> {
    std::optional<std::string> text = globe::gl::read_shader(name);
    if (text && name == file) text = exchanged(*text, passage, by);
    return text;
  };
}

/// While it lives, every program is built from shaders with one passage exchanged ($GLOBE_SHADER_DIR).
class ShaderVariant {
 public:
  ShaderVariant(const std::string& file, const std::string& passage, const std::string& by) {
    const globe::gl::ShaderReader reader = with_exchange(file, passage, by);
    for (const globe::gl::EmbeddedShader& shader : globe::gl::embedded_shaders()) {
      const std::filesystem::path path = folder_ / shader.name;
      std::filesystem::create_directories(path.parent_path());
      std::ofstream(path) << *reader(shader.name);
    }
    setenv("GLOBE_SHADER_DIR", folder_.path().c_str(), 1);
  }
  ShaderVariant(const ShaderVariant&) = delete;
  ShaderVariant& operator=(const ShaderVariant&) = delete;
  ~ShaderVariant() { unsetenv("GLOBE_SHADER_DIR"); }

 private:
  tests::TemporaryFolder folder_;
};

}  // namespace views
