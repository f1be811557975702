#include "globe/search/folded_name.h"

#include <unicase.h>
#include <uninorm.h>

#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>

namespace globe::search {

std::string folded_name(std::string_view name) {
  bool plain = true;
  std::string folded(name);
  for (char& c : folded) {
    plain = plain && static_cast<unsigned char>(c) < 0x80;
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (plain) return folded;
  std::size_t length = 0;
  const std::unique_ptr<std::uint8_t, decltype(&std::free)> text(
      u8_casefold(reinterpret_cast<const std::uint8_t*>(name.data()), name.size(), nullptr, UNINORM_NFC,
                  nullptr, &length),
      &std::free);
  if (!text) throw std::bad_alloc();
  return {reinterpret_cast<const char*>(text.get()), length};
}

}  // namespace globe::search
