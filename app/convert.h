#pragma once

#include <CLI/CLI.hpp>

namespace app {

/// `globe convert`: maps of a whole planet to a planet folder.
void add_convert(CLI::App& program, int& exit_status);

}  // namespace app
