#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "globe/gl/shader_source.h"
#include "globe/render/effect.h"

namespace globe::render {

/// An effect and the name that its shaders go by.
struct NamedEffect {
  std::string name;
  std::unique_ptr<Effect> effect;
};

/// What the effects of a scene add to the programs that draw surfaces and the sky: the file "effects.glsl",
/// which those include where EFFECTS is defined. Without effects nothing is defined and the programs are what
/// they were.
///
/// The file offers, each doing nothing where no effect has a part in it:
///     void dim_by_effects(inout vec3 sunlight, inout vec3 skylight, Place place)
///     vec3 added_by_effects(vec3 light, Place place)
///     vec3 through_effects(vec3 light, Place place)
///     vec3 sky_through_effects(vec3 light, vec3 direction)
/// A program for any set of active effects passes over the others by a bit of the uniform `active_effects`;
/// one for a single set has nothing of them (EffectProgram).
class EffectShaders {
 public:
  EffectShaders() = default;
  explicit EffectShaders(std::span<const NamedEffect> effects);

  /// Location of `uniform int active_effects` (shaders/lib/active_effects.glsl) in programs of the ground and
  /// the sky that serve any set: one bit an effect, and kKeepLight.
  static constexpr int kActiveEffects = 10;
  static constexpr int kKeepLight = 1 << 30;

  /// Any effect adds to the programs of others.
  bool has_parts() const { return parts_ != 0; }
  /// Any has a pass of its own: where one is active the picture is drawn as light and toned at the end.
  bool may_keep_light() const { return may_keep_light_; }
  /// Programs of the ground and the sky have the uniform.
  bool is_used() const { return has_parts() || may_keep_light_; }

  /// Which of a view's active effects programs of the ground and the sky differ by.
  int set_of(int active) const { return active & (parts_ | (may_keep_light_ ? kKeepLight : 0)); }

  /// Reads shaders/ with "effects.glsl", for any set or for one, and what is replaced.
  gl::ShaderReader reader(std::optional<int> set = std::nullopt) const;
  /// For every program that draws surfaces or the sky.
  const std::vector<std::string>& defines() const { return defines_; }
  /// Of the effect of that place in the list.
  const Bindings& bindings(std::size_t effect) const { return bindings_[effect]; }

 private:
  std::string text(std::optional<int> set) const;

  std::vector<std::string> names_;
  std::vector<EffectShader> shaders_;
  int parts_ = 0;  ///< effects with a part in programs of others: one bit each
  bool may_keep_light_ = false;
  std::vector<std::string> defines_;
  std::vector<std::pair<std::string, std::string>> replaced_;
  std::vector<Bindings> bindings_;
};

}  // namespace globe::render
