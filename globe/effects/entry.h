#pragma once

#include <any>
#include <memory>
#include <string>
#include <string_view>

#include "globe/planet/surface.h"
#include "globe/render/effect.h"
#include "globe/scene/scene.h"

namespace globe::effects {

/// Thrown by the making of an effect that a planet cannot have; a line for people is made of it by
/// make_effects.
struct Refused {
  std::string why;
  std::string what_to_do;
};

/// One line of the list of effects (list.def): how scenes say it and how it is made.
struct EffectEntry {
  scene::EffectKind kind;  ///< its name and the reader of its parameters
  /// @param parameters  what kind.read returned
  /// Throws Refused.
  std::unique_ptr<render::Effect> (*make)(const std::any& parameters, const planet::Surface& surface);
  bool draws_sea = false;  ///< over a floor that it needs bare (planet::SeaFloor)
};

/// The entry of an effect with parameters of one type: `Parameters read(scene::Fields&)` and a class made
/// from (const Parameters&, const planet::Surface&).
template <class Parameters, class Made, Parameters (*read)(scene::Fields&)>
constexpr EffectEntry entry_of(std::string_view name) {
  return {{name, [](scene::Fields& fields) { return std::any(read(fields)); }},
          [](const std::any& parameters, const planet::Surface& surface) -> std::unique_ptr<render::Effect> {
            return std::make_unique<Made>(std::any_cast<const Parameters&>(parameters), surface);
          }};
}

}  // namespace globe::effects
