#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "globe/geo/utc.h"

namespace globe::geo {

/// Unit vector from the Earth's centre toward the sun, Earth-fixed (ITRS, polar motion left out), at a UTC
/// date and time.
///
/// By ERFA: Earth's heliocentric position (eraEpv00), light time and aberration through eraAb's first order,
/// precession and nutation IAU 2006/2000A, Earth rotation with UT1 = UTC. Error below 0.006 degrees, most of
/// it UT1 - UTC (up to 0.9 s).
/// @param iso8601  "2026-03-21", "2026-03-21T10:00[:SS[.sss]]", with "Z" or "+hh:mm"; without a zone UTC
/// Throws UsageError for anything else or a date that does not exist.
glm::dvec3 sun_direction(const std::string& iso8601);
glm::dvec3 sun_direction(const UtcDate& utc);

/// Rotation from the celestial frame (GCRS, the axes of ICRS) to the Earth-fixed one, as for sun_direction.
glm::dmat3 ecef_from_celestial(const UtcDate& utc);

/// The sun at 10:00 local solar time at a longitude, at an equinox: over the equator, 30 degrees east of the
/// place.
glm::dvec3 morning_sun(double lon_deg);

}  // namespace globe::geo
