#include "globe/search/feature_index.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "globe/base/error.h"
#include "globe/geo/geodesic_circle.h"
#include "globe/htm/complement.h"
#include "globe/htm/cone.h"
#include "globe/htm/polygon.h"
#include "globe/region/ellipsoid_cone.h"
#include "globe/region/lat_lon_box.h"
#include "globe/search/index_writer.h"
#include "globe/search/shape.h"
#include "tests/temporary_folder.h"

namespace globe::search {
namespace {

using geo::Geodetic;
using RegionPointer = std::shared_ptr<const htm::Region>;

constexpr geo::Ellipsoid kEarth = geo::kWgs84;

struct Place {
  double lat_deg, lon_deg;
  std::string name, properties;
};

NewFeature feature_of(const Place& place) {
  NewFeature feature;
  feature.geometry.points.push_back({place.lat_deg, place.lon_deg, 0.0});
  feature.name = place.name;
  feature.properties = place.properties;
  return feature;
}

/// A database of places in a folder of its own, and the same places in memory.
class Places {
 public:
  explicit Places(std::vector<Place> places, const geo::Ellipsoid& ellipsoid = kEarth)
      : places_(std::move(places)), ellipsoid_(ellipsoid) {
    IndexWriter writer(folder_ / "places.db", ellipsoid, false);
    for (const Place& place : places_) writer.add(feature_of(place));
    writer.finish();
    index_.emplace(folder_ / "places.db");
  }

  const std::vector<Place>& all() const { return places_; }
  FeatureIndex& index() { return *index_; }

  /// (distance, id) of every place that passes, by looking at all of them.
  std::vector<std::pair<double, std::int64_t>> by_looking_at_all(
      const Query& query, const std::function<bool(const Place&)>& also) const {
    std::vector<std::pair<double, std::int64_t>> found;
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const Place& place = places_[k];
      double distance_m = 0;
      if (query.near)
        distance_m = geo::geodesic_distance_m(ellipsoid_, *query.near, {place.lat_deg, place.lon_deg, 0.0});
      bool passes = !query.radius_m || distance_m <= *query.radius_m;
      for (const auto& region : query.regions)
        passes = passes && region->contains(geo::normal_from_degrees(place.lat_deg, place.lon_deg));
      if (passes && also(place)) found.emplace_back(distance_m, static_cast<std::int64_t>(k) + 1);
    }
    std::sort(found.begin(), found.end());
    if (query.count && found.size() > *query.count) found.resize(*query.count);
    return found;
  }

  void expect_same(
      const Query& query, const std::function<bool(const Place&)>& also = [](const Place&) { return true; }) {
    std::vector<std::pair<double, std::int64_t>> seen;
    for (const Hit& hit : index_->find(query)) seen.emplace_back(hit.distance_m, hit.id);
    EXPECT_EQ(seen, by_looking_at_all(query, also));
  }

 private:
  std::vector<Place> places_;
  geo::Ellipsoid ellipsoid_;
  tests::TemporaryFolder folder_;
  std::optional<FeatureIndex> index_;
};

/// Places everywhere, more of them by the poles, the antimeridian, octahedron corners and in heaps; some
/// twice.
std::vector<Place> random_places(std::size_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const std::vector<Place> heaps{{90, 0, "", ""},      {-90, 0, "", ""}, {0, -180, "", ""},
                                 {0, 0, "", ""},       {0, 90, "", ""},  {48.2, 16.4, "", ""},
                                 {-77, 179.9, "", ""}, {45, -45, "", ""}};
  std::vector<Place> places;
  while (places.size() < count) {
    const double kind = unit(random);
    Place place{};
    if (kind < 0.4) {
      place.lat_deg = std::asin(2.0 * unit(random) - 1.0) * (180.0 / M_PI);
      place.lon_deg = 360.0 * unit(random) - 180.0;
    } else if (kind < 0.95) {
      place = heaps[random() % heaps.size()];
      const double spread = std::pow(10.0, -7.0 + 8.0 * unit(random));
      place.lat_deg = std::clamp(place.lat_deg + spread * (unit(random) - 0.5), -90.0, 90.0);
      place.lon_deg += spread * (unit(random) - 0.5);
      if (std::abs(place.lat_deg) > 89.0) place.lon_deg = 360.0 * unit(random);
    } else if (!places.empty()) {
      place = places[random() % places.size()];
    }
    place.name = std::string(1, static_cast<char>('a' + random() % 26)) + std::to_string(random() % 100);
    place.properties = "{\"kind\":" + std::to_string(random() % 10) + "}";
    places.push_back(place);
  }
  return places;
}

/// A point to ask from: one of the places, beside one, or anywhere.
Geodetic random_point(const std::vector<Place>& places, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const Place& place = places[random() % places.size()];
  switch (random() % 4) {
    case 0:
      return {place.lat_deg, std::remainder(place.lon_deg, 360.0), 0.0};
    case 1:
      return {std::clamp(place.lat_deg + 0.01 * (unit(random) - 0.5), -90.0, 90.0), place.lon_deg, 0.0};
    case 2:
      return {random() % 2 == 0 ? 90.0 : -90.0, 0.0, 0.0};
    default:
      return {180.0 * unit(random) - 90.0, 360.0 * unit(random) - 180.0, 0.0};
  }
}

RegionPointer random_region(const std::vector<Place>& places, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const Geodetic at = random_point(places, random);
  const double size_deg = std::pow(10.0, -4.0 + 6.0 * unit(random));
  RegionPointer region;
  switch (random() % 4) {
    case 0:
      region = std::make_shared<htm::Cone>(geo::normal_from_degrees(at.lat_deg, at.lon_deg),
                                           std::min(size_deg, 180.0));
      break;
    case 1:
      region = std::make_shared<region::EllipsoidCone>(kEarth, at, size_deg * 111e3);
      break;
    case 2:
      region =
          std::make_shared<region::LatLonBox>(at.lon_deg - size_deg, std::max(at.lat_deg - size_deg, -90.0),
                                              at.lon_deg + size_deg, std::min(at.lat_deg + size_deg, 90.0));
      break;
    default: {
      htm::Polygon::Ring ring;
      const auto frame = geo::local_frame(at.lat_deg, at.lon_deg);
      const double reach = std::min(size_deg, 60.0) * (M_PI / 180.0);
      for (int k = 0; k < 7; ++k) {
        const double angle = 2.0 * M_PI * k / 7.0, r = reach * (0.3 + 0.7 * unit(random));
        ring.push_back(glm::normalize(
            frame.up + std::tan(r) * (std::cos(angle) * frame.east + std::sin(angle) * frame.north)));
      }
      region = std::make_shared<htm::Polygon>(htm::Polygon::Rings{ring});
    }
  }
  if (random() % 6 == 0) region = std::make_shared<htm::Complement>(region);
  return region;
}

TEST(FeatureIndex, AgreesWithALookAtAllPlaces) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Places places(random_places(5000, random));
  const std::size_t queries = std::getenv("GLOBE_TEST_FULL") != nullptr ? 5000 : 150;
  for (std::size_t k = 0; k < queries; ++k) {
    SCOPED_TRACE("query " + std::to_string(k));
    Query query;
    if (random() % 3 != 0) query.near = random_point(places.all(), random);
    if (query.near && random() % 2 == 0) query.radius_m = std::pow(10.0, 0.0 + 7.4 * unit(random));
    for (std::size_t n = random() % 3; n > 0; --n)
      query.regions.push_back(random_region(places.all(), random));
    if (random() % 2 == 0) query.count = 1 + random() % 30;
    std::string prefix;
    if (random() % 3 == 0) prefix = std::string(1, static_cast<char>('a' + random() % 26));
    query.name_prefix = prefix;
    const bool by_kind = random() % 3 == 0;
    if (by_kind) query.properties.emplace_back("kind", "3");
    places.expect_same(query, [&](const Place& place) {
      return place.name.starts_with(prefix) && (!by_kind || place.properties == "{\"kind\":3}");
    });
  }
}

TEST(FeatureIndex, TheRadiusIncludesWhatLiesOnIt) {
  std::mt19937_64 random(2);
  Places places(random_places(500, random));
  for (int k = 0; k < 100; ++k) {
    Query query;
    query.near = random_point(places.all(), random);
    const Place& on_it = places.all()[random() % places.all().size()];
    query.radius_m = geo::geodesic_distance_m(kEarth, *query.near, {on_it.lat_deg, on_it.lon_deg, 0.0});
    places.expect_same(query);
    const std::vector<Hit> hits = places.index().find(query);
    ASSERT_FALSE(hits.empty());
    EXPECT_EQ(hits.back().distance_m, *query.radius_m);
    query.radius_m = std::nextafter(*query.radius_m, 0.0);
    places.expect_same(query);
  }
}

TEST(FeatureIndex, TheNearestAreRightWhateverTheirNumber) {
  std::mt19937_64 random(3);
  Places places(random_places(3000, random));
  for (const std::size_t count : {1u, 2u, 10u, 100u, 2999u, 3000u, 5000u}) {
    for (int k = 0; k < 8; ++k) {
      Query query;
      query.near = random_point(places.all(), random);
      query.count = count;
      places.expect_same(query);
    }
  }
}

TEST(FeatureIndex, WorksOnOtherEllipsoids) {
  std::mt19937_64 random(4);
  for (const geo::Ellipsoid& ellipsoid : {geo::kMoon, geo::kMars, geo::Ellipsoid{1000.0, -0.1}}) {
    Places places(random_places(500, random), ellipsoid);
    EXPECT_EQ(places.index().ellipsoid(), ellipsoid);
    for (int k = 0; k < 20; ++k) {
      Query query;
      query.near = random_point(places.all(), random);
      query.count = 7;
      places.expect_same(query);
      query.count.reset();
      query.radius_m = 0.3 * ellipsoid.a;
      places.expect_same(query);
    }
  }
}

TEST(FeatureIndex, DuplicatesAreFeaturesOfTheirOwn) {
  Places places({{10, 20, "a", ""}, {10, 20, "a", ""}, {10, 20, "a", ""}});
  Query query;
  query.near = Geodetic{10, 20, 0};
  query.radius_m = 0.0;
  EXPECT_EQ(places.index().find(query).size(), 3u);
  query.count = 2;
  places.expect_same(query);
}

TEST(FeatureIndex, NothingAnswersNothing) {
  Places places({});
  EXPECT_EQ(places.index().size(), 0u);
  Query query;
  EXPECT_TRUE(places.index().find(query).empty());
  query.near = Geodetic{10, 20, 0};
  query.count = 3;
  EXPECT_TRUE(places.index().find(query).empty());
  query.name_prefix = "a";
  EXPECT_TRUE(places.index().find(query).empty());
}

TEST(FeatureIndex, NamesAreFoundByTheirBeginningInAnyCase) {
  Places places({{1, 1, "Österreich", ""},
                 {2, 2, "ÖSTERSUND", ""},
                 {3, 3, "Oslo", ""},
                 {4, 4, "O'Hare \"%_\"", ""},
                 {5, 5, "", ""}});
  const auto ids = [&](const std::string& prefix) {
    Query query;
    query.name_prefix = prefix;
    std::vector<std::int64_t> found;
    for (const Hit& hit : places.index().find(query)) found.push_back(hit.id);
    return found;
  };
  EXPECT_EQ(ids("öster"), (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(ids("o'hare \"%"), (std::vector<std::int64_t>{4}));
  EXPECT_EQ(ids("%"), (std::vector<std::int64_t>{}));
  EXPECT_EQ(ids("'; DROP TABLE point; --"), (std::vector<std::int64_t>{}));
  EXPECT_EQ(ids("\xff"), (std::vector<std::int64_t>{}));
  EXPECT_EQ(ids("").size(), 5u);
}

TEST(FeatureIndex, GivesBackWhatWasPutIn) {
  Places places({{-90, 720, "Pole", "{\"a\":1}"}, {12.5, 180.0, "", ""}});
  const std::vector<Hit> hits = places.index().find({});
  EXPECT_EQ(hits[0].lat_deg, -90.0);
  EXPECT_EQ(hits[0].lon_deg, 0.0);
  EXPECT_EQ(hits[1].lon_deg, -180.0);
  EXPECT_EQ(places.index().read(hits[0]).name, "Pole");
  EXPECT_EQ(places.index().read(hits[0]).properties, "{\"a\":1}");
  EXPECT_EQ(places.index().read(hits[1]).name, "");
}

/// Lines and polygons of all sizes.
std::vector<geo::Geometry> random_shapes(std::size_t count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const std::vector<Place> places = random_places(count, random);
  std::vector<geo::Geometry> shapes;
  for (const Place& place : places) {
    const auto frame = geo::local_frame(place.lat_deg, place.lon_deg);
    const double size = std::pow(10.0, -6.0 + 6.0 * unit(random));
    const int corners = 3 + static_cast<int>(random() % 5);
    geo::Geometry::Line line;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2.0 * M_PI * k / corners, r = size * (0.3 + 0.7 * unit(random));
      line.push_back(geo::degrees_from_normal(
          frame.up + r * (std::cos(angle) * frame.east + std::sin(angle) * frame.north)));
    }
    shapes.emplace_back();
    switch (random() % 3) {
      case 0:
        shapes.back().polygons.push_back({line});
        break;
      case 1:
        shapes.back().lines.push_back(line);
        break;
      default:
        shapes.back().points = line;
    }
  }
  return shapes;
}

TEST(FeatureIndex, LinesAndPolygonsAgreeWithALookAtAllOfThem) {
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const std::vector<geo::Geometry> shapes = random_shapes(400, random);
  const std::vector<Place> places = random_places(400, random);
  const tests::TemporaryFolder folder;
  IndexWriter writer(folder / "a.db", kEarth, false);
  for (const Place& place : places) writer.add(feature_of(place));
  for (const geo::Geometry& geometry : shapes) writer.add({geometry, "shape", ""});
  writer.finish();
  FeatureIndex index(folder / "a.db");
  const GeographicLib::Geodesic earth(kEarth.a, kEarth.f);
  const int queries = std::getenv("GLOBE_TEST_FULL") != nullptr ? 3000 : 120;
  std::size_t found = 0;
  for (int k = 0; k < queries; ++k) {
    SCOPED_TRACE("query " + std::to_string(k));
    Query query;
    if (k % 3 != 0) query.near = random_point(places, random);
    if (query.near && k % 2 == 0) query.radius_m = std::pow(10.0, 1.0 + 6.3 * unit(random));
    if (k % 3 != 1 || k % 7 == 0) query.regions.push_back(random_region(places, random));
    if (k % 5 == 0) query.count = 1 + random() % 20;
    std::vector<std::pair<double, std::int64_t>> expected;
    for (std::size_t n = 0; n < shapes.size(); ++n) {
      const Shape shape(shapes[n]);
      const double distance_m = query.near ? shape.nearest(earth, *query.near).distance_m : 0.0;
      if (query.radius_m && distance_m > *query.radius_m) continue;
      if (query.regions.empty() || shape.touches(*query.regions[0]))
        expected.emplace_back(distance_m, static_cast<std::int64_t>(places.size() + n) + 1);
    }
    for (std::size_t n = 0; n < places.size(); ++n) {
      const Place& place = places[n];
      const double distance_m =
          query.near ? geo::geodesic_distance_m(kEarth, *query.near, {place.lat_deg, place.lon_deg, 0.0})
                     : 0.0;
      if (query.radius_m && distance_m > *query.radius_m) continue;
      if (query.regions.empty() ||
          query.regions[0]->contains(geo::normal_from_degrees(place.lat_deg, place.lon_deg)))
        expected.emplace_back(distance_m, static_cast<std::int64_t>(n) + 1);
    }
    std::sort(expected.begin(), expected.end());
    if (query.count && expected.size() > *query.count) expected.resize(*query.count);
    std::vector<std::pair<double, std::int64_t>> seen;
    for (const Hit& hit : index.find(query)) seen.emplace_back(hit.distance_m, hit.id);
    EXPECT_EQ(seen, expected);
    found += seen.size();
  }
  EXPECT_GT(found, 100u);
}

TEST(FeatureIndex, AShapeMayPassEachTestAtAnotherPlace) {
  const tests::TemporaryFolder folder;
  IndexWriter writer(folder / "a.db", kEarth, false);
  NewFeature road;
  road.geometry.lines.push_back({{10, 0, 0}, {10, 40, 0}});
  writer.add(std::move(road));
  writer.finish();
  FeatureIndex index(folder / "a.db");
  Query query;
  query.near = Geodetic{10, 0.5, 0};
  query.radius_m = 100e3;
  query.regions.push_back(std::make_shared<region::LatLonBox>(39, 9, 41, 11));
  EXPECT_EQ(index.find(query).size(), 1u);
  query.regions.push_back(std::make_shared<region::LatLonBox>(19, 9, 21, 12));
  EXPECT_EQ(index.find(query).size(), 1u);
  query.regions.push_back(std::make_shared<region::LatLonBox>(19, -12, 21, -9));
  EXPECT_TRUE(index.find(query).empty());
}

std::string refusal(const std::filesystem::path& path) {
  try {
    FeatureIndex index(path);
    index.find({});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(FeatureIndex, RefusesWhatIsNoneOfItsDatabases) {
  const tests::TemporaryFolder folder;
  EXPECT_NE(refusal(folder / "missing.db").find("there is no such file"), std::string::npos);
  EXPECT_NE(refusal(folder.path()).find("it is a folder"), std::string::npos);
  std::ofstream(folder / "text.db") << std::string(5000, 'x');
  EXPECT_NE(refusal(folder / "text.db").find("no SQLite file"), std::string::npos);
  std::ofstream(folder / "empty.db") << "";
  EXPECT_NE(refusal(folder / "empty.db").find("no database of features"), std::string::npos);
  Connection other = Connection::create(folder / "other.db");
  other.execute("CREATE TABLE point(x)");
  EXPECT_NE(refusal(folder / "other.db").find("no database of features"), std::string::npos);
}

TEST(FeatureIndex, RefusesNewerVersionsAndOtherTables) {
  const tests::TemporaryFolder folder;
  const auto changed = [&](const char* sql) {
    {
      IndexWriter writer(folder / "a.db", kEarth, true);
      writer.add(feature_of({1, 2, "a", ""}));
      writer.finish();
    }
    EXPECT_EQ(refusal(folder / "a.db"), "");
    sqlite3* handle = nullptr;
    EXPECT_EQ(sqlite3_open((folder / "a.db").c_str(), &handle), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(handle, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sql;
    sqlite3_close(handle);
    return refusal(folder / "a.db");
  };
  EXPECT_NE(changed("PRAGMA user_version = 2").find("version 2"), std::string::npos);
  EXPECT_NE(changed("PRAGMA user_version = 0").find("damaged"), std::string::npos);
  EXPECT_NE(changed("DROP TABLE point; CREATE VIEW point AS SELECT 1").find("damaged"), std::string::npos);
  EXPECT_NE(changed("UPDATE about SET value = -1 WHERE key = 'ellipsoid_a_m'").find("damaged"),
            std::string::npos);
  EXPECT_NE(changed("UPDATE about SET value = -1e308 WHERE key = 'ellipsoid_f'").find("damaged"),
            std::string::npos)
      << "found by fuzzing: a polar radius beyond all numbers";
  EXPECT_NE(changed("DELETE FROM about").find("damaged"), std::string::npos);
  EXPECT_NE(changed("UPDATE point SET lat = 100").find("damaged"), std::string::npos);
}

TEST(FeatureIndex, RefusesATruncatedFile) {
  const tests::TemporaryFolder folder;
  std::mt19937_64 random(5);
  IndexWriter writer(folder / "a.db", kEarth, false);
  for (const Place& place : random_places(2000, random)) writer.add(feature_of(place));
  writer.finish();
  const auto whole = std::filesystem::file_size(folder / "a.db");
  for (const double share : {0.9, 0.5, 0.1, 0.01}) {
    std::filesystem::resize_file(folder / "a.db",
                                 static_cast<std::uintmax_t>(share * static_cast<double>(whole)));
    EXPECT_NE(refusal(folder / "a.db"), "") << share;
  }
}

TEST(IndexWriter, LeavesNothingUnlessItFinishes) {
  const tests::TemporaryFolder folder;
  {
    IndexWriter writer(folder / "a.db", kEarth, false);
    writer.add(feature_of({1, 2, "a", ""}));
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  { IndexWriter(folder / "a.db", kEarth, false).finish(); }
  EXPECT_THROW(IndexWriter(folder / "a.db", kEarth, false), Error);
  EXPECT_THROW(IndexWriter(folder / "none" / "a.db", kEarth, false), Error);
  EXPECT_NO_THROW(IndexWriter(folder / "a.db", kEarth, true));
  EXPECT_EQ(refusal(folder / "a.db"), "");
}

TEST(IndexWriter, TheSameFeaturesMakeTheSameBytes) {
  const tests::TemporaryFolder folder;
  const auto make = [&](const std::string& name) {
    std::mt19937_64 random(6);
    IndexWriter writer(folder / name, kEarth, false);
    for (const Place& place : random_places(3000, random)) writer.add(feature_of(place));
    writer.finish();
    std::ifstream file(folder / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(make("a.db"), make("b.db"));
}

}  // namespace
}  // namespace globe::search
