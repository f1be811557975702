#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "converters/raster_source.h"
#include "globe/geo/ellipsoid.h"

namespace app {

/// A whole word as a number, whatever the locale; nothing when it is not one.
std::optional<double> parse_number(const std::string& text);

/// Finite numbers with a separator between them; empty when any word is none.
std::vector<double> parse_numbers(const std::string& text, char separator);

/// Takes finite numbers from `low` to `high`, both included. CLI::Range lets "nan" pass.
CLI::Validator in_range(double low, double high);

/// "wgs84", "moon", "mars" or "A,F" (F also as 1/298.257). Throws globe::UsageError.
globe::geo::Ellipsoid parse_ellipsoid(const std::string& text);

/// "W,S,E,N" in degrees. Throws globe::UsageError.
converters::Extent parse_extent(const std::string& text);

}  // namespace app
