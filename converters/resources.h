#pragma once

#include <cstddef>

namespace converters {

/// Of a memory cap: what the program takes before it holds any map or ground (seen 140 MB, its libraries),
/// decoders and windows.
inline constexpr std::size_t kReservedBytes = std::size_t{176} << 20;

/// The cap asked for; 0: half the machine's memory.
std::size_t memory_cap(std::size_t asked_bytes);

/// The threads asked for; 0: one for each core.
int thread_count(int asked);

}  // namespace converters
