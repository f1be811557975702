#pragma once

#include <cstdio>
#include <string>

namespace converters {

/// A number as people write it, ten digits at most.
inline std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

}  // namespace converters
