#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/point.h"

namespace app {

struct PointPair {
  Point a, b;
};

/// Reads two points written after each other: `A ; B`, each as `parse_point` takes it, or without the
/// semicolon, if both are written in as many words: `LAT LON LAT LON`, `LAT,LON LAT,LON`,
/// `LAT LON ALT LAT LON ALT`, two MGRS references. Throws globe::UsageError.
PointPair parse_point_pair(std::string_view text);

/// The operands A and B of a command as the one record that they are; none when none are given. Throws
/// globe::UsageError for one or for more than two.
std::vector<std::string> pair_records(const std::vector<std::string>& operands);

}  // namespace app
