#include "globe/effects/named_places.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "globe/base/angles.h"

namespace globe::effects {
namespace {

constexpr std::size_t kLongest = 80;  ///< bytes of a name

/// Without line ends and what else is no letter, and not too long.
std::string one_line(std::string name) {
  for (char& c : name) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  if (name.size() > kLongest) {
    std::size_t end = kLongest;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0u) == 0x80u) --end;
    name.resize(end);
    name += "…";
  }
  return name;
}

std::string name_of(const nlohmann::json& properties, const std::string& property) {
  if (!properties.is_object()) return {};
  std::vector<std::string> keys{property};
  if (property.empty()) keys = {"name", "NAME", "Name", "label", "title"};
  for (const std::string& key : keys) {
    const auto at = properties.find(key);
    if (at == properties.end()) continue;
    if (at->is_string()) return one_line(at->get<std::string>());
    if (at->is_number()) return at->dump();
  }
  return {};
}

/// Of a numeric property; of none named, what files usually have.
double priority_of(const nlohmann::json& properties, const std::string& property) {
  const auto number = [&](const std::string& key) -> std::optional<double> {
    const auto at = properties.find(key);
    if (at == properties.end() || !at->is_number()) return std::nullopt;
    return at->get<double>();
  };
  constexpr double kLast = -std::numeric_limits<double>::infinity();
  if (!properties.is_object()) return kLast;
  if (!property.empty()) return number(property).value_or(kLast);
  for (const char* key : {"priority", "population", "pop_max", "POP_MAX", "elevation", "ele"}) {
    if (const auto value = number(key)) return *value;
  }
  for (const char* key : {"scalerank", "SCALERANK", "rank"}) {
    if (const auto value = number(key)) return -*value;
  }
  return kLast;
}

double map_area(const geo::Geometry::Line& ring) {
  double sum = 0.0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const geo::Geodetic &a = ring[k], &b = ring[(k + 1) % ring.size()];
    sum += (a.lon_deg - ring[0].lon_deg) * (b.lat_deg - ring[0].lat_deg) -
           (b.lon_deg - ring[0].lon_deg) * (a.lat_deg - ring[0].lat_deg);
  }
  return 0.5 * sum;
}

/// Longitudes where a polygon's border crosses a latitude, from west to east.
std::vector<double> crossings(const geo::Geometry::Rings& polygon, double lat_deg) {
  std::vector<double> found;
  for (const geo::Geometry::Line& ring : polygon) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const geo::Geodetic &a = ring[k], &b = ring[(k + 1) % ring.size()];
      if ((a.lat_deg <= lat_deg) == (b.lat_deg <= lat_deg)) continue;
      found.push_back(a.lon_deg + (lat_deg - a.lat_deg) / (b.lat_deg - a.lat_deg) * (b.lon_deg - a.lon_deg));
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

double map_length(const geo::Geodetic& a, const geo::Geodetic& b) {
  return std::hypot((b.lon_deg - a.lon_deg) * std::cos(0.5 * (a.lat_deg + b.lat_deg) * kDegree),
                    b.lat_deg - a.lat_deg);
}

double map_length(const geo::Geometry::Line& line) {
  double length = 0.0;
  for (std::size_t k = 1; k < line.size(); ++k) length += map_length(line[k - 1], line[k]);
  return length;
}

geo::Geodetic half_way(const geo::Geometry::Line& line) {
  double left = 0.5 * map_length(line);
  for (std::size_t k = 1; k < line.size(); ++k) {
    const double length = map_length(line[k - 1], line[k]);
    if (length > 0.0 && left <= length) {
      const double t = left / length;
      return {line[k - 1].lat_deg + t * (line[k].lat_deg - line[k - 1].lat_deg),
              line[k - 1].lon_deg + t * (line[k].lon_deg - line[k - 1].lon_deg), 0.0, false};
    }
    left -= length;
  }
  return line.back();
}

/// Square root of a polygon's area on the globe, degrees.
double polygon_size(const geo::Geometry::Rings& polygon) {
  if (polygon.empty() || polygon.front().empty()) return 0.0;
  double south = 90.0, north = -90.0;
  for (const geo::Geodetic& corner : polygon.front()) {
    south = std::min(south, corner.lat_deg);
    north = std::max(north, corner.lat_deg);
  }
  return std::sqrt(std::abs(map_area(polygon.front())) * std::cos(0.5 * (south + north) * kDegree));
}

}  // namespace

geo::Geodetic place_inside(const geo::Geometry::Rings& polygon) {
  const geo::Geometry::Line& ring = polygon.front();
  double lat = 0.0, total = 0.0, lon = 0.0;
  for (std::size_t k = 1; k + 1 < ring.size(); ++k) {
    const geo::Geodetic &o = ring[0], &a = ring[k], &b = ring[k + 1];
    const double twice =
        (a.lon_deg - o.lon_deg) * (b.lat_deg - o.lat_deg) - (b.lon_deg - o.lon_deg) * (a.lat_deg - o.lat_deg);
    total += twice;
    lat += twice * (o.lat_deg + a.lat_deg + b.lat_deg) / 3.0;
    lon += twice * (o.lon_deg + a.lon_deg + b.lon_deg) / 3.0;
  }
  if (total == 0.0) return {ring[0].lat_deg, ring[0].lon_deg, 0.0, false};
  lat /= total;
  lon /= total;
  // On the centre's parallel: at the centre if that is inside and has room, else amid the widest stretch.
  const std::vector<double> borders = crossings(polygon, lat);
  double widest = 0.0, middle = lon, own = 0.0;
  for (std::size_t k = 0; k + 1 < borders.size(); k += 2) {
    const double width = borders[k + 1] - borders[k];
    if (borders[k] < lon && lon < borders[k + 1]) own = std::min(lon - borders[k], borders[k + 1] - lon);
    if (width <= widest) continue;
    widest = width;
    middle = 0.5 * (borders[k] + borders[k + 1]);
  }
  return {lat, own > 0.15 * widest ? lon : middle, 0.0, false};
}

std::vector<NamedPlace> read_named_places(const std::filesystem::path& file, const std::string& property,
                                          const std::string& priority) {
  std::vector<NamedPlace> places;
  geo::visit_geojson(file, [&](geo::Feature&& feature) {
    NamedPlace place;
    place.name = name_of(feature.properties, property);
    if (place.name.empty() || feature.geometry.empty()) return;
    place.priority = priority_of(feature.properties, priority);
    const auto add = [&](const geo::Geodetic& at, NamedPlace::Kind kind, double size_deg) {
      place.lat_deg = at.lat_deg;
      place.lon_deg = at.lon_deg;
      place.kind = kind;
      place.size_deg = size_deg;
      places.push_back(place);
    };
    const geo::Geometry& geometry = feature.geometry;
    const auto largest =
        std::max_element(geometry.polygons.begin(), geometry.polygons.end(),
                         [](const auto& a, const auto& b) { return polygon_size(a) < polygon_size(b); });
    if (largest != geometry.polygons.end() && polygon_size(*largest) > 0.0)
      return add(place_inside(*largest), NamedPlace::Kind::kArea, polygon_size(*largest));
    const auto longest =
        std::max_element(geometry.lines.begin(), geometry.lines.end(),
                         [](const auto& a, const auto& b) { return map_length(a) < map_length(b); });
    if (longest != geometry.lines.end())
      return add(half_way(*longest), NamedPlace::Kind::kLine, map_length(*longest));
    for (const geo::Geodetic& point : geometry.points) add(point, NamedPlace::Kind::kPoint, 0.0);
  });
  std::stable_sort(places.begin(), places.end(),
                   [](const NamedPlace& a, const NamedPlace& b) { return a.priority > b.priority; });
  return places;
}

}  // namespace globe::effects
