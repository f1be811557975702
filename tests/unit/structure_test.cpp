#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/temporary_folder.h"

// What the compiler does not see: which way the includes point, and how the vertex shader is written.

namespace {

namespace fs = std::filesystem;

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  std::vector<std::string> found;
  const std::regex regex(pattern);
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
    found.push_back((*it)[1]);
  return found;
}

/// "globe/geo" of "globe/geo/area.h", "app" of "app/point.h": rooms of the core are named with it.
std::string room_of(const fs::path& relative) {
  auto part = relative.begin();
  std::string room = part->string();
  if (room == "globe") room += "/" + (++part)->string();
  return room;
}

/// What a room may include besides itself.
const std::map<std::string, std::set<std::string>> kMayInclude = [] {
  std::map<std::string, std::set<std::string>> rooms;
  rooms["globe/base"] = {};
  rooms["globe/geo"] = {"globe/base"};
  rooms["globe/htm"] = {"globe/base"};
  rooms["globe/region"] = {"globe/base", "globe/geo", "globe/htm"};
  rooms["globe/planet"] = {"globe/base", "globe/geo", "globe/htm", "globe/region"};
  rooms["globe/search"] = {"globe/base", "globe/geo", "globe/htm", "globe/region"};
  rooms["globe/clipmap"] = {"globe/base", "globe/geo", "globe/htm", "globe/planet"};
  rooms["globe/gl"] = {"globe/base"};
  rooms["globe/scene"] = {"globe/base", "globe/geo", "globe/planet"};
  rooms["globe/render"] = {"globe/base",   "globe/geo",     "globe/htm",
                           "globe/planet", "globe/clipmap", "globe/gl"};
  rooms["globe/effects"] = {"globe/base",    "globe/geo", "globe/htm",    "globe/planet",
                            "globe/clipmap", "globe/gl",  "globe/render", "globe/scene"};
  const std::set<std::string> core{"globe/base",   "globe/geo",    "globe/htm",     "globe/region",
                                   "globe/planet", "globe/search", "globe/clipmap", "globe/gl",
                                   "globe/scene",  "globe/render", "globe/effects"};
  rooms["converters"] = {"globe/base", "globe/geo", "globe/htm", "globe/planet"};
  rooms["flat"] = core;
  rooms["app"] = core;
  rooms["app"].insert({"converters", "flat"});
  return rooms;
}();

const std::set<std::string> kWithoutGraphics{"globe/base",   "globe/geo",    "globe/htm",     "globe/region",
                                             "globe/planet", "globe/search", "globe/clipmap", "converters"};

/// What is wrong with the includes of one file; empty when nothing is.
std::vector<std::string> wrong_includes(const fs::path& relative, const std::string& text) {
  std::vector<std::string> wrong;
  const std::string room = room_of(relative);
  const auto allowed = kMayInclude.find(room);
  if (allowed == kMayInclude.end()) return {relative.string() + " lies in no room that DESIGN names"};
  for (const std::string& include : matches(text, R"re((?:^|\n)#include\s*"([^"]+)")re")) {
    const std::string other = room_of(include);
    const bool shader = other == "shaders" && (room.starts_with("globe/") || room == "flat");
    if (other != room && !shader && !allowed->second.contains(other))
      wrong.push_back(relative.string() + " includes " + include);
  }
  if (!kWithoutGraphics.contains(room)) return wrong;
  for (const std::string& include :
       matches(text, R"re((?:^|\n)#include\s*<((?:epoxy|GL|GLES\d?|EGL|GLFW)/[^>]+)>)re"))
    wrong.push_back(relative.string() + " includes <" + include + ">");
  return wrong;
}

TEST(Structure, NoIncludePointsBack) {
  std::size_t files = 0;
  for (const char* top : {"globe", "converters", "flat", "app"}) {
    const fs::path folder = fs::path(GLOBE_SOURCE_DIR) / top;
    if (!fs::exists(folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      const fs::path extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      ++files;
      for (const std::string& line :
           wrong_includes(fs::relative(entry.path(), GLOBE_SOURCE_DIR), tests::bytes_of(entry.path())))
        ADD_FAILURE() << line;
    }
  }
  EXPECT_GT(files, 50u);
}

TEST(Structure, ArrowsThatPointBackAreFound) {
  EXPECT_TRUE(wrong_includes("globe/planet/grid.cpp", "#include \"globe/htm/midpoint.h\"\n").empty());
  EXPECT_EQ(wrong_includes("globe/planet/grid.cpp", "#include \"globe/clipmap/patch.h\"\n").size(), 1u);
  EXPECT_EQ(wrong_includes("globe/gl/buffer.h", "#include \"globe/planet/grid.h\"\n").size(), 1u);
  EXPECT_EQ(wrong_includes("globe/geo/sun.cpp", "#include \"app/point.h\"\n").size(), 1u);
  EXPECT_EQ(wrong_includes("globe/htm/trixel.cpp", "#include <epoxy/gl.h>\n").size(), 1u);
  EXPECT_TRUE(wrong_includes("globe/render/camera.cpp", "#include <epoxy/gl.h>\n").empty());
}

/// What keeps clip positions from being the same in every pass (HARD-CASES H3); empty when nothing does.
std::vector<std::string> imprecisions(const std::string& shader) {
  std::vector<std::string> wrong;
  if (shader.find("invariant gl_Position;") == std::string::npos)
    wrong.push_back("gl_Position is not invariant");
  for (const char* name : {"position", "clip"}) {
    const std::string word = std::string("\\b") + name;
    if (matches(shader, "(precise\\s+vec[34]\\s+" + std::string(name) + "\\s*=)").size() != 1)
      wrong.push_back(std::string(name) + " is not declared precise, once");
    if (matches(shader, "((?:vec[34]|float)\\s+" + std::string(name) + "\\b)").size() != 1)
      wrong.push_back(std::string(name) + " is declared again");
  }
  const auto assigned = matches(shader, R"re(gl_Position\s*=\s*([^;]+);)re");
  if (assigned != std::vector<std::string>{"clip"}) wrong.push_back("gl_Position is not clip alone");
  for (const std::string& value : matches(shader, R"re(\bclip\s*=\s*([^;]+);)re")) {
    if (value != "view.clip_from_relative * vec4(position, 1.0)") wrong.push_back("clip is " + value);
  }
  // Everything position is made of: texels, offsets from the camera, the exact mix, none of it computed
  // before; and the sea's place over a vertex, in programs of the sea.
  const std::regex allowed(
      R"re((?:vec3|exact_mix|sea_over|height|position|fine|target|alpha|slot|coarse|rim_vertex|offset|xyz|x|y|z|[\s.,()+])+)re");
  for (const std::string& value : matches(shader, R"re(\bposition\s*\+?=\s*([^;=][^;]*);)re")) {
    if (!std::regex_match(value, allowed)) wrong.push_back("position takes " + value);
  }
  return wrong;
}

TEST(ClipmapShader, EveryStepToThePositionIsPrecise) {
  const std::string shader = tests::bytes_of(fs::path(GLOBE_SOURCE_DIR) / "shaders/clipmap.vert");
  for (const std::string& line : imprecisions(shader)) ADD_FAILURE() << line;
  EXPECT_GE(matches(shader, R"re((\bposition\s*\+?=)re" + std::string(")")).size(), 3u);
}

TEST(ClipmapShader, ImpreciseStepsAreFound) {
  const std::string shader = tests::bytes_of(fs::path(GLOBE_SOURCE_DIR) / "shaders/clipmap.vert");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = shader;
    const std::size_t at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return changed.replace(at, from.size(), to);
  };
  EXPECT_FALSE(imprecisions(with("precise vec3 position", "vec3 position")).empty());
  EXPECT_FALSE(imprecisions(with("precise vec4 clip", "vec4 clip")).empty());
  EXPECT_FALSE(imprecisions(with("invariant gl_Position;", "")).empty());
  EXPECT_FALSE(imprecisions(with("gl_Position = clip;", "gl_Position = clip * 1.0;")).empty());
  EXPECT_FALSE(
      imprecisions(with("position += slot.offset.xyz;", "position += slot.offset.xyz * scale;")).empty());
}

/// The same of local regions, whose patches meet as two computations of one vertex (flat/patch_mesh.h).
TEST(GeomipmapShader, EveryStepToThePositionIsPrecise) {
  const fs::path folder = fs::path(GLOBE_SOURCE_DIR) / "shaders/flat";
  const std::string shader = tests::bytes_of(folder / "geomipmap.vert");
  EXPECT_NE(shader.find("invariant gl_Position;"), std::string::npos);
  EXPECT_EQ(matches(shader, R"re((precise (?:float z|vec3 local|vec3 position|vec4 clip)) =)re").size(), 4u);
  EXPECT_EQ(matches(shader, R"re(gl_Position\s*=\s*([^;]+);)re"), std::vector<std::string>{"clip"});
  const std::string morph = tests::bytes_of(folder / "geomorph.glsl");
  EXPECT_EQ(matches(morph, R"re(\n  (precise )(?:float|vec4) \w+ =)re").size(), 3u);
  EXPECT_EQ(matches(morph, R"re(\n  ((?:float|vec4) \w+ =))re").size(), 0u);
}

}  // namespace
