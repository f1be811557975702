#pragma once

#include <string>
#include <string_view>

namespace globe {

/// A text from outside as a message may show it: in one line, nothing that a terminal would act on, and at
/// most so many bytes of it.
inline std::string one_line(std::string_view text, std::size_t most = 200) {
  std::string line;
  for (const char c : text.substr(0, most))
    line += static_cast<unsigned char>(c) < ' ' || c == 0x7f ? ' ' : c;
  return text.size() > most ? line + "..." : line;
}

}  // namespace globe
