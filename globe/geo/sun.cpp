#include "globe/geo/sun.h"

#include <erfa.h>

#include <glm/geometric.hpp>

#include "globe/base/error.h"
#include "globe/geo/ellipsoid.h"

namespace globe::geo {
namespace {

struct TerrestrialTime {
  double day = 0, rest = 0;
};

TerrestrialTime terrestrial_time(const UtcDate& utc) {
  double tai1 = 0, tai2 = 0;
  TerrestrialTime time;
  if (eraUtctai(utc.day, utc.rest, &tai1, &tai2) < 0 || eraTaitt(tai1, tai2, &time.day, &time.rest) < 0)
    throw UsageError("the sun's date", "out of range", "give one between the years 1 and 9999");
  return time;
}

}  // namespace

glm::dvec3 sun_direction(const std::string& iso8601) { return sun_direction(parse_utc(iso8601, "--time")); }

glm::dvec3 sun_direction(const UtcDate& utc) {
  const TerrestrialTime time = terrestrial_time(utc);
  double helio[2][3], bary[2][3];
  eraEpv00(time.day, time.rest, helio, bary);
  // Aberration and light time together: the sun is seen where it stood relative to the Earth's velocity now.
  constexpr double kLightDaysPerAu = 0.0057755183;
  const glm::dvec3 earth{helio[0][0], helio[0][1], helio[0][2]};
  const glm::dvec3 velocity{bary[1][0], bary[1][1], bary[1][2]};  // au a day
  const glm::dvec3 seen = glm::normalize(-earth + velocity * (kLightDaysPerAu * glm::length(earth)));
  return glm::normalize(ecef_from_celestial(utc) * seen);
}

glm::dmat3 ecef_from_celestial(const UtcDate& utc) {
  const TerrestrialTime time = terrestrial_time(utc);
  double rows[3][3];
  eraC2t06a(time.day, time.rest, utc.day, utc.rest, 0.0, 0.0, rows);
  glm::dmat3 rotation;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) rotation[column][row] = rows[row][column];
  }
  return rotation;
}

glm::dvec3 morning_sun(double lon_deg) { return normal_from_degrees(0.0, lon_deg + 30.0); }

}  // namespace globe::geo
