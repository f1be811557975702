// Heights at known summits, trenches and shores, against the map that they come from at its own resolution.

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "converters/convert.h"
#include "globe/planet/interpolation.h"
#include "globe/planet/summary.h"
#include "globe/region/lat_lon_box.h"
#include "tests/hard/table.h"
#include "tests/node_planet.h"
#include "tests/temporary_folder.h"

namespace {

using converters::Filter;
using globe::geo::dvec3;
using globe::geo::Geodetic;
using globe::planet::Node;
using globe::planet::Surface;

constexpr int kLevel = 10;
constexpr double kFloatSamples_m = 0.05;  ///< the converter filters in floats: 1e-7 of 21 km, a few times

/// Between nodes up to a pixel apart the map has kinks, at the centres of its pixels.
constexpr double kReliefShare = 0.25;

/// A map of a whole planet, pixels areas, north row first.
struct Map {
  int width = 0, height = 0;
  double west_deg = 0;
  std::vector<float> values;

  double step_deg() const { return 360.0 / width; }
  double at(int x, int y) const {
    x = ((x % width) + width) % width;
    return static_cast<double>(
        values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)]);
  }
  /// Columns and rows from the first pixel's centre.
  double column(const Geodetic& place) const {
    return std::fmod(place.lon_deg - west_deg + 720.0, 360.0) / step_deg() - 0.5;
  }
  double row(const Geodetic& place) const { return (90.0 - place.lat_deg) / step_deg() - 0.5; }
  double nearest(const Geodetic& place) const {
    return at(static_cast<int>(std::floor(column(place) + 0.5)),
              std::clamp(static_cast<int>(std::floor(row(place) + 0.5)), 0, height - 1));
  }
  /// Highest less lowest of the 3 x 3 pixels around a place. REQUIRES: two pixels from the poles.
  double relief(const Geodetic& place) const {
    const int x = static_cast<int>(std::floor(column(place) + 0.5)),
              y = static_cast<int>(std::floor(row(place) + 0.5));
    double low = at(x, y), high = low;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        low = std::min(low, at(x + dx, y + dy));
        high = std::max(high, at(x + dx, y + dy));
      }
    }
    return high - low;
  }
  /// REQUIRES: at least half a pixel from the poles.
  double bilinear(const Geodetic& place) const {
    const double x = column(place), y = row(place);
    const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
    const double fx = x - x0, fy = y - y0;
    return (1 - fy) * ((1 - fx) * at(x0, y0) + fx * at(x0 + 1, y0)) +
           fy * ((1 - fx) * at(x0, y0 + 1) + fx * at(x0 + 1, y0 + 1));
  }
};

struct Spot {
  const char* name;
  double lat_deg, lon_deg, value_m;  ///< as shared/data/README.md has them
};

struct Body {
  const char* name;
  const char* file;
  globe::geo::Ellipsoid ellipsoid;
  double west_deg;
  std::vector<Spot> spots;
};

const std::vector<Body> kBodies{{"Earth",
                                 "earth/earth_etopo20_f32.tif",
                                 globe::geo::kWgs84,
                                 -180,
                                 {{"Everest's cell", 27.99, 86.92, 5386.125},
                                  {"Challenger Deep", 11.35, 142.2, -7148.75},
                                  {"Dead Sea", 31.5, 35.5, -40.94},
                                  {"Denver", 39.7, -105, 1619.19},
                                  {"near the south pole", -89.9, 0.1, 2774.0},
                                  {"near the north pole", 89.9, 0.1, -4288.375}}},
                                {"Moon",
                                 "moon/moon_gld100_12.8ppd_int16.tif",
                                 globe::geo::kMoon,
                                 0,
                                 {{"highest point", 5.44, 201.4, 10757},
                                  {"Antoniadi, lowest", -70.37, 187.55, -9052},
                                  {"Tycho's floor", -43.3, 348.8, -2746},
                                  {"Apollo 15", 26.13, 3.63, -1923},
                                  {"South Pole-Aitken", -53, 190.5, -7192}}},
                                {"Mars",
                                 "mars/megt90n000cb.img",
                                 globe::geo::kMars,
                                 0,
                                 {{"highest point", 17.375, 226.875, 21134},
                                  {"lowest point", -32.875, 62.125, -8068},
                                  {"Olympus Mons", 18.65, 226.2, 20009},
                                  {"Hellas", -42.4, 70.5, -6151},
                                  {"Gale", -5.4, 137.8, -893},
                                  {"Elysium Mons", 25.02, 147.21, 10244},
                                  {"near the north pole", 89.9, 0.1, -1971}}}};

Map read_map(const Body& body, const std::filesystem::path& path) {
  Map map;
  map.west_deg = body.west_deg;
  if (path.extension() == ".img") {  // MOLA: 16 bits, big end first, no header
    map.width = 1440, map.height = 720;
    std::ifstream in(path, std::ios::binary);
    for (int k = 0; k < map.width * map.height; ++k) {
      const int high = in.get(), low = in.get();
      map.values.push_back(static_cast<std::int16_t>(high << 8 | low));
    }
    EXPECT_TRUE(in.good()) << path;
    return map;
  }
  const auto input = OIIO::ImageInput::open(path.string());
  map.width = input->spec().width, map.height = input->spec().height;
  map.values.resize(static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height));
  EXPECT_TRUE(input->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, map.values.data()));
  if (input->spec().format == OIIO::TypeDesc::INT16) {  // OpenImageIO scales integers to [-1, 1]
    for (float& value : map.values) value = std::round(value * 32767.0F);
  }
  return map;
}

std::filesystem::path write_map(const Map& map, const std::filesystem::path& path) {
  const auto output = OIIO::ImageOutput::create(path.string());
  EXPECT_TRUE(output->open(path.string(), OIIO::ImageSpec(map.width, map.height, 1, OIIO::TypeDesc::FLOAT)));
  EXPECT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, map.values.data()) && output->close());
  return path;
}

std::shared_ptr<const Surface> convert(const Body& body, const std::filesystem::path& map, Filter filter,
                                       const std::filesystem::path& planet, bool as_thesis = false) {
  converters::ConvertOptions options;
  options.heights = {
      converters::MapInput{map, converters::Extent{body.west_deg, -90, body.west_deg + 360, 90}}};
  options.filter = filter;
  options.level = kLevel;
  options.planet = planet;
  options.ellipsoid = body.ellipsoid;
  options.as_thesis = as_thesis;
  converters::convert(options, {});
  return tests::open_surface(planet);
}

/// The nodes of the trixel that holds a place.
std::vector<Node> nodes_around(const dvec3& u) {
  const auto place = globe::planet::locate(u, kLevel);
  const int last = globe::planet::nodes_per_side(kLevel) - 1;
  const int i = std::min(static_cast<int>(place.ij.x), last),
            j = std::min(static_cast<int>(place.ij.y), last);
  const auto at = [&](int x, int y) { return Node{place.d, kLevel, x, y}; };
  if (place.ij.x - i + place.ij.y - j <= 1.0) return {at(i, j), at(i + 1, j), at(i, j + 1)};
  return {at(i + 1, j + 1), at(i, j + 1), at(i + 1, j)};
}

bool near_a_pole(const Map& map, const Geodetic& place) {
  return std::abs(place.lat_deg) > 90.0 - map.step_deg();
}

/// Farther than rounding from the border between two pixels.
bool is_in_one_pixel(const Map& map, const Geodetic& place) {
  const auto off = [](double x) { return std::abs(x - 0.5 - std::round(x - 0.5)); };
  return off(map.column(place)) > 1e-9 && off(map.row(place)) > 1e-9;
}

class HardKnownPlaces : public testing::TestWithParam<std::size_t> {
 protected:
  void SetUp() override {
    const std::filesystem::path path = std::filesystem::path(GLOBE_DATA_DIR) / body().file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "SAMPLE MAP MISSING: " << path;
    map_ = read_map(body(), path);
    copy_ = write_map(map_, folder_ / "map.tif");
  }
  const Body& body() const { return kBodies[GetParam()]; }

  tests::TemporaryFolder folder_;
  Map map_;
  std::filesystem::path copy_;
};

TEST_P(HardKnownPlaces, NodesAroundThemHaveTheValueOfTheirPixel) {
  const auto surface = convert(body(), copy_, Filter::kNearest, folder_ / "nearest");
  int nodes = 0, wrong = 0;
  for (const Spot& spot : body().spots) {
    const Geodetic place{spot.lat_deg, spot.lon_deg};
    EXPECT_NEAR(map_.nearest(place), spot.value_m, 0.006) << spot.name << ": the map is another one";
    for (const Node& node : nodes_around(globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg))) {
      const Geodetic at = globe::geo::degrees_from_normal(globe::planet::node_direction(node));
      if (!is_in_one_pixel(map_, at)) continue;
      ++nodes;
      wrong += surface->height(node) != map_.nearest(at);
      EXPECT_EQ(surface->height(node), map_.nearest(at)) << spot.name;
    }
  }
  EXPECT_GE(nodes, static_cast<int>(body().spots.size()));
  hard::report("places",
               std::string(body().name) + ": nodes around known places off their pixel's value, of " +
                   std::to_string(nodes),
               "0", std::to_string(wrong));
}

TEST_P(HardKnownPlaces, InterpolatedHeightsAreThoseOfTheMap) {
  const auto surface = convert(body(), copy_, Filter::kBilinear, folder_ / "bilinear");
  double worst_node = 0, worst_share = 0;
  for (const Spot& spot : body().spots) {
    const Geodetic place{spot.lat_deg, spot.lon_deg};
    const dvec3 u = globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg);
    for (const Node& node : nodes_around(u)) {
      const Geodetic at = globe::geo::degrees_from_normal(globe::planet::node_direction(node));
      if (near_a_pole(map_, at)) continue;
      worst_node = std::max(worst_node, std::abs(surface->height(node) - map_.bilinear(at)));
    }
    if (near_a_pole(map_, place)) continue;
    const double height_m = height_at(*surface, u, kLevel, globe::planet::Interpolation::kLinear).height_m;
    const double share = std::abs(height_m - map_.bilinear(place)) / map_.relief(place);
    EXPECT_LE(share, kReliefShare) << spot.name;
    worst_share = std::max(worst_share, share);
  }
  EXPECT_LE(worst_node, kFloatSamples_m);
  hard::report("places", std::string(body().name) + ": nodes against the map, m", "0.05",
               hard::figure(worst_node));
  hard::report("places",
               std::string(body().name) + ": heights against the map, of the relief of 3 x 3 pixels",
               hard::figure(kReliefShare), hard::figure(worst_share));
}

INSTANTIATE_TEST_SUITE_P(Bodies, HardKnownPlaces, testing::Values(0, 1, 2),
                         [](const auto& body) { return kBodies[body.param].name; });

/// Where a function of the way from one place to another first becomes positive: degrees from the start.
template <typename Height>
double first_land(const Geodetic& from, double degrees_east, const Height& height) {
  constexpr double kStep_deg = 0.002;
  for (double way = 0; way < degrees_east; way += kStep_deg)
    if (height(Geodetic{from.lat_deg, from.lon_deg + way}) > 0.0) return way;
  return degrees_east;
}

TEST(HardShores, LieWhereTheMapHasThem) {
  const Body& earth = kBodies.front();
  const std::filesystem::path path = std::filesystem::path(GLOBE_DATA_DIR) / earth.file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "SAMPLE MAP MISSING: " << path;
  const tests::TemporaryFolder folder;
  const Map map = read_map(earth, path);
  const auto surface = convert(earth, path, Filter::kBilinear, folder / "earth");
  struct Shore {
    const char* name;
    Geodetic from;
  };
  double worst = 0;
  for (const Shore& shore :
       {Shore{"Mumbai", {18.5, 69.5}}, Shore{"Lisbon", {38.7, -13.0}}, Shore{"California", {36.5, -125.0}},
        Shore{"Peru", {-12.0, -81.0}}, Shore{"Namibia", {-22.0, 11.0}}, Shore{"Chile", {-33.0, -75.0}},
        Shore{"Japan", {36.0, 133.0}}, Shore{"Kerala", {10.0, 73.5}}}) {
    const double on_map = first_land(shore.from, 6, [&](const Geodetic& at) { return map.bilinear(at); });
    const double on_planet = first_land(shore.from, 6, [&](const Geodetic& at) {
      return surface->height(globe::geo::normal_from_degrees(at.lat_deg, at.lon_deg), kLevel);
    });
    EXPECT_LT(on_map, 6) << shore.name << ": no coast on the way";
    const double off = std::abs(on_map - on_planet) / map.step_deg();
    EXPECT_LE(off, 0.5) << shore.name;
    worst = std::max(worst, off);
  }
  hard::report("places", "shores against the map's, pixels", "0.5", hard::figure(worst));
}

struct KnownSummit {
  const char* name;
  double lat_deg, lon_deg;  ///< of the real one; the map's highest pixel nearby stands for it
};

const std::vector<KnownSummit> kEarthSummits{{"K2", 35.88, 76.51},
                                             {"Kilimanjaro", -3.07, 37.35},
                                             {"Aconcagua", -32.65, -70.01},
                                             {"Denali", 63.07, -151.0},
                                             {"Mont Blanc", 45.83, 6.86},
                                             {"Elbrus", 43.35, 42.44},
                                             {"Mauna Kea, Hawaii", 19.82, -155.47},
                                             {"Fuji", 35.36, 138.73},
                                             {"Vinson", -78.53, -85.6},
                                             {"Puncak Jaya, New Guinea", -4.08, 137.18},
                                             {"Kinabalu, Borneo", 6.08, 116.56},
                                             {"Teide, Tenerife", 28.27, -16.64},
                                             {"Piton des Neiges, Reunion", -21.1, 55.48},
                                             {"Ras Dashen", 13.24, 38.37},
                                             {"Chimborazo", -1.47, -78.82},
                                             {"Rainier", 46.85, -121.76},
                                             {"Beerenberg, Jan Mayen", 71.08, -8.16},
                                             {"Mount Cook", -43.6, 170.14},
                                             {"Pidurutalagala, Sri Lanka", 7.0, 80.77},
                                             {"Kerinci, Sumatra", -1.7, 101.26},
                                             {"Gunnbjorn", 68.92, -29.9},
                                             {"Toubkal", 31.06, -7.92}};
const std::vector<KnownSummit> kMarsSummits{
    {"Olympus Mons", 18.65, 226.2}, {"Elysium Mons", 25.02, 147.21}, {"Ascraeus Mons", 11.92, 255.92},
    {"Pavonis Mons", 1.48, 247.04}, {"Arsia Mons", -8.35, 239.91},   {"Hecates Tholus", 32.12, 150.24}};

/// The pixel that nothing around it tops, uphill from a place.
Geodetic summit_of(const Map& map, const KnownSummit& from) {
  int x = static_cast<int>(std::floor(map.column({from.lat_deg, from.lon_deg}) + 0.5));
  int y = static_cast<int>(std::floor(map.row({from.lat_deg, from.lon_deg}) + 0.5));
  for (bool climbs = true; climbs;) {
    climbs = false;
    int best_x = x, best_y = y;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (map.at(x + dx, y + dy) > map.at(best_x, best_y)) best_x = x + dx, best_y = y + dy, climbs = true;
      }
    }
    x = best_x, y = best_y;
  }
  return {90.0 - (y + 0.5) * map.step_deg(), map.west_deg + (x + 0.5) * map.step_deg()};
}

/// How far the highest node near a summit lies from its pixel's middle, in pixels north or east, whichever is
/// more.
double pixels_off(const Surface& surface, const Map& map, const Geodetic& summit) {
  const auto place =
      globe::planet::locate(globe::geo::normal_from_degrees(summit.lat_deg, summit.lon_deg), kLevel);
  const int reach = static_cast<int>(2.0 * map.step_deg() / 90.0 * globe::planet::nodes_per_side(kLevel)) + 2;
  double highest = -HUGE_VAL, off = 0;
  for (int dj = -reach; dj <= reach; ++dj) {
    for (int di = -reach; di <= reach; ++di) {
      const Node node = globe::planet::fold({place.d, kLevel, static_cast<int>(std::lround(place.ij.x)) + di,
                                             static_cast<int>(std::lround(place.ij.y)) + dj});
      const Geodetic at = globe::geo::degrees_from_normal(globe::planet::node_direction(node));
      const double north = std::abs(at.lat_deg - summit.lat_deg) / map.step_deg();
      const double east = std::abs(std::remainder(at.lon_deg - summit.lon_deg, 360.0)) / map.step_deg();
      if (north > 1.0 || east > 1.0 || surface.height(node) <= highest) continue;
      highest = surface.height(node);
      off = std::max(north, east);
    }
  }
  return off;
}

TEST(HardSummits, StandWhereTheMapHasThem) {
  int summits = 0;
  double worst = 0;
  for (const auto& [body, places] :
       {std::pair{&kBodies[0], &kEarthSummits}, std::pair{&kBodies[2], &kMarsSummits}}) {
    const std::filesystem::path path = std::filesystem::path(GLOBE_DATA_DIR) / body->file;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << "SAMPLE MAP MISSING: " << path;
    const tests::TemporaryFolder folder;
    const Map map = read_map(*body, path);
    const auto surface =
        convert(*body, write_map(map, folder / "map.tif"), Filter::kNearest, folder / "planet");
    for (const KnownSummit& summit : *places) {
      const double off = pixels_off(*surface, map, summit_of(map, summit));
      EXPECT_LE(off, 0.5) << summit.name;
      worst = std::max(worst, off);
      ++summits;
    }
  }
  EXPECT_GE(summits, 28);
  hard::report("places", std::to_string(summits) + " summits and islands against the map's, pixels", "0.5",
               hard::figure(worst));
}

TEST(HardSummits, StandElsewhereWhenRowsAreTakenForLinearInLatitude) {
  const Body& mars = kBodies[2];
  const std::filesystem::path path = std::filesystem::path(GLOBE_DATA_DIR) / mars.file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "SAMPLE MAP MISSING: " << path;
  const tests::TemporaryFolder folder;
  const Map map = read_map(mars, path);
  const auto thesis =
      convert(mars, write_map(map, folder / "map.tif"), Filter::kNearest, folder / "planet", true);
  int off = 0;
  for (const KnownSummit& summit : kMarsSummits)
    off += pixels_off(*thesis, map, summit_of(map, summit)) > 0.5;
  EXPECT_GE(off, 5) << "of 6";
}

TEST(HardExtremes, OfTheEarthAreThoseOfItsMap) {
  const Body& earth = kBodies.front();
  const std::filesystem::path path = std::filesystem::path(GLOBE_DATA_DIR) / earth.file;
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "SAMPLE MAP MISSING: " << path;
  const tests::TemporaryFolder folder;
  const Map map = read_map(earth, path);
  const auto surface = convert(earth, path, Filter::kNearest, folder / "earth");
  const auto [low, high] = std::minmax_element(map.values.begin(), map.values.end());
  const globe::region::LatLonBox everything(-180, -90, 180, 90);
  const auto summary = globe::planet::summarize(*surface, everything, kLevel);
  EXPECT_EQ(summary->lowest.height_m, static_cast<double>(*low));
  EXPECT_EQ(summary->highest.height_m, static_cast<double>(*high));
  for (const auto& [extreme, value] : {std::pair{summary->lowest, *low}, std::pair{summary->highest, *high}})
    EXPECT_EQ(map.nearest(globe::geo::degrees_from_normal(extreme.at)), static_cast<double>(value));
}

}  // namespace
