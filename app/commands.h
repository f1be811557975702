#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace app {

/// Adds every sub-command to the program. Each lives in a file of its own name; its callback does the work
/// and throws globe::Error on failure. Commands that answer record by record set `exit_status` to 1 when some
/// records failed.
void add_commands(CLI::App& program, int& exit_status);

std::string version();

void add_fly(CLI::App& program);
void add_shot(CLI::App& program);

}  // namespace app
