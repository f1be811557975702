#pragma once

#include <filesystem>
#include <memory>

#include "tests/bench/search/points.h"

namespace bench {

/// SQLite's R*Tree of latitudes and longitudes, the exact places and names in its auxiliary columns.
void build_rtree(const std::filesystem::path& path, std::uint64_t count);
std::unique_ptr<Finder> open_rtree(const std::filesystem::path& path);

}  // namespace bench
