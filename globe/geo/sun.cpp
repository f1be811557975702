#include "globe/geo/sun.h"

#include <erfa.h>

#include <glm/geometric.hpp>

#include "globe/base/error.h"
#include "globe/geo/ellipsoid.h"

namespace globe::geo {

glm::dvec3 sun_direction(const std::string& iso8601) { return sun_direction(parse_utc(iso8601, "--time")); }

glm::dvec3 sun_direction(const UtcDate& utc) {
  double tai1 = 0, tai2 = 0, tt1 = 0, tt2 = 0;
  if (eraUtctai(utc.day, utc.rest, &tai1, &tai2) < 0 || eraTaitt(tai1, tai2, &tt1, &tt2) < 0)
    throw UsageError("the sun's date", "out of range", "give one between the years 1 and 9999");
  double helio[2][3], bary[2][3];
  eraEpv00(tt1, tt2, helio, bary);
  // Aberration and light time together: the sun is seen where it stood relative to the Earth's velocity now.
  constexpr double kLightDaysPerAu = 0.0057755183;
  const glm::dvec3 earth{helio[0][0], helio[0][1], helio[0][2]};
  const glm::dvec3 velocity{bary[1][0], bary[1][1], bary[1][2]};  // au a day
  const glm::dvec3 seen = glm::normalize(-earth + velocity * (kLightDaysPerAu * glm::length(earth)));
  double to_terrestrial[3][3];
  eraC2t06a(tt1, tt2, utc.day, utc.rest, 0.0, 0.0, to_terrestrial);
  const auto row = [&](int k) {
    return glm::dot(glm::dvec3(to_terrestrial[k][0], to_terrestrial[k][1], to_terrestrial[k][2]), seen);
  };
  return glm::normalize(glm::dvec3(row(0), row(1), row(2)));
}

glm::dvec3 morning_sun(double lon_deg) { return normal_from_degrees(0.0, lon_deg + 30.0); }

}  // namespace globe::geo
