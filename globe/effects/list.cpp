#include "globe/effects/list.h"

#include <algorithm>

#include "globe/base/error.h"

// Tests build this file with other lists.
#ifndef GLOBE_EFFECTS_LIST
#define GLOBE_EFFECTS_LIST "globe/effects/list.def"
#endif

namespace globe::effects {

#define EFFECT(name) EffectEntry name();
#include GLOBE_EFFECTS_LIST
#undef EFFECT

std::span<const EffectEntry> all_effects() {
  static const std::vector<EffectEntry> entries{
#define EFFECT(name) name(),
#include GLOBE_EFFECTS_LIST
#undef EFFECT
  };
  return entries;
}

std::vector<scene::EffectKind> effect_kinds() {
  std::vector<scene::EffectKind> kinds;
  for (const EffectEntry& entry : all_effects()) kinds.push_back(entry.kind);
  return kinds;
}

bool draws_sea(const scene::Scene& scene) {
  const std::span<const EffectEntry> entries = all_effects();
  return std::any_of(entries.begin(), entries.end(), [&](const EffectEntry& entry) {
    return entry.draws_sea && std::any_of(scene.effects.begin(), scene.effects.end(),
                                          [&](const auto& effect) { return effect.name == entry.kind.name; });
  });
}

std::vector<render::NamedEffect> make_effects(const scene::Scene& scene, const planet::Surface& surface) {
  std::vector<render::NamedEffect> made;
  // In the order of the list, whatever the file's: what an effect does to light depends on it.
  for (const EffectEntry& entry : all_effects()) {
    for (const scene::Effect& effect : scene.effects) {
      if (effect.name != entry.kind.name) continue;
      const std::string where =
          scene.file.string() + ":" + std::to_string(effect.line) + ": effects." + effect.name;
      if (!made.empty() && made.back().name == effect.name)
        throw Error(where, "the effect is there twice", "leave one of them out");
      try {
        made.push_back({effect.name, entry.make(effect.parameters, surface)});
      } catch (const Refused& refused) {
        throw Error(where, refused.why, refused.what_to_do);
      }
    }
  }
  return made;
}

}  // namespace globe::effects
