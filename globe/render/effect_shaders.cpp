#include "globe/render/effect_shaders.h"

#include <algorithm>
#include <cctype>
#include <functional>

namespace globe::render {
namespace {

constexpr const char* kFile = "effects.glsl";
constexpr unsigned kFirstBlock = 2;  ///< 0 and 1: the view's, the slots'
constexpr unsigned kFirstUnit = 6;   ///< 0 to 5: the ground's, the sky's map, a region's water

std::string in_capitals(std::string name) {
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return name;
}

/// A function of the file that calls each effect's own.
struct Part {
  const char* head;
  const char* last;
  bool EffectShader::*has;
  const char* call;  ///< "#": the effect's name
};

constexpr Part kParts[] = {{"void dim_by_effects(inout vec3 sunlight, inout vec3 skylight, Place place) {",
                            "", &EffectShader::dims_light, "#_dim(sunlight, skylight, place);"},
                           {"vec3 added_by_effects(vec3 light, Place place) {", "  return light;\n",
                            &EffectShader::adds_light, "light = #_add(light, place);"},
                           {"vec3 through_effects(vec3 light, Place place) {", "  return light;\n",
                            &EffectShader::is_medium, "light = #_through(light, place.relative);"},
                           {"vec3 sky_through_effects(vec3 light, vec3 direction) {", "  return light;\n",
                            &EffectShader::is_medium, "light = #_through(light, direction * kSkyDistance);"}};

std::string with_name(std::string call, const std::string& name) {
  return call.replace(call.find('#'), 1, name);
}

}  // namespace

EffectShaders::EffectShaders(std::span<const NamedEffect> effects) {
  Bindings next{kFirstBlock, kFirstUnit};
  for (const NamedEffect& named : effects) {
    const EffectShader& shader = shaders_.emplace_back(named.effect->shader());
    names_.push_back(named.name);
    bindings_.push_back(next);
    const std::string name = in_capitals(named.name);
    defines_.push_back(name + "_BLOCK " + std::to_string(next.block));
    defines_.push_back(name + "_UNIT " + std::to_string(next.unit));
    defines_.insert(defines_.end(), shader.defines.begin(), shader.defines.end());
    replaced_.insert(replaced_.end(), shader.replaced.begin(), shader.replaced.end());
    ++next.block;
    next.unit += static_cast<unsigned>(shader.textures);
    if (!shader.file.empty()) parts_ |= 1 << (shaders_.size() - 1);
    may_keep_light_ = may_keep_light_ || named.effect->stage() != Stage::kNone;
  }
  if (may_keep_light_) defines_.emplace_back("KEEP_LIGHT");
  if (has_parts()) defines_.emplace_back("EFFECTS");
}

std::string EffectShaders::text(std::optional<int> set) const {
  std::string text = "#include \"lib/place.glsl\"\n#include \"lib/active_effects.glsl\"\n";
  const auto is_left_out = [&](std::size_t k) { return set && (*set >> k & 1) == 0; };
  for (std::size_t k = 0; k < shaders_.size(); ++k) {
    if (!shaders_[k].file.empty() && !is_left_out(k)) text += "#include \"" + shaders_[k].file + "\"\n";
  }
  for (const Part& part : kParts) {
    text += std::string(part.head) + "\n";
    for (std::size_t k = 0; k < shaders_.size(); ++k) {
      if (!(shaders_[k].*part.has) || is_left_out(k)) continue;
      text += set ? "  " : "  if ((active_effects & " + std::to_string(1 << k) + ") != 0) ";
      text += with_name(part.call, names_[k]) + "\n";
    }
    text += std::string(part.last) + "}\n";
  }
  return text;
}

gl::ShaderReader EffectShaders::reader(std::optional<int> set) const {
  return [text = text(set), replaced = replaced_](const std::string& name) -> std::optional<std::string> {
    if (name == kFile) return text;
    const auto other =
        std::find_if(replaced.begin(), replaced.end(), [&](const auto& pair) { return pair.first == name; });
    return gl::read_shader(other == replaced.end() ? name : other->second);
  };
}

}  // namespace globe::render
