#include "globe/search/open_database.h"

namespace globe::search {
namespace {

const std::string kPoints = "SELECT htm, id, lat, lon, name, properties FROM point ";
const std::string kShapes = "SELECT 0, id, lat, lon, name, properties, geometry FROM shape ";

/// Opens for one long read, so that all questions see the same state.
Connection open(const std::filesystem::path& path) {
  Connection connection = Connection::open_read_only(path);
  connection.execute("PRAGMA cell_size_check = ON; PRAGMA cache_size = -65536; BEGIN");
  return connection;
}

}  // namespace

OpenDatabase::OpenDatabase(const std::filesystem::path& file)
    : path(file),
      connection(open(file)),
      about(read_about(connection, file)),
      earth(about.ellipsoid.a, about.ellipsoid.f),
      all_points(connection, kPoints),
      points_between(connection, kPoints + "WHERE htm BETWEEN ? AND ?"),
      points_from(connection, kPoints + "WHERE htm >= ? ORDER BY htm, id"),
      points_before(connection, kPoints + "WHERE htm < ? ORDER BY htm DESC, id DESC"),
      one_point(connection, kPoints + "WHERE htm = ? AND id = ?"),
      all_shapes(connection, kShapes),
      one_shape(connection, kShapes + "WHERE id = ?"),
      covers_between(connection, "SELECT id FROM cover WHERE htm BETWEEN ? AND ?"),
      covers_of(connection, "SELECT id FROM cover WHERE htm = ? AND level = ?"),
      names_from(connection, "SELECT folded, htm, id FROM name WHERE folded >= ? ORDER BY folded") {}

Error OpenDatabase::damage(const std::string& what) const {
  return {path.string(), "it is damaged (" + what + ")", "index the features again"};
}

}  // namespace globe::search
