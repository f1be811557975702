#pragma once

#include <memory>

#include "app/accuracy/study.h"
#include "converters/round_trip.h"

namespace app::accuracy {

using Map = std::shared_ptr<const converters::HeightMap>;

/// A map to a level and back, by filter, against the truth: what conversion_studies() is made of.
/// @param own_level  with as many cells around the equator as the map has pixels: says which is the default
Study filter_study(const Map& map, int level, int own_level, const Map& truth);

}  // namespace app::accuracy
