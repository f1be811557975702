#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/commands.h"
#include "app/point.h"
#include "app/records.h"
#include "app/region_options.h"
#include "globe/base/error.h"
#include "globe/htm/cone.h"
#include "globe/search/feature_index.h"

namespace app {
namespace {

using globe::search::FeatureIndex;
using globe::search::FoundFeature;
using globe::search::Hit;
using globe::search::Query;
using nlohmann::ordered_json;

struct FindOptions {
  std::string database;
  std::string near, radius;
  RegionOptions region;
  std::string name;
  std::vector<std::string> where;
  std::optional<std::size_t> count;
  bool json = false, csv = false;
  std::optional<int> precision;
};

Query query_of(const FindOptions& options, const globe::geo::Ellipsoid& ellipsoid) {
  Query query;
  if (!options.near.empty()) query.near = parse_point(options.near).position;
  if (!options.radius.empty()) {
    if (!query.near) throw globe::UsageError("--radius", "there is no place for it", "give --near POINT");
    const Radius radius =
        parse_radius("--radius", options.radius, "give a length such as 50km or an angle such as 0.5deg");
    if (radius.is_angle) {
      const auto center = globe::geo::normal_from_degrees(query.near->lat_deg, query.near->lon_deg);
      query.regions.push_back(std::make_shared<globe::htm::Cone>(center, radius.value));
    } else {
      query.radius_m = radius.value;
    }
  }
  if (options.region.complement && !options.region.any()) refuse_missing_region("--complement");
  if (options.region.any()) query.regions.push_back(make_region(options.region, ellipsoid));
  query.name_prefix = options.name;
  for (const std::string& test : options.where) {
    const std::size_t equals = test.find('=');
    if (equals == std::string::npos || equals == 0)
      throw globe::UsageError("--where", "'" + test + "' is not KEY=VALUE",
                              "give a property such as country=AT");
    query.properties.emplace_back(test.substr(0, equals), test.substr(equals + 1));
  }
  query.count = options.count;
  return query;
}

/// A field of CSV, in quotes where it needs them.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

/// Writes hits one a line.
class HitWriter {
 public:
  HitWriter(const FindOptions& options, FeatureIndex& index)
      : options_(options), index_(index), with_distance_(!options.near.empty()) {}

  void write(const std::vector<Hit>& hits) {
    if (options_.csv) std::puts("name,lat,lon,distance_m,id,properties");
    for (const Hit& hit : hits) {
      const std::string text = line(hit, index_.read(hit)) + '\n';
      std::fwrite(text.data(), 1, text.size(), stdout);
    }
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw globe::Error("standard output", "cannot be written", "see whether the disk is full");
  }

 private:
  std::string line(const Hit& hit, const FoundFeature& feature) const {
    if (options_.json) return json_line(hit, feature);
    const std::string lat = number_text(hit.lat_deg, options_.precision);
    const std::string lon = number_text(shown_longitude(hit.lon_deg, options_.precision), options_.precision);
    const std::string distance = with_distance_ ? number_text(hit.distance_m, options_.precision) : "";
    if (options_.csv) {
      return csv_field(feature.name) + ',' + lat + ',' + lon + ',' + distance + ',' + std::to_string(hit.id) +
             ',' + csv_field(feature.properties);
    }
    std::string name = feature.name.empty() ? "-" : feature.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return lat + ' ' + lon + ' ' + (with_distance_ ? distance : "-") + ' ' + std::to_string(hit.id) + ' ' +
           name;
  }

  std::string json_line(const Hit& hit, const FoundFeature& feature) const {
    ordered_json object;
    object["name"] = feature.name.empty() ? ordered_json() : ordered_json(feature.name);
    object["lat"] = shown(hit.lat_deg, options_.precision);
    object["lon"] = shown_longitude(hit.lon_deg, options_.precision);
    object["distance_m"] = nullptr;
    if (with_distance_) object["distance_m"] = shown(hit.distance_m, options_.precision);
    object["id"] = hit.id;
    object["properties"] = ordered_json::object();
    if (!feature.properties.empty()) {
      ordered_json properties = ordered_json::parse(feature.properties, nullptr, false);
      if (properties.is_discarded()) {
        throw globe::Error(options_.database, "it is damaged (properties that are no JSON)",
                           "index the features again");
      }
      object["properties"] = std::move(properties);
    }
    return object.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  }

  const FindOptions& options_;
  FeatureIndex& index_;
  bool with_distance_;
};

void run(const FindOptions& options) {
  FeatureIndex index(options.database);
  const Query query = query_of(options, index.ellipsoid());
  HitWriter(options, index).write(index.find(query));
}

}  // namespace

void add_find(CLI::App& program) {
  auto options = std::make_shared<FindOptions>();
  CLI::App* command =
      program.add_subcommand("find", "features of a database: near a place, in a region, by name");
  command->add_option("DB", options->database, "made by globe index")->required();
  command->add_option("--near", options->near,
                      "POINT that distances are measured from; the nearest come first");
  command->add_option(
      "--radius", options->radius,
      "at most so far from --near: m (also without a unit), km, ft, mi, nmi on the ellipsoid; "
      "deg, arcmin, arcsec between normals");
  command->add_option("--count", options->count, "so many at most")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 53));
  add_region_options(*command, options->region);
  command->add_option("--name", options->name, "the name begins so, upper or lower case");
  command
      ->add_option("--where", options->where,
                   "KEY=VALUE: a property has this value; may be repeated, all have to hold")
      ->allow_extra_args(false);
  CLI::Option* json = command->add_flag("--json", options->json, "one JSON object a line");
  command->add_flag("--csv", options->csv, "a table with a header line")->excludes(json);
  command
      ->add_option("--precision", options->precision,
                   "decimals of every number with a fraction (default: all)")
      ->check(CLI::Range(0, 17));
  command->footer(
      "Text: LAT LON DISTANCE_M ID NAME, the distance - without --near, the name - where there is none.\n"
      "Distances are geodesics on the database's ellipsoid. With --near the nearest come first, else the "
      "order\n"
      "is that of ids, which are the features' numbers in the order of their files.\n"
      "Example: globe find places.db --near 48.2,16.37 --radius 50km --where capital=yes --json");
  command->callback([options] { run(*options); });
}

}  // namespace app
