#include "app/parse_options.h"

#include <charconv>
#include <cmath>
#include <cstdio>

#include "globe/base/error.h"

namespace app {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == separator) {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

std::optional<double> parse_ratio(const std::string& text) {
  const std::vector<std::string> parts = split(text, '/');
  if (parts.size() == 1) return parse_number(text);
  const std::optional<double> over = parse_number(parts[0]);
  const std::optional<double> under = parse_number(parts[1]);
  if (parts.size() != 2 || !over || !under || *under == 0.0) return std::nullopt;
  return *over / *under;
}

}  // namespace

std::optional<double> parse_number(const std::string& text) {
  const std::size_t start = !text.empty() && text[0] == '+' ? 1 : 0;
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + start, end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

std::vector<double> parse_numbers(const std::string& text, char separator) {
  std::vector<double> numbers;
  for (const std::string& part : split(text, separator)) {
    const std::optional<double> value = parse_number(part);
    if (!value || !std::isfinite(*value)) return {};
    numbers.push_back(*value);
  }
  return numbers;
}

CLI::Validator in_range(double low, double high) {
  const auto check = [low, high](const std::string& text) {
    const std::optional<double> value = parse_number(text);
    if (value && *value >= low && *value <= high) return std::string();
    char reason[160];
    std::snprintf(reason, sizeof reason, "'%.60s' is not a number from %g to %g", text.c_str(), low, high);
    return std::string(reason);
  };
  char range[64];
  std::snprintf(range, sizeof range, "[%g - %g]", low, high);
  return CLI::Validator(check, range);
}

globe::geo::Ellipsoid parse_ellipsoid(const std::string& text) {
  if (text == "wgs84") return globe::geo::kWgs84;
  if (text == "moon") return globe::geo::kMoon;
  if (text == "mars") return globe::geo::kMars;
  const std::vector<std::string> parts = split(text, ',');
  const std::optional<double> a = parse_number(parts[0]);
  const std::optional<double> f = parts.size() == 2 ? parse_ratio(parts[1]) : std::nullopt;
  if (!a || !f) {
    throw globe::UsageError("--ellipsoid", "'" + text + "' is not an ellipsoid",
                            "give wgs84, moon, mars or A,F such as 6378137,1/298.257223563");
  }
  return globe::geo::make_ellipsoid(*a, *f);
}

converters::Extent parse_extent(const std::string& text) {
  const std::vector<double> numbers = parse_numbers(text, ',');
  if (numbers.size() != 4 || numbers[0] >= numbers[2] || numbers[1] >= numbers[3]) {
    throw globe::UsageError("--extent", "'" + text + "' is not W,S,E,N with W < E and S < N",
                            "give degrees such as 0,-90,360,90");
  }
  return {numbers[0], numbers[1], numbers[2], numbers[3]};
}

}  // namespace app
