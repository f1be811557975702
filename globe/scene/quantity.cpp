#include "globe/scene/quantity.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <string_view>

#include "globe/base/error.h"
#include "globe/geo/point.h"

namespace globe::scene {
namespace {

struct Unit {
  std::string_view name;
  double size;
};

constexpr std::array<Unit, 3> kAngles{{{"deg", 1.0}, {"arcmin", 1.0 / 60.0}, {"arcsec", 1.0 / 3600.0}}};
constexpr std::array<Unit, 4> kTimes{{{"s", 1.0}, {"min", 60.0}, {"h", 3600.0}, {"d", 86400.0}}};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) + 1 - first);
}

std::optional<double> number_of(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<double> with_unit(std::string_view text, std::span<const Unit> units) {
  text = trimmed(text);
  const std::size_t digits = text.find_last_of("0123456789.") + 1;
  const std::string_view name = trimmed(text.substr(digits));
  const auto unit =
      std::find_if(units.begin(), units.end(), [&](const Unit& known) { return known.name == name; });
  const auto number = number_of(text.substr(0, digits));
  if (!number || unit == units.end()) return std::nullopt;
  return *number * unit->size;
}

}  // namespace

std::optional<double> parse_metres(const std::string& text) {
  try {
    return geo::parse_length_m(trimmed(text));
  } catch (const UsageError&) {
    return std::nullopt;
  }
}
std::optional<double> parse_degrees(const std::string& text) { return with_unit(text, kAngles); }
std::optional<double> parse_seconds(const std::string& text) { return with_unit(text, kTimes); }
std::optional<double> parse_plain(const std::string& text) { return number_of(text); }

}  // namespace globe::scene
