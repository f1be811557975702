#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "globe/base/error.h"
#include "globe/search/feature.h"

namespace globe::search {

/// Reads features from GeoJSON (geo/geojson.h), one by one.
///
/// The name is the property that `name_key` names; upper or lower case, as it stands if there is one so. It
/// is taken out of the properties if it is a text or a number. The feature's "id" becomes a property if there
/// is none of that key.
/// @param visit  a feature and its number in the file, from 1
/// @param refuse  what is wrong with a feature, which is left out
/// Throws Error when the file cannot be read or is no GeoJSON.
void visit_geojson_features(const std::filesystem::path& path, const std::string& name_key,
                            const std::function<void(NewFeature&&, std::size_t number)>& visit,
                            const std::function<void(const Error&)>& refuse);

}  // namespace globe::search
