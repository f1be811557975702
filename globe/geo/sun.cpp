#include "globe/geo/sun.h"

#include <erfa.h>

#include <charconv>
#include <glm/geometric.hpp>
#include <optional>
#include <regex>

#include "globe/base/error.h"
#include "globe/geo/ellipsoid.h"

namespace globe::geo {
namespace {

struct UtcTime {
  int year, month, day, hour = 0, minute = 0;
  double second = 0;
  int offset_minutes = 0;
};

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw UsageError("--time " + text, why, "write it like 2026-03-21T10:00 or 2026-03-21T10:00:00+05:45");
}

template <typename T>
T number(const std::string& text) {
  T value{};
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

UtcTime parse(const std::string& text) {
  static const std::regex pattern(
      R"((\d{4})-(\d{2})-(\d{2})(?:[T ](\d{2}):(\d{2})(?::(\d{2}(?:\.\d+)?))?)?(Z|[+-]\d{2}:?\d{2})?)");
  std::smatch m;
  if (!std::regex_match(text, m, pattern)) refuse(text, "not an ISO 8601 date and time");
  UtcTime t{number<int>(m[1]), number<int>(m[2]), number<int>(m[3])};
  if (m[4].matched) t.hour = number<int>(m[4]);
  if (m[5].matched) t.minute = number<int>(m[5]);
  if (m[6].matched) t.second = number<double>(m[6]);
  if (m[7].matched && m[7].str() != "Z") {
    const std::string zone = m[7].str();
    const int sign = zone[0] == '-' ? -1 : 1;
    t.offset_minutes =
        sign * (number<int>(zone.substr(1, 2)) * 60 + number<int>(zone.substr(zone.size() - 2)));
  }
  if (t.hour > 23 || t.minute > 59 || t.second >= 61.0) refuse(text, "there is no such time of day");
  return t;
}

}  // namespace

glm::dvec3 sun_direction(const std::string& iso8601) {
  const UtcTime t = parse(iso8601);
  double utc1 = 0, utc2 = 0, tai1 = 0, tai2 = 0, tt1 = 0, tt2 = 0;
  if (eraDtf2d("UTC", t.year, t.month, t.day, t.hour, t.minute, t.second, &utc1, &utc2) < 0) {
    refuse(iso8601, "there is no such date");
  }
  utc2 -= t.offset_minutes / 1440.0;
  if (eraUtctai(utc1, utc2, &tai1, &tai2) < 0 || eraTaitt(tai1, tai2, &tt1, &tt2) < 0)
    refuse(iso8601, "out of range");
  double helio[2][3], bary[2][3];
  eraEpv00(tt1, tt2, helio, bary);
  // Aberration and light time together: the sun is seen where it stood relative to the Earth's velocity now.
  constexpr double kLightDaysPerAu = 0.0057755183;
  const glm::dvec3 earth{helio[0][0], helio[0][1], helio[0][2]};
  const glm::dvec3 velocity{bary[1][0], bary[1][1], bary[1][2]};  // au a day
  const glm::dvec3 seen = glm::normalize(-earth + velocity * (kLightDaysPerAu * glm::length(earth)));
  double to_terrestrial[3][3];
  eraC2t06a(tt1, tt2, utc1, utc2, 0.0, 0.0, to_terrestrial);
  const auto row = [&](int k) {
    return glm::dot(glm::dvec3(to_terrestrial[k][0], to_terrestrial[k][1], to_terrestrial[k][2]), seen);
  };
  return glm::normalize(glm::dvec3(row(0), row(1), row(2)));
}

glm::dvec3 morning_sun(double lon_deg) { return normal_from_degrees(0.0, lon_deg + 30.0); }

}  // namespace globe::geo
