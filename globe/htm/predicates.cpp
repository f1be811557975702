#include "globe/htm/predicates.h"

#include "globe/htm/exact_sum.h"

namespace globe::htm {

int exact_orientation(const dvec3& a, const dvec3& b, const dvec3& c) {
  ExactSum det;
  det.add(a.y, b.z, c.x);
  det.add(-a.z, b.y, c.x);
  det.add(a.z, b.x, c.y);
  det.add(-a.x, b.z, c.y);
  det.add(a.x, b.y, c.z);
  det.add(-a.y, b.x, c.z);
  return det.sign();
}

}  // namespace globe::htm
