#pragma once

#include <cstddef>
#include <functional>
#include <istream>
#include <string>

#include "globe/search/feature.h"

namespace globe::search {

/// Which columns of a CSV file hold latitude, longitude and name.
///
/// Names of the file's header, upper or lower case; or all of them numbers from 1, and the file has no
/// header. Empty: the first column called lat, latitude or y, that called lon, lng, long, longitude or x, and
/// that called name, which need not be there.
struct Columns {
  std::string lat, lon, name;
};

/// A line that is left out.
struct BadLine {
  std::size_t line = 0;  ///< from 1
  std::string why;
};

/// Reads points from CSV (globe/base/csv_reader.h), record by record.
///
/// Latitude and longitude are plain degrees; the longitude may be of any size. All other columns become
/// properties, texts as they stand, keyed by the header (by "1", "2", ... without one); empty fields are left
/// out. Fields that are missing at a record's end are empty.
/// @param file  its name, for messages
/// Throws Error when the columns are not there.
void visit_csv(std::istream& stream, const std::string& file, const Columns& columns,
               const std::function<void(NewFeature&&, std::size_t line)>& visit,
               const std::function<void(const BadLine&)>& refuse);

}  // namespace globe::search
