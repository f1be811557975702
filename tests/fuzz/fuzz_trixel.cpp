#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "globe/htm/trixel.h"

/// A name or an id is refused, or names a trixel that gives it back.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace globe::htm;
  if (const auto trixel = trixel_from_name({reinterpret_cast<const char*>(data), size})) {
    if (trixel_from_name(name(*trixel)) != trixel || level(*trixel) > kMaxLevel) std::abort();
    if (trixel_at(center(*trixel), level(*trixel)) != *trixel) std::abort();
  }
  std::uint64_t id = 0;
  if (size < sizeof id) return 0;
  std::memcpy(&id, data, sizeof id);
  if (const auto trixel = trixel_from_id(id)) {
    if (trixel_from_name(name(*trixel)) != trixel) std::abort();
    for (const Trixel& neighbor : neighbors(*trixel)) {
      if (!trixel_from_id(neighbor.id) || level(neighbor) != level(*trixel)) std::abort();
    }
  }
  return 0;
}
