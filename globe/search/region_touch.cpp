#include "globe/search/region_touch.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace globe::search {
namespace {

using htm::dvec3;

/// REQUIRES: neither end is in the region.
bool inner_part_touches(const htm::Region& region, const dvec3& a, const dvec3& b) {
  constexpr double kThickness = 1e-13;  // radians
  constexpr double kShortest = 1e-14;
  constexpr double kLongest = 0.5;  // beyond that a triangle's box holds too much
  const double length = glm::distance(a, b);
  const dvec3 middle = glm::normalize(a + b);
  if (length < kLongest) {
    const dvec3 left = glm::normalize(glm::cross(a + b, b - a));
    const dvec3 third = glm::normalize(middle + kThickness * left);
    switch (region.relation({a, b, third})) {
      case htm::Relation::kDisjoint:
        return false;
      case htm::Relation::kInside:
        return true;
      case htm::Relation::kTouches:
        break;
    }
    if (length < kShortest) return true;
  }
  return region.contains(middle) || inner_part_touches(region, a, middle) ||
         inner_part_touches(region, middle, b);
}

}  // namespace

bool touches(const htm::Region& region, const dvec3& a, const dvec3& b) {
  if (region.contains(a) || region.contains(b)) return true;
  return a != b && inner_part_touches(region, a, b);
}

}  // namespace globe::search
