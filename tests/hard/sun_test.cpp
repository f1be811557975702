// H21: the sun's place, against a formula of another make.

#include "globe/geo/sun.h"
#include "globe/base/angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <random>

#include "globe/geo/ellipsoid.h"
#include "tests/hard/table.h"

namespace {

using globe::kDegree;

using glm::dvec3;

constexpr double kSunError = 0.01;  ///< degrees; HARD-CASES H21

/// Days from 2000-01-01T12:00 to a UTC date of the Gregorian calendar (Fliegel and Van Flandern 1968).
double days_since_2000(int year, int month, int day, double hours) {
  const int a = (month - 14) / 12;
  const int jdn = 1461 * (year + 4800 + a) / 4 + 367 * (month - 2 - 12 * a) / 12 -
                  3 * ((year + 4900 + a) / 100) / 4 + day - 32075;
  return jdn - 2451545 + (hours - 12.0) / 24.0;
}

/// TT - UTC in days, to a few seconds.
double dynamical_lead(int year) { return (32.0 + std::clamp((year - 1960) * 0.75, 0.0, 37.0)) / 86400.0; }

/// The sun by Meeus, Astronomical Algorithms, chapter 25 (low accuracy, 0.01 degrees) with the aberration and
/// nutation terms given there and the perturbations by Venus, Jupiter and the Moon of his Astronomical
/// Formulae for Calculators, chapter 18; turned by the sidereal time of chapter 12.
dvec3 meeus_sun(int year, int month, int day, double hours) {
  const double d = days_since_2000(year, month, day, hours);
  const double t = (d + dynamical_lead(year)) / 36525.0;
  const double mean_longitude = 280.46646 + 36000.76983 * t + 0.0003032 * t * t;
  const double anomaly = (357.52911 + 35999.05029 * t - 0.0001537 * t * t) * kDegree;
  const double centre = (1.914602 - 0.004817 * t - 0.000014 * t * t) * std::sin(anomaly) +
                        (0.019993 - 0.000101 * t) * std::sin(2 * anomaly) + 0.000289 * std::sin(3 * anomaly);
  const double node = (125.04 - 1934.136 * t) * kDegree;
  const double t1900 = t + 1.0;
  const double perturbed = 0.00134 * std::cos((153.23 + 22518.7541 * t1900) * kDegree) +
                           0.00154 * std::cos((216.57 + 45037.5082 * t1900) * kDegree) +
                           0.00200 * std::cos((312.69 + 32964.3577 * t1900) * kDegree) +
                           0.00179 * std::sin((350.74 + 445267.1142 * t1900) * kDegree);
  const double longitude =
      (mean_longitude + centre + perturbed - 0.00569 - 0.00478 * std::sin(node)) * kDegree;
  const double obliquity = (23.4392911 - 0.0130042 * t + 0.00256 * std::cos(node)) * kDegree;
  const double nutation_in_right_ascension = -0.00478 * std::sin(node) * std::cos(obliquity);
  const double sidereal =
      (280.46061837 + 360.98564736629 * d + 0.000387933 * t * t + nutation_in_right_ascension) * kDegree;
  const dvec3 sky{std::cos(longitude), std::sin(longitude) * std::cos(obliquity),
                  std::sin(longitude) * std::sin(obliquity)};
  return {sky.x * std::cos(sidereal) + sky.y * std::sin(sidereal),
          sky.y * std::cos(sidereal) - sky.x * std::sin(sidereal), sky.z};
}

double degrees_apart(const dvec3& a, const dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) / kDegree;
}

std::string iso(int year, int month, int day, int hour, int minute, double second) {
  char text[48];
  std::snprintf(text, sizeof text, "%04d-%02d-%02dT%02d:%02d:%06.3f", year, month, day, hour, minute, second);
  return text;
}

TEST(H21, TheSunStandsWhereMeeusPutsIt) {
  std::mt19937_64 random(21);
  double worst = 0;
  const std::size_t size = hard::full() ? 10'000 : 2'000;
  for (std::size_t k = 0; k < size; ++k) {
    const int year = 1960 + static_cast<int>(random() % 91), month = 1 + static_cast<int>(random() % 12),
              day = 1 + static_cast<int>(random() % 28), hour = static_cast<int>(random() % 24),
              minute = static_cast<int>(random() % 60), second = static_cast<int>(random() % 60);
    worst =
        std::max(worst, degrees_apart(globe::geo::sun_direction(iso(year, month, day, hour, minute, second)),
                                      meeus_sun(year, month, day, hour + minute / 60.0 + second / 3600.0)));
  }
  hard::report("H21", "sun against Meeus, chapter 25, dates 1960-2050, " + std::to_string(size),
               "0.01 degrees", hard::figure(worst) + " degrees");
  EXPECT_LE(worst, kSunError);
}

TEST(H21, TheSunDoesNotJumpOverMidnightNewYearOrALeapSecond) {
  struct Moment {
    const char* before;
    const char* after;
    double seconds;
  };
  constexpr double kTurn = 360.0 / 86400.0;  // degrees of hour angle a second
  double worst = 0;
  for (const Moment& m : {Moment{"2024-03-20T23:59:59", "2024-03-21T00:00:01", 2},
                          {"2023-12-31T23:59:59", "2024-01-01T00:00:01", 2},
                          {"2024-02-28T23:59:59", "2024-02-29T00:00:01", 2},
                          {"2024-02-29T23:59:59", "2024-03-01T00:00:01", 2},
                          {"2049-12-31T23:59:59.5", "2050-01-01T00:00:00.5", 1}}) {
    const double apart =
        degrees_apart(globe::geo::sun_direction(m.before), globe::geo::sun_direction(m.after));
    const double at_declination = std::sqrt(1.0 - std::pow(globe::geo::sun_direction(m.before).z, 2));
    worst = std::max(worst, std::abs(apart - m.seconds * kTurn * at_declination));
  }
  // A leap second lasts as long as any other, but UT1 = UTC takes its turn back: at most one second's turn.
  double leap = 0;
  for (const char* day : {"2016-12-31", "2015-06-30", "1998-12-31", "1972-06-30"}) {
    const std::string date = day;
    const dvec3 before = globe::geo::sun_direction(date + "T23:59:59");
    const dvec3 during = globe::geo::sun_direction(date + "T23:59:60");
    const dvec3 later = globe::geo::sun_direction(date + "T23:59:60.5");
    leap = std::max({leap, degrees_apart(before, during), degrees_apart(during, later)});
  }
  hard::report("H21", "jump of the sun over midnight, year's end, leap day", "1e-5 degrees",
               hard::figure(worst) + " degrees");
  hard::report("H21", "motion over a leap second", "1.01 s of turn, 0.0042 degrees",
               hard::figure(leap) + " degrees");
  EXPECT_LE(worst, 1e-5);
  EXPECT_LE(leap, 1.01 * kTurn);
}

TEST(H21, NegativeControlAMinuteIsSeen) {
  EXPECT_GT(degrees_apart(globe::geo::sun_direction("2020-05-05T10:01"), meeus_sun(2020, 5, 5, 10.0)),
            kSunError);
}

}  // namespace
