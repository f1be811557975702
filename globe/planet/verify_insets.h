#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "globe/planet/dataset.h"

namespace globe::planet {

/// Checks the samples of a planet's insets, all of every level:
/// - Every tile can be decoded, weights lie in 0 to 1, heights that have a weight within what planet.json
/// says.
/// - A coarse height or weight is the fine one of the same node.
/// - Nodes on a diamond's border have the same weight in every diamond, and where that is above 0 the same
/// values. `nodes` grows by the nodes looked at. Gives one line for each inset and layer, level and kind of
/// damage.
std::vector<std::string> inset_damage(const Dataset& data, std::uint64_t& nodes);

}  // namespace globe::planet
