#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace globe::planet {

/// What a look at everything in a planet found.
struct Verification {
  std::vector<std::string> damage;  ///< one line each, none when all is well
  std::uint64_t files = 0;          ///< whose checksums were compared
  std::uint64_t nodes = 0;          ///< whose values were looked at, of all layers and levels
};

/// Checks a planet folder, reading every byte and every sample once or twice, in blocks; the work is spread
/// over the threads of the calling TBB arena.
///
/// - planet.json is as it was written, and every file has the bytes it lists (XXH3 of the whole file).
/// - Every tile can be decoded, and holds nothing that is not finite.
/// - Nodes on a border have the same bits in both diamonds: every level of height, relief and color.
/// - A coarse height is the fine height of the same node.
/// - height_range holds the heights of its cells, height_mean lies within; the finest heights span what
///   planet.json says.
/// - The samples of insets: verify_insets.h.
///
/// @param progress  hears of the stage and the share done, from any thread, not at once
/// Throws Error when there is no planet to look at: see Dataset::open.
Verification verify_planet(const std::filesystem::path& folder, std::size_t cache_bytes,
                           const std::function<void(const std::string& stage, double fraction)>& progress);

}  // namespace globe::planet
