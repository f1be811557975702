#pragma once

#include <string>
#include <vector>

#include "app/accuracy/scattering_reference.h"

namespace app::accuracy {

/// Looks through the air of the default model whose light is known: from the ground, the air and space, from
/// noon to the end of civil twilight, the limb and the ground from above among them.
struct ScatteringCase {
  std::string name;
  ScatteringRay ray;
};
std::vector<ScatteringCase> scattering_cases();

/// Their light as globe_scattering_reference computed it (tests/bench/air/scattering_reference.cpp).
std::vector<ScatteredLight> scattering_values();

}  // namespace app::accuracy
