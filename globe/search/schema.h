#pragma once

#include <array>
#include <cstdint>

#include "globe/geo/ellipsoid.h"
#include "globe/search/sqlite.h"

namespace globe::search {

/// HTM level of the ids in a database: trixels about 10 m wide on the Earth.
inline constexpr int kIndexLevel = 20;

/// The tables of a database, as SQLite keeps their text. Rows of `point` and `cover` lie in the order of
/// their HTM ids, so that a range of ids is one scan. The same in SQL:
///
///     SELECT name, lat, lon FROM point WHERE htm BETWEEN first AND last
///
/// with `first` and `last` from globe cover --level 20.
///
/// about   what the database is: see About
/// point   features that are one point
/// shape   all others; lat, lon: a place of it; geometry: a GeometryCollection in well-known binary
/// cover   trixels that together hold each shape: the first level-20 id in the trixel, and its level
/// name    the names folded (folded_name.h); htm is 0 for shapes
inline constexpr std::array<const char*, 5> kTables{
    "CREATE TABLE about(key TEXT PRIMARY KEY, value) WITHOUT ROWID",
    "CREATE TABLE point(htm INTEGER NOT NULL, id INTEGER NOT NULL, lat REAL NOT NULL, lon REAL NOT NULL, "
    "name TEXT NOT NULL, properties TEXT NOT NULL, PRIMARY KEY(htm, id)) WITHOUT ROWID",
    "CREATE TABLE shape(id INTEGER PRIMARY KEY, lat REAL NOT NULL, lon REAL NOT NULL, name TEXT NOT NULL, "
    "properties TEXT NOT NULL, geometry BLOB NOT NULL)",
    "CREATE TABLE cover(htm INTEGER NOT NULL, level INTEGER NOT NULL, id INTEGER NOT NULL, "
    "PRIMARY KEY(htm, level, id)) WITHOUT ROWID",
    "CREATE TABLE name(folded TEXT NOT NULL, htm INTEGER NOT NULL, id INTEGER NOT NULL, "
    "PRIMARY KEY(folded, htm, id)) WITHOUT ROWID",
};

/// What a database says of itself.
struct About {
  geo::Ellipsoid ellipsoid = geo::kWgs84;
  std::uint64_t points = 0, shapes = 0;
};

/// Makes the tables in an empty database.
void create_tables(Connection& connection);

/// Fills `about`, and says in the file's header what the file is.
void write_about(Connection& connection, const About& about);

/// Throws Error when the file is no SQLite database, not one of ours, of a newer version, or damaged.
About read_about(Connection& connection, const std::filesystem::path& path);

}  // namespace globe::search
