#include "globe/gl/program.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "globe/base/error.h"
#include "globe/gl/buffer.h"
#include "tests/render/gl_fixture.h"

namespace globe::gl {
namespace {

class ProgramGlTest : public GlTest {};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string message_of(const ProgramSources& sources) {
  try {
    const Program program(sources);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string message_of(const std::string& name, const ShaderReader& reader) {
  return message_of(ProgramSources{{name}, {}, {}, reader});
}

TEST(ShaderSource, PutsIncludesInTheirPlaceAndCountsLines) {
  const ShaderSource source = assemble_shader(
      "a.vert", {"SIDE 64", "FAST"},
      shaders_from({{"a.vert", "one\n#include \"lib/b.glsl\"\nthree\n"}, {"lib/b.glsl", "b one\nb two"}}));
  EXPECT_EQ(source.text,
            "#version 450 core\n#define SIDE 64\n#define FAST\n#line 1 0\none\n#line 1 1\nb one\nb two\n"
            "#line 3 0\nthree\n");
  EXPECT_EQ(source.files, (std::vector<std::string>{"a.vert", "lib/b.glsl"}));
}

TEST(ShaderSource, IncludesAFileOnceEvenInACircle) {
  const ShaderSource source = assemble_shader("a.vert", {},
                                              shaders_from({{"a.vert", "#include \"b\"\n#include \"c\"\n"},
                                                            {"b", "#include \"c\"\n"},
                                                            {"c", "#include \"b\"\nc\n"}}));
  EXPECT_EQ(source.files.size(), 3u);
  EXPECT_EQ(source.text.find("\nc\n"), source.text.rfind("\nc\n"));
}

TEST(ShaderSource, NamesTheLineThatAsksForAMissingFile) {
  try {
    assemble_shader("a.vert", {},
                    shaders_from({{"a.vert", "\n#include \"b\"\n"}, {"b", "\n\n#include \"gone\"\n"}}));
    FAIL();
  } catch (const Error& error) {
    EXPECT_TRUE(contains(error.what(), "b:3")) << error.what();
    EXPECT_TRUE(contains(error.what(), "gone")) << error.what();
  }
}

TEST(ShaderSource, ReadsTheLogsOfSeveralDrivers) {
  const std::vector<std::string> files = {"a.vert", "lib/b.glsl"};
  EXPECT_EQ(log_with_names("1:12(3): error: no such thing\n", files), "lib/b.glsl:12: error: no such thing");
  EXPECT_EQ(log_with_names("1(12) : error C0000: no such thing\n", files),
            "lib/b.glsl:12: error C0000: no such thing");
  EXPECT_EQ(log_with_names("ERROR: 0:12: 'x' : undeclared\n", files), "a.vert:12: ERROR: 'x' : undeclared");
  EXPECT_EQ(log_with_names("error: linking failed\n", files), "error: linking failed");
}

TEST(ShaderSource, EveryBuiltInFileIsThere) {
  const std::filesystem::path folder = GLOBE_SOURCE_DIR "/shaders";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shaders yet";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    EXPECT_EQ(read_shader(std::filesystem::relative(entry.path(), folder).string()), text) << entry.path();
  }
  EXPECT_EQ(read_shader("nothing/of/this.name"), std::nullopt);
}

TEST(ShaderSource, TheFolderOfTheEnvironmentGoesFirst) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "globe_shader_dir_test";
  std::filesystem::create_directories(folder / "lib");
  std::ofstream(folder / "lib/own.glsl") << "own\n";
  setenv("GLOBE_SHADER_DIR", folder.c_str(), 1);
  EXPECT_EQ(read_shader("lib/own.glsl"), "own\n");
  EXPECT_EQ(read_shader("lib/gone.glsl"), std::nullopt);
  unsetenv("GLOBE_SHADER_DIR");
  EXPECT_EQ(read_shader("lib/own.glsl"), std::nullopt);
  std::filesystem::remove_all(folder);
}

TEST_F(ProgramGlTest, BrokenShaderNamesFileAndLine) {
  const std::string message = message_of(
      "a.vert",
      shaders_from({{"a.vert", "void main() {\n  gl_Position = vec4(0.0);\n  nonsense = 1;\n}\n"}}));
  EXPECT_TRUE(contains(message, "a.vert:3:")) << message;
  EXPECT_TRUE(contains(message, "nonsense")) << message;
}

TEST_F(ProgramGlTest, ErrorInAnIncludeNamesTheInclude) {
  const std::string message = message_of(
      "a.vert",
      shaders_from({{"a.vert", "#include \"lib/b.glsl\"\nvoid main() { gl_Position = vec4(f()); }\n"},
                    {"lib/b.glsl", "// fine\nfloat f() {\n  return nonsense;\n}\n"}}));
  EXPECT_TRUE(contains(message, "lib/b.glsl:3:")) << message;
}

TEST_F(ProgramGlTest, LinesAreRightAfterAnInclude) {
  const std::string message = message_of(
      "a.vert", shaders_from({{"a.vert", "\n#include \"lib/b.glsl\"\nvoid main() {\n  nonsense = f();\n}\n"},
                              {"lib/b.glsl", "float f() { return 1.0; }\n"}}));
  EXPECT_TRUE(contains(message, "a.vert:4:")) << message;
}

TEST_F(ProgramGlTest, StagesThatDoNotFitNameTheFiles) {
  const std::string message =
      message_of({{"a.vert", "a.frag"},
                  {},
                  {},
                  shaders_from({{"a.vert", "void main() { gl_Position = vec4(0.0); }\n"},
                                {"a.frag",
                                 "in vec3 missing;\nout vec4 color;\nvoid main() { color = "
                                 "vec4(missing, 1.0); }\n"}})});
  EXPECT_TRUE(contains(message, "a.vert + a.frag")) << message;
  EXPECT_TRUE(contains(message, "missing")) << message;
}

TEST_F(ProgramGlTest, ComputeSeesDefinesAndUniforms) {
  const Program program({{"a.comp"}, {"FACTOR 3"}, {}, shaders_from({{"a.comp", R"(
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Result { float result[6]; };
uniform int whole;
uniform float real;
uniform vec3 vector;
uniform mat4 matrix;
void main() {
  result[0] = float(FACTOR);
  result[1] = float(whole);
  result[2] = real;
  result[3] = vector.z;
  result[4] = matrix[3][1];
  result[5] = matrix[1][3];
}
)"}})});
  program.set(program.uniform("whole"), 5);
  program.set(program.uniform("real"), 0.5f);
  program.set(program.uniform("vector"), glm::vec3(1, 2, 9));
  glm::mat4 matrix(0.0f);
  matrix[3][1] = 31.0f;
  matrix[1][3] = 13.0f;
  program.set(program.uniform("matrix"), matrix);
  EXPECT_EQ(program.uniform("no_such_uniform"), -1);
  program.set(program.uniform("no_such_uniform"), 1.0f);
  const Buffer result(6 * sizeof(float));
  result.bind_base(GL_SHADER_STORAGE_BUFFER, 0);
  program.use();
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  EXPECT_EQ(result.read<float>(0, 6), (std::vector<float>{3, 5, 0.5f, 9, 31, 13}));
}

}  // namespace
}  // namespace globe::gl
