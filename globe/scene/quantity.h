#pragma once

#include <optional>
#include <string>

namespace globe::scene {

/// Numbers with a unit, "120 km" or "15deg", in the unit named; nothing for any other text. The number may be
/// infinite or NaN.
///
/// Units: m (also without one), km, ft, mi, nmi; deg, arcmin, arcsec; s, min, h, d.
std::optional<double> parse_metres(const std::string& text);
std::optional<double> parse_degrees(const std::string& text);
std::optional<double> parse_seconds(const std::string& text);

/// A whole word as a number, whatever the locale, spaces around it passed over.
std::optional<double> parse_plain(const std::string& text);

}  // namespace globe::scene
