#include "tests/bench/search/rtree.h"

#include <cmath>
#include <string_view>

#include "globe/search/sqlite.h"
#include "tests/bench/search/ruler.h"

namespace bench {
namespace {

using globe::search::Connection;
using globe::search::Statement;

constexpr double kDegrees = 180.0 / M_PI;

class RTree final : public Finder {
 public:
  explicit RTree(const std::filesystem::path& path)
      : connection_(open(path)),
        box_(connection_,
             "SELECT id, lat, lon FROM place WHERE south <= ? AND north >= ? AND west <= ? AND east >= ?") {}

  Answer within(const Point& near, double radius_m) override {
    const Ruler ruler(near);
    Answer answer;
    const double angle = Ruler::angle_of(radius_m);
    const double south = near.lat_deg - angle * kDegrees, north = near.lat_deg + angle * kDegrees;
    // Half the width in longitude: that of a cap on the sphere of normals, everything if it holds a pole.
    double width = 180.0;
    if (south > -90.0 && north < 90.0)
      width = std::asin(std::min(1.0, std::sin(angle) / std::cos(near.lat_deg / kDegrees))) * kDegrees + 1e-9;
    const auto look = [&](double west, double east) {
      box_.with(north, south, east, west);
      while (box_.step()) {
        const double distance_m = ruler.distance_m({box_.real(1), box_.real(2)});
        if (distance_m <= radius_m) answer.emplace_back(distance_m, box_.integer(0));
      }
    };
    const double west = near.lon_deg - width, east = near.lon_deg + width;
    look(std::max(west, -180.0), std::min(east, 180.0));
    if (width < 180.0 && west < -180.0) look(west + 360.0, 180.0);
    if (width < 180.0 && east > 180.0) look(-180.0, east - 360.0);
    std::sort(answer.begin(), answer.end());
    return answer;
  }

  /// In circles twice as wide each, until the last of the nearest is inside.
  Answer nearest(const Point& near, std::size_t count) override {
    constexpr double kFirst_m = 2000.0, kWidest_m = 3e7;
    for (double radius_m = kFirst_m;; radius_m *= 2.0) {
      Answer answer = within(near, radius_m);
      if (answer.size() < count && radius_m < kWidest_m) continue;
      if (answer.size() > count) answer.resize(count);
      return answer;
    }
  }

 private:
  static Connection open(const std::filesystem::path& path) {
    Connection connection = Connection::open_read_only(path);
    sqlite3_db_config(connection.handle(), SQLITE_DBCONFIG_TRUSTED_SCHEMA, 1, nullptr);
    connection.execute("PRAGMA cache_size = -65536; BEGIN");
    return connection;
  }

  Connection connection_;
  Statement box_;
};

}  // namespace

void build_rtree(const std::filesystem::path& path, std::uint64_t count) {
  Connection connection = Connection::create(path);
  connection.execute(
      "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; PRAGMA cache_size = -65536; BEGIN;"
      "CREATE VIRTUAL TABLE place USING rtree(id, south, north, west, east, +lat REAL, +lon REAL, +name "
      "TEXT)");
  Statement insert(connection, "INSERT INTO place VALUES(?, ?, ?, ?, ?, ?, ?, ?)");
  for_each_point(count, [&](std::int64_t id, const Point& at, const std::string& name) {
    insert
        .with(id, at.lat_deg, at.lat_deg, at.lon_deg, at.lon_deg, at.lat_deg, at.lon_deg,
              std::string_view(name))
        .step();
  });
  insert.reset();
  connection.execute("COMMIT");
}

std::unique_ptr<Finder> open_rtree(const std::filesystem::path& path) {
  return std::make_unique<RTree>(path);
}

}  // namespace bench
