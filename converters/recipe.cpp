#include "converters/recipe.h"

#include <filesystem>
#include <nlohmann/json.hpp>

namespace converters {
namespace {

using nlohmann::ordered_json;

template <typename T, typename Convert>
ordered_json optional(const std::optional<T>& value, const Convert& convert) {
  return value ? ordered_json(convert(*value)) : ordered_json(nullptr);
}

ordered_json recipe_of(const MapInput& map) {
  const auto same = [](const auto& value) { return value; };
  std::error_code missing;  // opening the map tells
  const auto changed = std::filesystem::last_write_time(map.path, missing).time_since_epoch().count();
  return {{"path", std::filesystem::weakly_canonical(map.path, missing).string()},
          {"bytes", std::filesystem::file_size(map.path, missing)},
          {"changed", changed},
          {"extent", optional(map.extent,
                              [](const Extent& e) {
                                return ordered_json{e.west, e.south, e.east, e.north};
                              })},
          {"registration", optional(map.registration, [](Registration r) { return static_cast<int>(r); })},
          {"crs", optional(map.crs, same)},
          {"nodata", optional(map.nodata, [](double value) { return std::to_string(value); })},
          {"scale", optional(map.scale, same)},
          {"offset", optional(map.offset, same)},
          {"unit", optional(map.unit, same)}};
}

ordered_json recipe_of(const std::vector<MapInput>& maps) {
  ordered_json recipes = ordered_json::array();
  for (const MapInput& map : maps) recipes.push_back(recipe_of(map));
  return recipes;
}

}  // namespace

std::string recipe_of(const ConvertOptions& options) {
  const auto same = [](auto value) { return value; };
  const ordered_json recipe{
      {"program", options.program_version},
      {"heights", recipe_of(options.heights)},
      {"colors", recipe_of(options.colors)},
      {"level", optional(options.level, same)},
      {"filter", optional(options.filter, [](Filter f) { return static_cast<int>(f); })},
      {"ellipsoid", optional(options.ellipsoid,
                             [](const globe::geo::Ellipsoid& e) {
                               return ordered_json{e.a, e.f};
                             })},
      {"latitude", static_cast<int>(options.latitude)},
      {"voids", static_cast<int>(options.voids)},
      {"mark_voids", options.mark_voids},
      {"geoid", options.geoid},
      {"datum", optional(options.datum, [](const std::string& name) { return name; })},
      {"as_thesis", options.as_thesis},
      {"credits", options.credits}};
  return recipe.dump(2) + "\n";
}

}  // namespace converters
