#pragma once

#include <cstdint>

namespace globe::flat::fractal {

/// Random numbers that belong to posts: integer hashes, so that a post has the same number on every machine,
/// whoever asks and however often.
///
/// The key of Christopoulos, 7xz + 5x + 9z + variation, is none: 7 key + 45 = (7x + 9)(7z + 5), so that posts
/// share keys (22 % of 512x512 are lost), and along a row it is linear.

/// Well-mixed 64 bits. Source: Steele, Lea and Flood 2014, with Stafford's "Mix13" constants (SplitMix64).
constexpr std::uint64_t mixed(std::uint64_t h) {
  h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
  h = (h ^ (h >> 27)) * 0x94d049bb133111ebu;
  return h ^ (h >> 31);
}

/// The key of a row of posts, from which post_hash goes on.
constexpr std::uint64_t row_key(std::uint64_t seed, int depth, std::int64_t j) {
  constexpr std::uint64_t kGolden = 0x9e3779b97f4a7c15u;
  const std::uint64_t depth_key = mixed(seed + kGolden * (static_cast<std::uint64_t>(depth) + 1));
  return mixed(depth_key ^ (static_cast<std::uint64_t>(j) * 0xd1342543de82ef95u));
}

constexpr std::uint64_t post_hash(std::uint64_t row, std::int64_t i) {
  return mixed(row + static_cast<std::uint64_t>(i) * 0x9e3779b97f4a7c15u);
}

/// A nearly normal variate of mean 0 and deviation 1 from a hash, within kLargestVariate: the sum of its four
/// 16-bit parts, so one integer made a float once and scaled once, the same bits wherever floats are IEEE's.
inline constexpr float kLargestVariate = 3.4641f;  // 2 sqrt(3), rounded up
constexpr float variate(std::uint64_t hash) {
  const auto sum =
      static_cast<int>((hash & 0xffffu) + ((hash >> 16) & 0xffffu) + ((hash >> 32) & 0xffffu) + (hash >> 48));
  constexpr float kScale = 1.0f / 37837.227f;  // 65536 sqrt(4 / 12), the deviation of such a sum
  return static_cast<float>(sum - 131070) * kScale;
}

}  // namespace globe::flat::fractal
