#include "tests/bench/search/full_scan.h"

#include <cmath>
#include <string_view>

#include "globe/search/sqlite.h"
#include "tests/bench/search/ruler.h"

namespace bench {
namespace {

using globe::search::Connection;
using globe::search::Statement;

class FullScan final : public Finder {
 public:
  explicit FullScan(const std::filesystem::path& path)
      : connection_(open(path)), all_(connection_, "SELECT id, lat, lon FROM place") {}

  Answer within(const Point& near, double radius_m) override {
    const Ruler ruler(near);
    const double least_cosine = std::cos(Ruler::angle_of(radius_m)) - 1e-15;
    Answer answer;
    all_.with();
    while (all_.step()) {
      const Point at{all_.real(1), all_.real(2)};
      if (ruler.cosine(at) < least_cosine) continue;
      const double distance_m = ruler.distance_m(at);
      if (distance_m <= radius_m) answer.emplace_back(distance_m, all_.integer(0));
    }
    std::sort(answer.begin(), answer.end());
    return answer;
  }

  Answer nearest(const Point& near, std::size_t count) override {
    const Ruler ruler(near);
    NearestList list(count);
    double least_cosine = -2.0;
    all_.with();
    while (all_.step()) {
      const Point at{all_.real(1), all_.real(2)};
      if (ruler.cosine(at) < least_cosine) continue;
      list.add(ruler.distance_m(at), all_.integer(0));
      if (list.full()) least_cosine = std::cos(Ruler::angle_of(list.worst_m())) - 1e-15;
    }
    return list.sorted();
  }

 private:
  static Connection open(const std::filesystem::path& path) {
    Connection connection = Connection::open_read_only(path);
    connection.execute("PRAGMA cache_size = -65536; BEGIN");
    return connection;
  }

  Connection connection_;
  Statement all_;
};

}  // namespace

void build_table(const std::filesystem::path& path, std::uint64_t count) {
  Connection connection = Connection::create(path);
  connection.execute(
      "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF; PRAGMA cache_size = -65536; BEGIN;"
      "CREATE TABLE place(id INTEGER PRIMARY KEY, lat REAL, lon REAL, name TEXT)");
  Statement insert(connection, "INSERT INTO place VALUES(?, ?, ?, ?)");
  for_each_point(count, [&](std::int64_t id, const Point& at, const std::string& name) {
    insert.with(id, at.lat_deg, at.lon_deg, std::string_view(name)).step();
  });
  insert.reset();
  connection.execute("COMMIT");
}

std::unique_ptr<Finder> open_table(const std::filesystem::path& path) {
  return std::make_unique<FullScan>(path);
}

}  // namespace bench
