#pragma once

#include <CLI/CLI.hpp>

namespace app {

/// `globe inset`: lays finer local data over a planet.
void add_inset(CLI::App& program);

}  // namespace app
