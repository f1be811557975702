#include "globe/htm/exact_sum.h"

#include <cassert>
#include <cmath>

namespace globe::htm {
namespace {

__extension__ using uint128 = unsigned __int128;

/// value = mantissa * 2^exponent, the mantissa a 53-bit integer.
struct Parts {
  std::uint64_t mantissa;
  int exponent;
};

Parts parts_of(double magnitude) {
  int exponent = 0;
  const double fraction = std::frexp(magnitude, &exponent);
  return {static_cast<std::uint64_t>(std::ldexp(fraction, 53)), exponent - 53};
}

std::uint64_t low(uint128 x) { return static_cast<std::uint64_t>(x); }
std::uint64_t high(uint128 x) { return static_cast<std::uint64_t>(x >> 64); }

/// The 159-bit product of three 53-bit integers, least significant word first, shifted up by 0 to 63 bits.
std::array<std::uint64_t, 4> product(std::uint64_t a, std::uint64_t b, std::uint64_t c, int shift) {
  const uint128 ab = uint128{a} * b;
  const uint128 p0 = uint128{low(ab)} * c;
  const uint128 p1 = uint128{high(ab)} * c + high(p0);
  const std::array<std::uint64_t, 3> p{low(p0), low(p1), high(p1)};
  if (shift == 0) return {p[0], p[1], p[2], 0};
  const int back = 64 - shift;
  return {p[0] << shift, p[1] << shift | p[0] >> back, p[2] << shift | p[1] >> back, p[2] >> back};
}

}  // namespace

void ExactSum::add(double a, double b, double c) {
  if (a == 0.0 || b == 0.0 || c == 0.0) return;
  const Parts x = parts_of(std::abs(a));
  const Parts y = parts_of(std::abs(b));
  const Parts z = parts_of(std::abs(c));
  const int place = x.exponent + y.exponent + z.exponent - kExponentOfBit0;
  assert(place >= 0 && place < 64 * static_cast<int>(kWords - 4));
  const auto terms = product(x.mantissa, y.mantissa, z.mantissa, place % 64);
  const auto first = static_cast<std::size_t>(place / 64);
  const bool subtract = (std::signbit(a) != std::signbit(b)) != std::signbit(c);
  std::uint64_t carry = 0;  // or borrow
  for (std::size_t k = first; k < kWords; ++k) {
    const bool in_terms = k - first < terms.size();
    if (!in_terms && carry == 0) break;
    const uint128 term = uint128{in_terms ? terms[k - first] : 0} + carry;
    const uint128 result = subtract ? uint128{words_[k]} - term : uint128{words_[k]} + term;
    words_[k] = low(result);
    carry = high(result) == 0 ? 0 : 1;
  }
}

int ExactSum::sign() const {
  if (words_.back() >> 63 != 0) return -1;
  for (const std::uint64_t word : words_) {
    if (word != 0) return 1;
  }
  return 0;
}

}  // namespace globe::htm
