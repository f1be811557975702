#pragma once

#include <GeographicLib/Geodesic.hpp>
#include <filesystem>
#include <string>

#include "globe/base/error.h"
#include "globe/search/schema.h"
#include "globe/search/sqlite.h"

namespace globe::search {

/// A database of features with the statements that questions are made of.
struct OpenDatabase {
  /// Throws Error when the file is missing, no database of features, of a newer version, or damaged.
  explicit OpenDatabase(const std::filesystem::path& file);

  /// The error to throw when the file holds what IndexWriter does not write.
  Error damage(const std::string& what) const;

  std::filesystem::path path;
  Connection connection;
  About about;
  GeographicLib::Geodesic earth;
  // Points: htm, id, lat, lon, name, properties.
  Statement all_points;
  Statement points_between;  ///< htm, htm
  Statement points_from;     ///< htm; rising
  Statement points_before;   ///< htm; falling
  Statement one_point;       ///< htm, id
  // Shapes: 0, id, lat, lon, name, properties, geometry.
  Statement all_shapes;
  Statement one_shape;  ///< id
  // Ids of shapes.
  Statement covers_between;  ///< htm, htm
  Statement covers_of;       ///< htm, level
  /// folded, htm, id of the names from a folded one on, in their order.
  Statement names_from;
};

}  // namespace globe::search
