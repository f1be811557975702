#include "globe/search/geojson_features.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "globe/search/same_letters.h"

namespace globe::search {
namespace {

using nlohmann::json;

json::iterator find_key(json& properties, const std::string& key) {
  const auto exact = properties.find(key);
  if (exact != properties.end()) return exact;
  for (auto at = properties.begin(); at != properties.end(); ++at)
    if (same_letters(at.key(), key)) return at;
  return properties.end();
}

NewFeature new_feature(geo::Feature&& feature, const std::string& name_key) {
  NewFeature result;
  result.geometry = std::move(feature.geometry);
  json properties = feature.properties.is_object() ? std::move(feature.properties) : json::object();
  const auto name = find_key(properties, name_key);
  if (name != properties.end() && (name->is_string() || name->is_number())) {
    result.name = name->is_string() ? name->get<std::string>() : name->dump();
    properties.erase(name);
  }
  if (!feature.id.is_null() && !properties.contains("id")) properties["id"] = std::move(feature.id);
  if (!properties.empty()) result.properties = properties.dump();
  return result;
}

}  // namespace

void visit_geojson_features(const std::filesystem::path& path, const std::string& name_key,
                            const std::function<void(NewFeature&&, std::size_t number)>& visit,
                            const std::function<void(const Error&)>& refuse) {
  geo::visit_geojson(
      path,
      [&](geo::Feature&& feature) {
        const std::size_t number = feature.number;
        visit(new_feature(std::move(feature), name_key), number);
      },
      refuse);
}

}  // namespace globe::search
