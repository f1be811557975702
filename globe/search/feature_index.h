#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "globe/geo/ellipsoid.h"
#include "globe/htm/region.h"
#include "globe/search/feature.h"
#include "globe/search/property_test.h"

namespace globe::search {

/// What is asked of a database: features that pass everything given here.
struct Query {
  std::optional<geo::Geodetic> near;  ///< the place that distances are measured from
  std::optional<double> radius_m;     ///< geodesic distance from `near`, itself included; needs `near`
  std::vector<std::shared_ptr<const htm::Region>> regions;  ///< each of them holds a place of the feature
  std::string name_prefix;                                  ///< of the name, folded (folded_name.h)
  std::vector<PropertyTest> properties;
  std::optional<std::size_t> count;  ///< so many at most: the nearest, without `near` the first by id
};

/// A feature that was found.
struct Hit {
  std::int64_t id = 0;
  std::uint64_t htm = 0;  ///< of a point its trixel of level kIndexLevel, else 0
  /// Where a point is; of lines and polygons the place that is nearest to `near`, without `near` any place.
  double lat_deg = 0, lon_deg = 0;
  double distance_m = 0;  ///< from `near` to there, geodesic on the database's ellipsoid; without it 0
};

struct OpenDatabase;

/// A database of features, open for questions. One thread at a time.
class FeatureIndex {
 public:
  /// Throws Error when the file is missing, no database of features, of a newer version, or damaged.
  explicit FeatureIndex(const std::filesystem::path& path);
  ~FeatureIndex();
  FeatureIndex(FeatureIndex&&) noexcept;

  const geo::Ellipsoid& ellipsoid() const;
  std::uint64_t size() const;

  /// The features that pass, by (distance, id) when the query has `near`, else by id.
  ///
  /// The distance of a line or polygon is that of its nearest place (shape.h), 0 from inside a polygon; a
  /// region has it when it touches it.
  ///
  /// Regions and radii go through their covers: range scans of HTM ids, then the exact test. The k nearest
  /// are looked for within a distance at which k features are known to be: that of the k-th nearest of the
  /// features next in the order of their ids, or else rings four times as wide each, until k are in one.
  /// Memory: 40 bytes a hit. Throws Error when the file is damaged.
  std::vector<Hit> find(const Query& query);

  /// Name and properties of a feature found.
  FoundFeature read(const Hit& hit);

 private:
  std::unique_ptr<OpenDatabase> database_;
};

}  // namespace globe::search
