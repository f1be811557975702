#include "globe/render/effect_program.h"

#include <string>
#include <utility>

namespace globe::render {

EffectProgram::EffectProgram(gl::ProgramSources sources, const EffectShaders& effects)
    : sources_(std::move(sources)), effects_(&effects) {
  sources_.defines.insert(sources_.defines.end(), effects.defines().begin(), effects.defines().end());
}

const gl::Program& EffectProgram::for_active(int active, Serving serving) {
  if (serving != Serving::kAny || !effects_->is_used()) {
    const int set = effects_->set_of(active);
    if (const auto found = sets_.find(set); found != sets_.end()) return found->second;
    if (serving == Serving::kItsSet || !effects_->is_used())
      return sets_.emplace(set, compiled_for(set)).first->second;
  }
  if (!any_) any_ = compiled_for(std::nullopt);
  any_->set(EffectShaders::kActiveEffects, active);
  return *any_;
}

gl::Program EffectProgram::compiled_for(std::optional<int> set) const {
  gl::ProgramSources sources = sources_;
  sources.reader = effects_->reader(set);
  if (set && effects_->is_used()) sources.defines.push_back("ACTIVE_EFFECTS " + std::to_string(*set));
  return gl::Program(sources);
}

}  // namespace globe::render
