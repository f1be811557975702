#pragma once

#include "globe/geo/point.h"

namespace app {

using globe::geo::parse_length_m;
using globe::geo::parse_point;
using globe::geo::Point;

}  // namespace app
