#pragma once

#include <string>
#include <vector>

#include "app/accuracy/scattering_reference.h"

namespace app::accuracy {

inline const globe::effects::AirModel kModel;  ///< the default

/// Looks through the air of the default model whose light is known: from the ground, the air and space, from
/// noon to the end of civil twilight, the limb and the ground from above among them.
struct ScatteringCase {
  std::string name;
  ScatteringRay ray;
};
std::vector<ScatteringCase> scattering_cases();

/// As many looks again, drawn by lot and never used to choose how the model is computed: from the ground to
/// high orbit, at the sky, the limb and the ground, the sun from 8 degrees below the level of what is looked
/// at to overhead, half of them within 8 degrees of it.
std::vector<ScatteringCase> drawn_scattering_cases();

/// The light of the former and the latter, as globe_scattering_reference computed it
/// (tests/bench/air/scattering_reference.cpp).
std::vector<ScatteredLight> scattering_values();
std::vector<ScatteredLight> drawn_scattering_values();

}  // namespace app::accuracy
