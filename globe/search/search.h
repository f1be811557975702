#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "globe/htm/cover.h"
#include "globe/search/feature_index.h"
#include "globe/search/hit_list.h"
#include "globe/search/open_database.h"
#include "globe/search/shape.h"

namespace globe::search {

/// One question on its way through a database (FeatureIndex::find says what is asked, and how).
class Search {
 public:
  Search(OpenDatabase& database, const Query& query);

  std::vector<Hit> run();

 private:
  using Ranges = std::vector<htm::IdRange>;

  // The exact tests of one row (open_database.h).
  bool passes_attributes(const Statement& row) const;
  Hit hit_of(const Statement& row) const;
  /// The point in a row, if it passes. `inside`: its trixel is known to lie in all regions.
  std::optional<Hit> passing_point(const Statement& row, bool inside) const;
  std::optional<Hit> passing_shape(const Statement& row) const;
  Shape shape_of(std::string_view wkb) const;

  void consider_point(const Statement& row, bool inside);
  void consider_shape(std::int64_t id);
  void consider_named(std::int64_t htm, std::int64_t id);

  // The ways to candidates.
  void everywhere();
  void by_ranges(const Ranges& ranges);
  /// Everything within radius_m_.
  void within_radius();
  /// By the names, if they are few or there is no other way; false if they are many.
  bool by_name(bool other_way);
  void nearest();

  /// A distance within which as many features as are asked for pass: that of the last of them among those
  /// next in the order of HTM ids. Nothing when too few of the next pass.
  std::optional<double> distance_of_neighbours();
  /// Shapes with a trixel of their cover in the ranges, or around one of them: each once.
  std::vector<std::int64_t> shapes_in(const Ranges& ranges) const;

  OpenDatabase& database_;
  const Query& query_;
  std::string folded_prefix_;
  htm::dvec3 near_normal_;          ///< where distances are measured from, if they are
  std::optional<double> radius_m_;  ///< within which features pass: as asked, or a ring
  std::optional<Ranges> ranges_;    ///< of the regions
  HitList hits_;
};

}  // namespace globe::search
