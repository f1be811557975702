#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "globe/geo/ellipsoid.h"
#include "globe/planet/grid.h"

namespace converters {

/// Height of a node, metres; must be the same by every name of the node, and is asked on several threads.
using HeightOfNode = std::function<double(const globe::planet::Node&)>;

/// Writes a planet of these heights, rounded to float, with all the layers that `globe convert` makes of a
/// height map: for yardsticks whose truth is known at every node.
/// @param folder  made where it is not there; work files in it are gone at the end
void write_node_planet(const std::filesystem::path& folder, int level, const globe::geo::Ellipsoid& ellipsoid,
                       const HeightOfNode& height, const std::string& body = "other");

}  // namespace converters
