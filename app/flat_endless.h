#pragma once

#include <CLI/CLI.hpp>

namespace app {

/// Adds `endless` to the command `flat`.
void add_flat_endless(CLI::App& flat);

}  // namespace app
