#pragma once

#include "globe/planet/relief.h"

namespace globe::planet {

/// Craters of every size between two data cells and the finest wavelength, the ground of airless bodies.
///
/// At each octave space is cut into cells with at most one crater each, of random place, size and age; those
/// near the sphere are stamped on it. Bowls are as deep as a fifth of their width when fresh, rims a
/// twenty-fifth. Source of the proportions: Pike 1977, simple lunar craters.
ReliefLanes crater_relief(const ReliefScale& scale, const ReliefPlaces& places);

}  // namespace globe::planet
