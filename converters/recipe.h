#pragma once

#include <string>

#include "converters/convert.h"

namespace converters {

/// Everything that the bytes of a planet depend on, as JSON: options that shape them, and the maps by path,
/// size and time of change. Two conversions with equal recipes may finish one another.
std::string recipe_of(const ConvertOptions& options);

}  // namespace converters
