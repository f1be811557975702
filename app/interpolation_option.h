#pragma once

#include <CLI/CLI.hpp>

#include "globe/planet/interpolation.h"

namespace app {

/// Adds --interpolation nearest|linear|cubic, as `height` and `lookup` take it. The default is what
/// `interpolation` holds.
CLI::Option* add_interpolation_option(CLI::App& command, globe::planet::Interpolation& interpolation);

}  // namespace app
