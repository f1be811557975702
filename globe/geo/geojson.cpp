#include "globe/geo/geojson.h"

#include <cmath>
#include <cstring>
#include <fstream>

#include "globe/base/error.h"

namespace globe::geo {
namespace {

using nlohmann::json;

constexpr int kDeepestCollection = 16;
constexpr const char* kFormat = "see RFC 7946 for the format";

/// What is wrong inside a feature; the reader adds where.
struct Fault {
  std::string why;
};

const json& member(const json& object, const char* key) {
  const auto at = object.find(key);
  if (at == object.end()) throw Fault{std::string("'") + key + "' is missing"};
  return *at;
}

const json& array_of(const json& value, const char* what) {
  if (!value.is_array()) throw Fault{std::string(what) + " is not an array"};
  return value;
}

Geodetic position(const json& value) {
  array_of(value, "a position");
  if (value.size() < 2) throw Fault{"a position has fewer than two numbers"};
  for (std::size_t k = 0; k < value.size() && k < 3; ++k) {
    if (!value[k].is_number() || !std::isfinite(value[k].get<double>()))
      throw Fault{"a position is not made of finite numbers"};
  }
  Geodetic at{value[1].get<double>(), value[0].get<double>(), value.size() > 2 ? value[2].get<double>() : 0.0,
              false};
  if (std::abs(at.lat_deg) > 90.0)
    throw Fault{"latitude " + value[1].dump() + " is beyond 90 degrees (longitude comes first)"};
  return at;
}

Geometry::Line line(const json& value, std::size_t fewest) {
  Geometry::Line points;
  for (const json& item : array_of(value, "a line")) points.push_back(position(item));
  if (points.size() < fewest) throw Fault{"a line has fewer than " + std::to_string(fewest) + " positions"};
  return points;
}

Geometry::Line ring(const json& value) {
  constexpr std::size_t kFewest = 4;
  Geometry::Line points = line(value, kFewest);
  const Geodetic& first = points.front();
  const Geodetic& last = points.back();
  if (first.lat_deg != last.lat_deg || first.lon_deg != last.lon_deg)
    throw Fault{"a ring does not end where it begins"};
  points.pop_back();
  return points;
}

Geometry::Rings rings(const json& value) {
  Geometry::Rings result;
  for (const json& item : array_of(value, "a polygon")) result.push_back(ring(item));
  return result;
}

void add_geometry(const json& value, int depth, Geometry& geometry) {
  if (value.is_null()) return;
  if (!value.is_object()) throw Fault{"a geometry is not an object"};
  const json& type = member(value, "type");
  if (type == "GeometryCollection") {
    if (depth == kDeepestCollection) throw Fault{"its geometry collections are nested too deep"};
    for (const json& item : array_of(member(value, "geometries"), "'geometries'"))
      add_geometry(item, depth + 1, geometry);
    return;
  }
  const json& places = member(value, "coordinates");
  if (places.is_null()) return;
  array_of(places, "'coordinates'");
  // An empty array is a geometry without places (RFC 7946, 3.1).
  if (places.empty()) return;
  if (type == "Point") {
    geometry.points.push_back(position(places));
  } else if (type == "MultiPoint") {
    for (const json& item : places) geometry.points.push_back(position(item));
  } else if (type == "LineString") {
    geometry.lines.push_back(line(places, 2));
  } else if (type == "MultiLineString") {
    for (const json& item : places) geometry.lines.push_back(line(item, 2));
  } else if (type == "Polygon") {
    geometry.polygons.push_back(rings(places));
  } else if (type == "MultiPolygon") {
    for (const json& item : places) geometry.polygons.push_back(rings(item));
  } else {
    throw Fault{"a geometry's type " + type.dump(-1, ' ', false, json::error_handler_t::replace) +
                " is not known"};
  }
}

bool is_feature(const json& value) {
  const auto type = value.find("type");
  return type != value.end() && *type == "Feature";
}

Feature feature_of(const json& value) {
  if (!value.is_object()) throw Fault{"it is not an object"};
  Feature feature;
  if (!is_feature(value)) {
    add_geometry(value, 0, feature.geometry);
    return feature;
  }
  if (const auto geometry = value.find("geometry"); geometry != value.end())
    add_geometry(*geometry, 0, feature.geometry);
  if (const auto id = value.find("id"); id != value.end()) feature.id = *id;
  if (const auto properties = value.find("properties"); properties != value.end())
    feature.properties = *properties;
  return feature;
}

/// Takes the features out of a collection as the parser completes them.
class Reader {
 public:
  Reader(std::string name, const std::function<void(Feature&&)>& visit,
         const std::function<void(const Error&)>& refuse)
      : name_(std::move(name)), visit_(visit), refuse_(refuse) {}

  void read(std::istream& stream) {
    json rest;
    try {
      rest = json::parse(stream, [this](int depth, json::parse_event_t event, json& value) {
        return keep(depth, event, value);
      });
    } catch (const json::exception& error) {
      throw Error(name_, std::string("it is no JSON: ") + error.what(), kFormat);
    }
    const auto type = rest.is_object() ? rest.find("type") : rest.end();
    if (type == rest.end() || !type->is_string())
      throw Error(name_, "it is no GeoJSON: the outermost object has no 'type'", kFormat);
    if (*type != "FeatureCollection") {
      take(rest);
    } else if (!features_seen_) {
      throw Error(name_, "the collection has no 'features'", kFormat);
    }
  }

 private:
  /// The parser's callback: false discards the value, whose work is done.
  bool keep(int depth, json::parse_event_t event, const json& value) {
    if (event == json::parse_event_t::key && depth == 1) in_features_ = value == "features";
    if (!in_features_) return true;
    if (depth == 1 && event == json::parse_event_t::array_start) features_seen_ = true;
    const bool complete = event == json::parse_event_t::object_end ||
                          event == json::parse_event_t::array_end || event == json::parse_event_t::value;
    if (depth != 2 || !complete || !features_seen_) return true;
    take(value);
    return false;
  }

  void take(const json& value) {
    ++count_;
    Feature feature;
    try {
      feature = feature_of(value);
    } catch (const Fault& fault) {
      const Error error(name_ + ", feature " + std::to_string(count_), fault.why, kFormat);
      if (!refuse_) throw error;
      return refuse_(error);
    }
    feature.number = count_;
    visit_(std::move(feature));
  }

  std::string name_;
  const std::function<void(Feature&&)>& visit_;
  const std::function<void(const Error&)>& refuse_;
  bool in_features_ = false, features_seen_ = false;
  std::size_t count_ = 0;
};

}  // namespace

void visit_geojson(std::istream& stream, const std::string& name, const std::function<void(Feature&&)>& visit,
                   const std::function<void(const Error&)>& refuse) {
  Reader(name, visit, refuse).read(stream);
}

void visit_geojson(const std::filesystem::path& path, const std::function<void(Feature&&)>& visit,
                   const std::function<void(const Error&)>& refuse) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream || std::filesystem::is_directory(path)) {
    throw Error(path.string(), stream ? "it is a folder" : std::strerror(errno),
                "give a readable GeoJSON file");
  }
  visit_geojson(stream, path.string(), visit, refuse);
}

}  // namespace globe::geo
