#pragma once

#include <string>
#include <string_view>

namespace app {

/// A text as gnuplot takes it, in single quotes: nothing in it is special but the quote, which is doubled;
/// control characters are left out.
std::string gnuplot_literal(std::string_view text);

/// Runs commands. Throws globe::Error where gnuplot is not installed or fails; `remedy` says what to do.
void run_gnuplot(std::string_view commands, const std::string& remedy);

}  // namespace app
