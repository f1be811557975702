#pragma once

#include <memory>
#include <string>

#include "globe/planet/surface.h"

namespace app {

/// Opens PLANET: `procedural[:SEED]` or a folder made by `globe convert`. Throws globe::Error or UsageError.
std::shared_ptr<const globe::planet::Surface> open_planet(const std::string& planet);

}  // namespace app
