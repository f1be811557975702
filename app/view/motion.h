#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "app/view/eye.h"

namespace app::view {

// How a camera moves under a person's hands: each of these gives where it stands afterwards, its horizon
// level.

/// Carried along by a turn of space about the planet's centre, at the height it has: the axis is `turn`, its
/// length the angle in radians.
///
/// Away from the poles the heading stays (north does not drift), near them the picture does (there is no
/// jump at a pole): latitudes 60 to 80 degrees go over from one to the other.
Standpoint carried(const globe::geo::Ellipsoid& ellipsoid, const Standpoint& stand, const glm::dvec3& turn);

/// What carries a camera so that it sees a place at a pixel, at the height it has: a turn for carried().
/// Nothing where there is none, or it would be longer than three times the way to the place.
///
/// Newton's method for the two coordinates of the pixel, to a thousandth of one.
/// @param place  ECEF
std::optional<glm::dvec3> turn_to_hold(const Eye& eye, const Standpoint& stand, const glm::dvec3& place,
                                       glm::dvec2 pixel);

/// Nearer to a place, or farther from it, by a factor, which is seen at the same pixel all the time. It keeps
/// looking the way it does where it can, and is turned where it cannot: as the planet's horizon sinks. Where
/// no level look sees the place at that pixel any more (far to the side of a planet that has become small) it
/// comes as near to it as it can.
Standpoint approached(const Eye& eye, const Standpoint& stand, const glm::dvec3& place, glm::dvec2 pixel,
                      double factor);

/// Around a place at the distance it has, seen at the same pixel: `by` turns it around the vertical there
/// (x, degrees clockwise as seen from above) and lifts it (y, degrees), at most to the zenith.
Standpoint swung(const Eye& eye, const Standpoint& stand, const glm::dvec3& place, glm::dvec2 pixel,
                 glm::dvec2 by_deg);

/// Where it stands, turned to the right and up by so many degrees.
Standpoint turned(const Standpoint& stand, glm::dvec2 by_deg);

}  // namespace app::view
