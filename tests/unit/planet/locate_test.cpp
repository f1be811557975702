#include <gtest/gtest.h>

#include <cmath>

#include "globe/planet/grid.h"

namespace globe::planet {
namespace {

TEST(Locate, FindsEveryNodeWhereItIs) {
  for (const int level : {3, 9, 17, 29}) {
    const int n = nodes_per_side(level);
    for (int d = 0; d < kDiamonds; ++d) {
      for (int a = 0; a <= 8; ++a) {
        for (int b = 0; b <= 8; ++b) {
          const Node node{d, level, n / 8 * a, n / 8 * b};
          const Place place = locate(node_direction(node), level);
          const auto all = names(node);
          double nearest = 1e9;
          for (int k = 0; k < all.count; ++k) {
            const Node& name = all.node[static_cast<std::size_t>(k)];
            if (name.d == place.d) {
              nearest = std::min(nearest, std::hypot(place.ij.x - name.i, place.ij.y - name.j));
            }
          }
          EXPECT_LT(nearest, 1e-6 + 1e-16 * n) << d << " " << a << " " << b << " level " << level;
        }
      }
    }
  }
}

}  // namespace
}  // namespace globe::planet
