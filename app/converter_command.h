#pragma once

#include <string>

#include "app/progress.h"
#include "converters/convert.h"

namespace app {

/// What a converter tells, on standard error: warnings, notes unless `quiet`, and the bar, which outlives it.
converters::ConvertListener listener_of(Progress& progress, bool quiet);

/// One of "nearest", "bilinear", "bicubic", "area".
converters::Filter filter_named(const std::string& name);

}  // namespace app
