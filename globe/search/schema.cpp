#include "globe/search/schema.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "globe/base/error.h"

namespace globe::search {
namespace {

constexpr std::int64_t kApplicationId = 0x476C6265;  // "Glbe", in the file's header
constexpr std::int64_t kVersion = 1;                 // of the tables

std::int64_t pragma(Connection& connection, const char* sql) {
  Statement statement(connection, sql);
  return statement.step() ? statement.integer(0) : 0;
}

/// The text of every table and whatever else there is.
std::vector<std::string> tables_of(Connection& connection) {
  Statement statement(connection, "SELECT sql FROM sqlite_schema");
  std::vector<std::string> tables;
  while (statement.step()) tables.emplace_back(statement.bytes(0));
  return tables;
}

}  // namespace

void create_tables(Connection& connection) {
  for (const char* table : kTables) connection.execute(table);
}

void write_about(Connection& connection, const About& about) {
  Statement insert(connection, "INSERT INTO about VALUES(?, ?)");
  insert.with(std::string_view("ellipsoid_a_m"), about.ellipsoid.a).step();
  insert.with(std::string_view("ellipsoid_f"), about.ellipsoid.f).step();
  insert.with(std::string_view("points"), about.points).step();
  insert.with(std::string_view("shapes"), about.shapes).step();
  const std::string header = "PRAGMA application_id = " + std::to_string(kApplicationId) +
                             "; PRAGMA user_version = " + std::to_string(kVersion);
  connection.execute(header.c_str());
}

About read_about(Connection& connection, const std::filesystem::path& path) {
  const auto other = [&](const std::string& why) {
    return Error(path.string(), why, "give a database that globe index has made");
  };
  const auto damaged = [&](const std::string& why) {
    return Error(path.string(), "it is damaged (" + why + ")", "index the features again");
  };
  if (pragma(connection, "PRAGMA application_id") != kApplicationId)
    throw other("it is no database of features");
  const std::int64_t version = pragma(connection, "PRAGMA user_version");
  if (version > kVersion) {
    throw Error(path.string(),
                "it has version " + std::to_string(version) + ", this globe knows those up to " +
                    std::to_string(kVersion),
                "update globe, or index the features again");
  }
  const std::vector<std::string> tables = tables_of(connection);
  if (version < 1 || !std::is_permutation(kTables.begin(), kTables.end(), tables.begin(), tables.end()))
    throw damaged("its tables are not those of version " + std::to_string(kVersion));
  Statement select(connection, "SELECT value FROM about WHERE key = ?");
  const auto value = [&](const char* key) {
    if (!select.with(std::string_view(key)).step()) throw damaged(std::string(key) + " is missing");
    return select.real(0);
  };
  About about;
  const double a = value("ellipsoid_a_m"), f = value("ellipsoid_f");
  const double points = value("points"), shapes = value("shapes");
  constexpr double kMost = 0x1p53;
  if (!(points >= 0.0 && points <= kMost && shapes >= 0.0 && shapes <= kMost))
    throw damaged("its counts make no sense");
  try {
    about.ellipsoid = geo::make_ellipsoid(a, f);
  } catch (const UsageError&) {
    throw damaged("its ellipsoid makes no sense");
  }
  about.points = static_cast<std::uint64_t>(points);
  about.shapes = static_cast<std::uint64_t>(shapes);
  return about;
}

}  // namespace globe::search
