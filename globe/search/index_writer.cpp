#include "globe/search/index_writer.h"

#include <cmath>
#include <string_view>
#include <utility>

#include "globe/geo/normals.h"
#include "globe/htm/trixel.h"
#include "globe/search/folded_name.h"
#include "globe/search/shape.h"
#include "globe/search/wkb.h"

namespace globe::search {
namespace {

constexpr std::size_t kBatch = 4096;  ///< points whose trixels are found together

/// SQLite's sorter spills to files of this folder, which are gone with the process.
void keep_temporary_files_in(const std::filesystem::path& folder) {
  sqlite3_free(std::exchange(sqlite3_temp_directory, sqlite3_mprintf("%s", folder.c_str())));
}

double folded_longitude(double lon_deg) {
  const double lon = std::remainder(lon_deg, 360.0);  // exact
  return lon >= 180.0 ? lon - 360.0 : lon;
}

void sql_folded_name(sqlite3_context* context, int, sqlite3_value** values) {
  const auto* text = reinterpret_cast<const char*>(sqlite3_value_text(values[0]));
  if (text == nullptr) return sqlite3_result_error_nomem(context);
  try {
    const std::string folded = folded_name(text);
    sqlite3_result_text64(context, folded.data(), folded.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
  } catch (const std::bad_alloc&) {
    sqlite3_result_error_nomem(context);
  }
}

/// A new database in which nothing is written twice: it is thrown away when something fails.
Connection create(const PendingFile& file) {
  const std::filesystem::path folder = file.temporary().parent_path();
  keep_temporary_files_in(folder.empty() ? "." : folder);
  Connection connection = Connection::create(file.temporary());
  connection.execute(
      "PRAGMA page_size = 4096; PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; "
      "PRAGMA temp_store = FILE; PRAGMA cache_size = -32768; "
      "PRAGMA temp.cache_size = -8192; PRAGMA threads = 2; BEGIN");
  create_tables(connection);
  connection.execute(
      "CREATE TEMP TABLE staged(id INTEGER PRIMARY KEY, htm INTEGER, lat REAL, lon REAL, name TEXT, "
      "properties TEXT);"
      "CREATE TEMP TABLE staged_cover(htm INTEGER, level INTEGER, id INTEGER)");
  sqlite3_create_function(connection.handle(), "folded_name", 1, SQLITE_UTF8 | SQLITE_DETERMINISTIC, nullptr,
                          sql_folded_name, nullptr, nullptr);
  return connection;
}

}  // namespace

IndexWriter::IndexWriter(const std::filesystem::path& path, const geo::Ellipsoid& ellipsoid, bool overwrite)
    : file_(path, overwrite),
      connection_(create(file_)),
      about_{ellipsoid, 0, 0},
      stage_point_(connection_, "INSERT INTO temp.staged VALUES(?, ?, ?, ?, ?, ?)"),
      stage_cover_(connection_, "INSERT INTO temp.staged_cover VALUES(?, ?, ?)"),
      insert_shape_(connection_, "INSERT INTO shape VALUES(?, ?, ?, ?, ?, ?)") {
  points_.reserve(kBatch);
}

void IndexWriter::add(NewFeature&& feature) {
  const geo::Geometry& geometry = feature.geometry;
  if (geometry.empty()) return;
  if (geometry.points.size() == 1 && geometry.lines.empty() && geometry.polygons.empty()) {
    add_point(std::move(feature));
  } else {
    add_shape(feature);
  }
}

void IndexWriter::add_point(NewFeature&& feature) {
  geo::Geodetic at = feature.geometry.points[0];
  at.lon_deg = folded_longitude(at.lon_deg);
  ++about_.points;
  points_.push_back({size(), at, std::move(feature.name), std::move(feature.properties)});
  if (points_.size() == kBatch) stage_points();
}

void IndexWriter::add_shape(const NewFeature& feature) {
  const Shape shape(feature.geometry);
  ++about_.shapes;
  const geo::Geodetic& at = shape.any_place();
  const std::string geometry = to_wkb(feature.geometry);
  insert_shape_
      .with(size(), at.lat_deg, folded_longitude(at.lon_deg), std::string_view(feature.name),
            std::string_view(feature.properties), Blob{geometry})
      .step();
  for (const htm::Trixel trixel : shape.cover()) {
    const int level = htm::level(trixel);
    stage_cover_.with(trixel.id << (2 * (kIndexLevel - level)), level, size()).step();
  }
}

void IndexWriter::stage_points() {
  const std::size_t count = points_.size();
  std::vector<double> lat(count), lon(count), x(count), y(count), z(count);
  for (std::size_t k = 0; k < count; ++k) {
    lat[k] = points_[k].at.lat_deg;
    lon[k] = points_[k].at.lon_deg;
  }
  geo::normals_from_degrees(lat, lon, x, y, z);
  std::vector<htm::Trixel> trixels(count);
  htm::trixels_at(htm::DirectionArrays{x, y, z}, kIndexLevel, trixels);
  for (std::size_t k = 0; k < count; ++k) {
    const Point& point = points_[k];
    stage_point_
        .with(point.id, trixels[k].id, lat[k], lon[k], std::string_view(point.name),
              std::string_view(point.properties))
        .step();
  }
  points_.clear();
}

void IndexWriter::finish() {
  stage_points();
  for (Statement* statement : {&stage_point_, &stage_cover_, &insert_shape_}) statement->reset();
  connection_.execute(
      "INSERT INTO point SELECT htm, id, lat, lon, name, properties FROM temp.staged ORDER BY htm, id;"
      "DROP TABLE temp.staged;"
      "INSERT INTO cover SELECT DISTINCT htm, level, id FROM temp.staged_cover ORDER BY htm, level, id;"
      "DROP TABLE temp.staged_cover;"
      "INSERT INTO name SELECT folded_name(name), htm, id FROM point WHERE name <> '' UNION ALL "
      "SELECT folded_name(name), 0, id FROM shape WHERE name <> '' ORDER BY 1, 2, 3;");
  write_about(connection_, about_);
  connection_.execute("COMMIT");
  file_.publish();
}

}  // namespace globe::search
