#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace app {

/// Adds every sub-command to the program. Each lives in a file of its own name; its callback does the work
/// and throws globe::Error on failure. Commands that answer record by record set `exit_status` to 1 when some
/// records failed.
void add_commands(CLI::App& program, int& exit_status);

void add_lookup(CLI::App& program, int& exit_status);
void add_height(CLI::App& program, int& exit_status);
void add_trixel(CLI::App& program, int& exit_status);
void add_distance(CLI::App& program, int& exit_status);
void add_index(CLI::App& program, int& exit_status);
void add_sight(CLI::App& program, int& exit_status);

/// The words after the program's name, last first, as CLI::App::parse takes them. A word such as "-.5,12",
/// which CLI11 would take for an option (it knows a minus and a digit), becomes "-0.5,12".
std::vector<std::string> arguments(int argc, const char* const* argv);

std::string version();

void add_accuracy(CLI::App& program);
void add_bench(CLI::App& program);
void add_cover(CLI::App& program);
void add_explain(CLI::App& program);
void add_export(CLI::App& program);
void add_find(CLI::App& program);
void add_flat(CLI::App& program);
/// `globe flat view`.
void add_flat_view(CLI::App& flat);
void add_fly(CLI::App& program);
void add_pick(CLI::App& program, int& exit_status);
void add_profile(CLI::App& program);
void add_shot(CLI::App& program);
void add_summary(CLI::App& program);
void add_tune(CLI::App& program);
void add_view(CLI::App& program);

}  // namespace app
