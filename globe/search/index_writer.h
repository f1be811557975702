#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "globe/base/pending_file.h"
#include "globe/geo/ellipsoid.h"
#include "globe/search/feature.h"
#include "globe/search/schema.h"
#include "globe/search/sqlite.h"

namespace globe::search {

/// Writes a database of features (schema.h): all of it or nothing.
///
/// Features are staged in a temporary file, in the order in which they come; finish() puts them into the
/// order of their HTM ids by SQLite's external sort. Memory: below 300 MB, whatever their number. Disk: three
/// times the database's size, in its folder. The file takes its name when it is complete and on the disk.
class IndexWriter {
 public:
  /// Throws Error when the file exists and `overwrite` is false, or cannot be written.
  IndexWriter(const std::filesystem::path& path, const geo::Ellipsoid& ellipsoid, bool overwrite);

  /// Adds a feature; its id is its number, from 1. One without any place gets no number and is left out.
  /// Throws UsageError for a line or polygon that is none (shape.h).
  void add(NewFeature&& feature);

  std::uint64_t size() const { return about_.points + about_.shapes; }

  /// Sorts and publishes. Nothing can be added afterwards.
  void finish();

 private:
  struct Point {
    std::uint64_t id;
    geo::Geodetic at;
    std::string name, properties;
  };

  void add_point(NewFeature&& feature);
  void add_shape(const NewFeature& feature);
  void stage_points();

  PendingFile file_;
  Connection connection_;
  About about_;
  std::vector<Point> points_;  ///< that wait to be staged
  Statement stage_point_, stage_cover_, insert_shape_;
};

}  // namespace globe::search
