#include "globe/geo/point.h"

#include <GeographicLib/DMS.hpp>
#include <GeographicLib/MGRS.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "globe/base/error.h"

namespace globe::geo {
namespace {

using GeographicLib::DMS;
using globe::UsageError;

constexpr const char* kHowToWrite =
    "write LAT LON [ALT], degrees-minutes-seconds, UTM (33N 500000 4000000) or MGRS (33TWN8000090000)";

struct Unit {
  std::string_view name;
  double metres;
};
constexpr std::array<Unit, 5> kUnits{
    {{"m", 1.0}, {"km", 1000.0}, {"ft", 0.3048}, {"mi", 1609.344}, {"nmi", 1852.0}}};

std::string in_quotes(std::string_view text) { return "'" + std::string(text) + "'"; }

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return c >= 'A' && c <= 'Z'; }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// The value of a word that is a number from end to end, whatever the locale. May be infinite or NaN.
std::optional<double> plain_number(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range)
    throw UsageError(in_quotes(word), "is out of the range of numbers", "write degrees");
  return value;
}

/// Words between spaces and commas; a comma must have something on both sides.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  bool after_comma = false, in_word = false;
  for (const char c : text) {
    if (c == ',' || is_space(c)) {
      if (c == ',' && (words.empty() || after_comma))
        throw UsageError("point " + in_quotes(text), "a field is empty", kHowToWrite);
      after_comma = after_comma || c == ',';
      in_word = false;
      continue;
    }
    if (!in_word) words.emplace_back();
    in_word = true;
    after_comma = false;
    words.back() += c;
  }
  if (after_comma) throw UsageError("point " + in_quotes(text), "a field is empty", kHowToWrite);
  return words;
}

/// The words as one MGRS reference, if that is what they look like: zone and band (or A, B, Y, Z by the
/// poles), two letters, an easting and a northing of as many digits. A space between digits must be in their
/// middle.
std::optional<std::string> mgrs_of(const std::vector<std::string>& words) {
  std::string joined;
  std::size_t last_space = 0;
  for (const std::string& word : words) {
    last_space = joined.size();
    joined += word;
  }
  std::transform(joined.begin(), joined.end(), joined.begin(), upper);
  const std::size_t band = std::min(joined.find_first_not_of("0123456789"), std::size_t{3});
  const std::size_t digits = joined.find_last_not_of("0123456789") + 1;
  if (band > 2 || digits != band + 3 || !std::all_of(joined.data() + band, joined.data() + digits, is_letter))
    return std::nullopt;
  if (band == 0 && std::string_view("ABYZ").find(joined[0]) == std::string_view::npos) return std::nullopt;
  const std::size_t count = joined.size() - digits;
  if (count == 0 || (last_space > digits && last_space != digits + count / 2)) return std::nullopt;
  return joined;
}

/// 33N, 33south, n, south: a zone of UTM or UPS.
bool is_zone(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(), upper);
  std::size_t k = 0;
  while (k < word.size() && k < 2 && is_digit(word[k])) ++k;
  const std::string hemisphere = word.substr(k);
  return hemisphere == "N" || hemisphere == "S" || hemisphere == "NORTH" || hemisphere == "SOUTH";
}

struct Angle {
  double degrees = 0;
  DMS::flag kind = DMS::NONE;  ///< LATITUDE with N or S, LONGITUDE with E or W
};

Angle angle_of(const std::string& word) {
  if (const auto value = plain_number(word)) return {*value, DMS::NONE};
  // A number with a letter at one end: read here too, for the exponents.
  for (const bool at_end : {true, false}) {
    const char letter = upper(at_end ? word.back() : word.front());
    const auto which = std::string_view("NSEW").find(letter);
    if (which == std::string_view::npos) continue;
    const std::string_view rest = std::string_view(word).substr(at_end ? 0 : 1, word.size() - 1);
    if (rest.empty() || !(is_digit(rest.back()) || rest.back() == '.')) continue;
    if (const auto value = plain_number(rest))
      return {letter == 'S' || letter == 'W' ? -*value : *value, which < 2 ? DMS::LATITUDE : DMS::LONGITUDE};
  }
  for (std::size_t k = 1; k + 1 < word.size(); ++k) {
    if (upper(word[k]) == 'E')
      throw UsageError("angle " + in_quotes(word), "has an E in the middle",
                       "use exponents with plain numbers only");
  }
  Angle angle;
  angle.degrees = DMS::Decode(word, angle.kind);
  return angle;
}

Point checked(double lat_deg, double lon_deg) {
  if (!std::isfinite(lat_deg) || !std::isfinite(lon_deg))
    throw UsageError("point", "a coordinate is not a finite number", kHowToWrite);
  if (std::abs(lat_deg) > 90.0) {
    std::array<char, 32> number{};
    const auto end = std::to_chars(number.data(), number.data() + number.size(), lat_deg).ptr;
    throw UsageError("latitude " + std::string(number.data(), end), "is beyond 90 degrees",
                     "write latitude first");
  }
  double lon = std::remainder(lon_deg, 360.0);  // exact
  if (lon >= 180.0) lon -= 360.0;
  return {{lat_deg + 0.0, lon + 0.0, 0.0}, false};
}

Point point_from_angles(const std::vector<std::string>& words) {
  Angle a = angle_of(words[0]);
  Angle b = angle_of(words[1]);
  if (a.kind != DMS::NONE && a.kind == b.kind)
    throw UsageError("point " + in_quotes(words[0] + " " + words[1]),
                     a.kind == DMS::LATITUDE ? "has two latitudes" : "has two longitudes", kHowToWrite);
  if (a.kind == DMS::LONGITUDE || b.kind == DMS::LATITUDE) std::swap(a, b);
  Point point = checked(a.degrees, b.degrees);
  if (words.size() == 3) {
    point.position.h_m = parse_length_m(words[2]);
    point.has_alt = true;
  }
  return point;
}

Point point_from_zone(int zone, bool north, double x, double y) {
  double lat = 0, lon = 0;
  GeographicLib::UTMUPS::Reverse(zone, north, x, y, lat, lon);
  return checked(lat, lon);
}

Point point_from_utm(const std::vector<std::string>& words) {
  int zone = 0;
  bool north = true;
  GeographicLib::UTMUPS::DecodeZone(words[0], zone, north);
  const auto x = plain_number(words[1]);
  const auto y = plain_number(words[2]);
  if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y))
    throw UsageError("UTM " + in_quotes(words[1] + " " + words[2]),
                     "is not an easting and a northing in metres", kHowToWrite);
  return point_from_zone(zone, north, *x, *y);
}

Point point_from_mgrs(const std::string& mgrs) {
  int zone = 0, precision = 0;
  bool north = true;
  double x = 0, y = 0;
  GeographicLib::MGRS::Reverse(mgrs, zone, north, x, y, precision);
  return point_from_zone(zone, north, x, y);
}

bool is_hemisphere(const std::string& word) {
  return word.size() == 1 && std::string_view("NSEW").find(upper(word[0])) != std::string_view::npos;
}

/// "10.25 N 20.5 E", "47° 7' 24\" N 11° 0' 0\" E" and "N 47.5 E 11.2" as two angles and what follows them; as
/// they are where there are not two such letters.
std::vector<std::string> with_letters_joined(const std::vector<std::string>& words) {
  const bool ahead = is_hemisphere(words.front());
  std::vector<std::string> angles;
  std::string angle;
  std::size_t k = 0;
  for (; k < words.size() && angles.size() < 2; ++k) {
    angle += words[k];
    if (is_hemisphere(words[k]) != ahead) angles.push_back(std::exchange(angle, {}));
  }
  const bool two = std::count_if(words.begin(), words.end(), is_hemisphere) == 2 && angles.size() == 2;
  if (!two) return words;
  angles.insert(angles.end(), words.begin() + static_cast<std::ptrdiff_t>(k), words.end());
  return angles;
}

bool is_unit(std::string_view word) {
  return std::any_of(kUnits.begin(), kUnits.end(), [&](const Unit& unit) { return unit.name == word; });
}

}  // namespace

double parse_length_m(std::string_view text) {
  const std::size_t digits = text.find_last_of("0123456789.") + 1;  // 0 when there is none
  std::string_view unit = text.substr(digits);
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  const auto known =
      std::find_if(kUnits.begin(), kUnits.end(), [&](const Unit& u) { return u.name == unit; });
  const auto value = plain_number(text.substr(0, digits));
  if (!value || (known == kUnits.end() && !unit.empty()))
    throw UsageError("length " + in_quotes(text), "is not a number of m, km, ft, mi or nmi",
                     "write 1200, 1.2km or 4000ft");
  return unit.empty() ? *value : *value * known->metres;
}

Point parse_point(std::string_view text) {
  std::vector<std::string> words = words_of(text);
  if (words.size() > 3 && is_unit(words.back())) {
    words[words.size() - 2] += words.back();
    words.pop_back();
  }
  try {
    if (words.size() == 2) {  // by far the most common, and no other notation is two plain numbers
      const auto lat = plain_number(words[0]), lon = plain_number(words[1]);
      if (lat && lon) return checked(*lat, *lon);
    }
    if (const auto mgrs = mgrs_of(words)) return point_from_mgrs(*mgrs);
    if (words.size() == 3 && is_zone(words[0]) && plain_number(words[1]) && plain_number(words[2]))
      return point_from_utm(words);
    if (words.size() > 3) words = with_letters_joined(words);
    if (words.size() == 2 || words.size() == 3) return point_from_angles(words);
  } catch (const GeographicLib::GeographicErr& error) {
    throw UsageError("point " + in_quotes(text), error.what(), kHowToWrite);
  }
  throw UsageError("point " + in_quotes(text), "is not a place", kHowToWrite);
}

}  // namespace globe::geo
