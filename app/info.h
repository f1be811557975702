#pragma once

#include <CLI/CLI.hpp>

namespace app {

/// `globe info`: what a planet is made of.
void add_info(CLI::App& program, int& exit_status);

}  // namespace app
