#include "globe/geo/utc.h"

#include <erfa.h>

#include <array>
#include <charconv>
#include <cstdio>
#include <regex>

#include "globe/base/error.h"

namespace globe::geo {
namespace {

constexpr double kSecondsADay = 86400.0;

[[noreturn]] void refuse(const std::string& what, const std::string& text, const std::string& why) {
  throw UsageError(what + " " + text, why, "write it like 2026-03-21T10:00 or 2026-03-21T10:00:00+05:45");
}

template <typename T>
T number(const std::string& text) {
  T value{};
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

}  // namespace

UtcDate parse_utc(const std::string& text, const std::string& what) {
  static const std::regex pattern(
      R"((\d{4})-(\d{2})-(\d{2})(?:[T ](\d{2}):(\d{2})(?::(\d{2}(?:\.\d{1,20})?))?)?(Z|[+-]\d{2}:?\d{2})?)");
  constexpr std::size_t kLongest = 64;
  std::smatch m;
  if (text.size() > kLongest || !std::regex_match(text, m, pattern))
    refuse(what, text.substr(0, kLongest), "not an ISO 8601 date and time");
  const int hour = m[4].matched ? number<int>(m[4]) : 0;
  const int minute = m[5].matched ? number<int>(m[5]) : 0;
  const double second = m[6].matched ? number<double>(m[6]) : 0.0;
  int offset_minutes = 0;
  if (m[7].matched && m[7].str() != "Z") {
    const std::string zone = m[7].str();
    const int sign = zone[0] == '-' ? -1 : 1;
    offset_minutes = sign * (number<int>(zone.substr(1, 2)) * 60 + number<int>(zone.substr(zone.size() - 2)));
  }
  if (hour > 23 || minute > 59 || second >= 61.0) refuse(what, text, "there is no such time of day");
  UtcDate date;
  if (eraDtf2d("UTC", number<int>(m[1]), number<int>(m[2]), number<int>(m[3]), hour, minute, second,
               &date.day, &date.rest) < 0) {
    refuse(what, text, "there is no such date");
  }
  date.rest -= offset_minutes / 1440.0;
  return date;
}

std::string iso8601(const UtcDate& date) {
  int year = 0, month = 0, day = 0;
  std::array<int, 4> time{};
  eraD2dtf("UTC", 0, date.day, date.rest, &year, &month, &day, time.data());
  char text[40];
  std::snprintf(text, sizeof text, "%04d-%02d-%02dT%02d:%02d:%02dZ", year, month, day, time[0], time[1],
                time[2]);
  return text;
}

double seconds_between(const UtcDate& from, const UtcDate& to) {
  return ((to.day - from.day) + (to.rest - from.rest)) * kSecondsADay;
}

UtcDate later_by(const UtcDate& date, double seconds) {
  return {date.day, date.rest + seconds / kSecondsADay};
}

}  // namespace globe::geo
