#pragma once

#include <stdexcept>
#include <string>

namespace globe {

/// A failure the person at the terminal has to hear of: bad input, a missing file, no graphics.
///
/// `what()` is one line, "WHAT: WHY; WHAT TO DO". Only app/ prints it ("globe: " in front) and picks the exit
/// code: 1 for Error, 2 for UsageError. Broken invariants inside the code are asserts, expected absence is
/// std::optional.
class Error : public std::runtime_error {
 public:
  Error(const std::string& what, const std::string& why, const std::string& what_to_do)
      : std::runtime_error(what + ": " + why + "; " + what_to_do) {}
};

/// A command line that cannot be understood (exit code 2).
class UsageError : public Error {
 public:
  using Error::Error;
};

}  // namespace globe
