#pragma once

#include <string>
#include <string_view>

namespace globe::search {

/// A name as it is compared: Unicode's full case folding, then composed (NFC), so that Österreich, ÖSTERREICH
/// and O + combining diaeresis are one, and straße is STRASSE. Bytes that are not UTF-8 become
/// U+FFFD.
std::string folded_name(std::string_view name);

}  // namespace globe::search
