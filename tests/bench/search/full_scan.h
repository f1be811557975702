#pragma once

#include <filesystem>
#include <memory>

#include "tests/bench/search/points.h"

namespace bench {

/// A plain table, every row of which is looked at.
void build_table(const std::filesystem::path& path, std::uint64_t count);
std::unique_ptr<Finder> open_table(const std::filesystem::path& path);

}  // namespace bench
