#pragma once

#include <vector>

#include "app/bench.h"

namespace app {

/// What `globe bench` knows of fractal ground.
std::vector<BenchmarkEntry> fractal_benchmarks();

}  // namespace app
