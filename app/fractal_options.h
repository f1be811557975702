#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "flat/fractal/settings.h"

namespace app {

/// The seed that "fractal" or "fractal:SEED" names, for `globe flat`; nothing for other words. Throws
/// UsageError for a seed that is none.
std::optional<std::uint64_t> fractal_seed(const std::string& word);

/// How fractal ground is made, as it is written.
struct FractalOptions {
  globe::flat::fractal::Settings settings;
  std::string method{globe::flat::fractal::name_of(settings.method)};
};

void add_fractal_options(CLI::App& command, FractalOptions& options);

/// The settings for a word that fractal_seed takes. Throws UsageError.
globe::flat::fractal::Settings fractal_settings(const FractalOptions& options, const std::string& word);

}  // namespace app
