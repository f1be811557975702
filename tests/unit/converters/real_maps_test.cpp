// Maps as people have them, from shared/data: read where they lie with the values they hold, or refused with
// the reason. Values are those of its README and of gdallocationinfo.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

#include "converters/geoid.h"
#include "converters/map_input.h"
#include "converters/sampler.h"
#include "globe/base/error.h"
#include "tests/temporary_folder.h"
#include "tests/unit/converters/test_maps.h"

namespace converters {
namespace {

namespace fs = std::filesystem;
using globe::geo::Ellipsoid;

const fs::path kData = GLOBE_DATA_DIR;

/// What a map holds at a place: the nearest sample; NAN: a void, or beside the map.
struct Spot {
  const char* file;
  double lat_deg, lon_deg;
  double value;
  std::optional<Extent> extent = std::nullopt;
  std::optional<std::string> crs = std::nullopt;
};

struct Refusal {
  const char* file;
  const char* part;  ///< of the message
};

const std::vector<Spot> kNasty{
    {"bremen_sea_ice_antarctic_epsg3031_f32_nan.tif", -76.080529122, -147.257694057, 31.0403900146484},
    {"bremen_sea_ice_antarctic_epsg3031_f32_nan.tif", -90, 0, NAN},
    {"bremen_sea_ice_antarctic_epsg3031_f32_nan.tif", 10, 0, NAN},
    {"modeltransformation_only_no_pixelscale.tiff", 37.746742768, -4.577245274, 1.23627471923828},
    {"ww_bigendian_f32_bad_geokeys_512.tif", 34.435702832, -119.827630176, 6.44013452529907},
    {"rasterio_float_nan.tif", 0.5, 2.5, NAN, Extent{0, 0, 3, 2}},
    {"rasterio_float_nan.tif", 1.5, 0.5, 0.319999992847443, Extent{0, 0, 3, 2}},
    {"rasterio_float_nan.tif", 0.5, 1.5, 1.23000001907349, Extent{0, 0, 3, 2}},
    {"rasterio_rotated.tif", 0.001768062, -1.487103297, 43, std::nullopt, "EPSG:32631"},
    {"rasterio_float_nodata.tif", 49.460750755, 38.106579832, 0},
    {"rasterio_float_nodata.tif", 49.425894967, 38.130142806, NAN},
    {"rasterio_cogeo_rgb.tif", 37.668652157, 128.658080398, 226},
    {"rasterio_rgba_uint16.tif", 36.819250461, -108.380083063, 10000},
    {"rasterio_world_rgb.tif", 19.3359375, 31.2890625, 206},
    {"gdal/byte_point.tif", 33.893590956, -117.636575186, 115},
    {"gdal/byte_gcp_pixelispoint.tif", 28.421052632, -146.842105263, 115},
    {"gdal/int16_big_endian.tif", 33.895088624, -117.637121426, 115},
    {"gdal/float32_lzw_predictor_3_big_endian.tif", 33.895088624, -117.637121426, 115},
    {"gdal/rgbsmall_int16_bigendian_lzw_predictor_2.tif", -23.03726, -44.769964, 79},
    {"gdal/float32_LZW_predictor_3.tif", 33.895088624, -117.637121426, 115},
    {"gdal/uint16_LZW_predictor_2.tif", 33.895088624, -117.637121426, 115},
    {"gdal/byte_DEFLATE_tiled.tif", 33.895088624, -117.637121426, 115},
    {"gdal/byte_LZW_tiled.tif", 33.895088624, -117.637121426, 115},
    {"gdal/byte_ZSTD_tiled.tif", 33.895088624, -117.637121426, 115},
    {"gdal/byte_LERC_ZSTD_tiled.tif", 33.895088624, -117.637121426, 115},
    {"gdal/nan32_nodata.tif", 45.146361874, 1.72801225, 53},
    {"gdal/nan32.tif", 6.5, 3.5, 53, Extent{0, 0, 10, 10}},
    {"gdal/nodata_byte.tif", 33.900486296, -117.639757366, 123},
    {"gdal/utmsmall-int16-neg.tiff", 33.885965952, -117.622130304, 38},
    {"gdal/nodata_float.asc", 33.892369611, -117.639696756, 123, std::nullopt, "EPSG:26711"},
    {"gdal/float16.tif", 33.895088624, -117.637121426, 115},
    {"gdal/float24.tif", 33.895088624, -117.637121426, 115},
    {"gdal/negative_scaley.tif", 33.902099505, -117.641716298, 107},
    {"gdal/non_square_pixels.tif", 49.75, 2.5, 0},
    {"gdal/WGS_1984_Web_Mercator.tif", 61.783513382, -20.808105466, 170},
    {"gdal/warp_52_dem.tif", 38.754645077, 76.0246702, 1719},
    {"gdal/geolocation_arrays_lon180_lon360.tif", 54.22762579, 0, 18},
    {"gdal/n43.dt0", 43.25, -79.75, 75},
    {"gdal/n43_partial_cols.dt0", 43.25, -79.958333333, NAN}};

const std::vector<Refusal> kRefused{
    {"rasterio_all_nodata.tif", "holds no valid sample"},
    {"rasterio_corrupt.tif", "not a readable raster"},
    {"rasterio_float_nan.tif", "names no coordinate reference system"},
    {"rasterio_rotated.tif", "names no coordinate reference system"},
    {"gdal/lzw_corrupted.tif", "not a readable"},
    {"gdal/byte_zstd_corrupted.tif", "not a readable raster"},
    {"gdal/tiled_bad_offset.tif", "not a 2:1 map"},
    {"gdal/huge-number-strips.tif", "claims 100000x1632895392 samples"},
    {"gdal/huge-implied-number-strips.tif", "not a 2:1 map"},
    {"gdal/bigtiff_one_strip_long.tif", "not a 2:1 map"},
    {"gdal/tiled_blockysize_larger_than_rasterysize.tif", "not a 2:1 map"},
    {"gdal/minfloat.tif", "not a 2:1 map"},
    {"gdal/float32_with_nodata_slightly_above_float_max.tif", "not a 2:1 map"},
    {"gdal/sparse_nodata_one.tif", "not a 2:1 map"},
    {"gdal/uint16_nodata_65535_bigtiff.tif", "not a 2:1 map"},
    {"gdal/nodata_float.asc", "names no coordinate reference system"},
    {"gdal/nodata_nan.asc", "File short"},
    {"gdal/ModelTiepointTag_z_non_zero_but_ModelPixelScaleTag_z_zero.tif", "does not lie on a planet"},
    {"gdal/polar_stero_variant_a.nc", "holds no valid sample"},
    {"gdal/w118n033_trunc.dt1", "not a readable raster"}};

MapStack load(const MapInput& input, Filter filter, MemoryBudget& budget,
              const PlanetFrame& frame = {globe::geo::kWgs84}) {
  OpenedMap map = open_map(input, MapKind::kHeights, frame, 1);
  MapStack maps;
  maps.add(std::make_shared<SourceMap>(*map.raster, map.geometry, map.rule, 1, budget, [](double) {}),
           filter);
  return maps;
}

/// At the node nearest to a place, at a level whose cells are a few centimetres.
double value_at(const MapStack& maps, double lat_deg, double lon_deg) {
  constexpr int kLevel = 27;
  const globe::planet::Place place =
      globe::planet::locate(globe::geo::normal_from_degrees(lat_deg, lon_deg), kLevel);
  float value = 0, weight = 0;
  sample_rect(maps,
              {place.d, kLevel, static_cast<int>(std::lround(place.ij.x)),
               static_cast<int>(std::lround(place.ij.y)), 1, 1},
              Gaps::kZero, &value, &weight);
  return weight > 0.0F ? static_cast<double>(value) : NAN;
}

void expect_spot(const MapStack& maps, const Spot& spot, double tolerance) {
  const double found = value_at(maps, spot.lat_deg, spot.lon_deg);
  if (std::isnan(spot.value)) {
    EXPECT_TRUE(std::isnan(found)) << spot.file << ": " << found;
  } else {
    EXPECT_NEAR(found, spot.value, tolerance) << spot.file << " at " << spot.lat_deg << ", " << spot.lon_deg;
  }
}

class RealMaps : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(kData / "nasty")) GTEST_SKIP() << "SKIPPED: no sample data in " << kData;
  }
  MemoryBudget budget_ = test::plenty();
};

TEST_F(RealMaps, ThatBreakReadersAreReadRightly) {
  for (const Spot& spot : kNasty) {
    MapInput input{kData / "nasty" / spot.file, spot.extent};
    input.crs = spot.crs;
    ASSERT_NO_THROW(expect_spot(load(input, Filter::kNearest, budget_), spot, 1e-5)) << spot.file;
  }
}

TEST_F(RealMaps, ThatAreBrokenAreRefusedWithTheReason) {
  for (const Refusal& refusal : kRefused) {
    try {
      load({kData / "nasty" / refusal.file}, Filter::kNearest, budget_);
      ADD_FAILURE() << refusal.file << " is accepted";
    } catch (const globe::Error& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(refusal.part), std::string::npos) << message;
      EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    }
  }
}

TEST_F(RealMaps, ThatBreakReadersAreAllInTheTables) {
  std::set<std::string> known;
  for (const Spot& spot : kNasty) known.insert(spot.file);
  for (const Refusal& refusal : kRefused) known.insert(refusal.file);
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kData / "nasty")) {
    if (!entry.is_regular_file()) continue;
    ++files;
    EXPECT_TRUE(known.contains(fs::relative(entry.path(), kData / "nasty").string())) << entry.path();
  }
  EXPECT_GE(files, 50);
}

TEST_F(RealMaps, OfRegionsHaveTheValuesThatTheirOwnersState) {
  const std::vector<Spot> spots{
      {"california_nevada_3s_int16.tif", 36.5785, -118.2923, 4404},
      {"california_nevada_3s_int16.tif", 36.2461, -116.8185, -84},
      {"california_nevada_3s_int16.tif", 39.10, -120.03, 1899},
      {"california_nevada_3s_int16.tif", 36.5, -122.5, 0},
      {"california_nevada_3s_int16.tif", 36.5, -123.9, NAN},
      {"N37W123.hgt", 37.9291, -122.5778, 764},
      {"N37W123.hgt", 37.2233, -122.0933, 979},
      {"N00W177.hgt", 0.1936, -176.4769, 5},
      {"mt_everest_3s_int16.tif", 27.9900, 86.9250, 8642},
      {"mt_everest_3s_int16.tif", 27.9881, 86.9250, NAN},
      {"mt_rainier_3s_int16.tif", 46.8523, -121.7603, 4370},
      {"mt_fuji_3s_int16.tif", 35.3606, 138.7274, 3742},
      {"baltoro_k2_3s_int16.tif", 35.8825, 76.5133, 8538},
      {"st_helens_usgs_utm10_nad27_30m.dem", 46.1914, -122.1956, 2535},
      {"st_helens_usgs_utm10_nad27_30m.dem", 46.1910, -122.1944, 2543},
      {"south_glacier_yukon_utm7_20m_f64.tif", 60.827376546, -139.142313984, 2618.052},
      {"columbia_glacier_alaska_ltm_100m_f32.tif", 61.271594194, -146.96178247, 960.094421386719},
      {"vestfold_hills_antarctica_polarstereo_32m_f32.tif", -68.47, 78.25, 27.53},
      {"vestfold_hills_antarctica_polarstereo_32m_f32.tif", -68.398390665, 78.185986995, NAN},
      {"nrw_germany_utm32_1m_f32.tif", 51.427581993, 6.934395369, 120.900001525879},
      {"lisbon_1s_f32.tif", 38.7139, -9.1334, 100.73},
      {"usa_2.5min_ascii_grid.dem", 39.74, -104.99, 1581},
      {"usa_2.5min_ascii_grid.dem", 39.1178, -106.4454, 3728}};
  std::string open;
  MapStack maps;
  for (const Spot& spot : spots) {
    if (open != spot.file) maps = load({kData / "local" / spot.file}, Filter::kNearest, budget_);
    open = spot.file;
    expect_spot(maps, spot, 0.006);
  }
}

TEST_F(RealMaps, OfTheEarthGiveTheSameHeightsInBothLayouts) {
  const auto grid = [&](const char* file, Filter filter) {
    return test::sample(load({kData / "earth" / file}, filter, budget_), 8, budget_);
  };
  for (const Filter filter : {Filter::kBilinear, Filter::kArea}) {
    const NodeGrid<float> plain = grid("earth_etopo20_f32.tif", filter);
    const NodeGrid<float> awkward = grid("earth_etopo20_lon20-380_southup.nc", filter);
    test::for_each_node(plain, [&](const globe::planet::Node& node, float value) {
      ASSERT_NEAR(value, *awkward.at(node.d, node.i, node.j), 0.002)
          << node.d << ": " << node.i << ", " << node.j;
    });
  }
}

/// Writes a VRT over raw 16-bit numbers, big end first.
fs::path write_vrt(const fs::path& path, const fs::path& raw, int width, int height, const char* transform,
                   const char* band_also) {
  std::ofstream(path)
      << "<VRTDataset rasterXSize=\"" << width << "\" rasterYSize=\"" << height << "\"><GeoTransform>"
      << transform
      << "</GeoTransform><VRTRasterBand dataType=\"Int16\" band=\"1\" subClass=\"VRTRawRasterBand\">"
         "<SourceFilename>"
      << raw.string() << "</SourceFilename><ByteOrder>MSB</ByteOrder><ImageOffset>0</ImageOffset>"
      << "<PixelOffset>2</PixelOffset><LineOffset>" << 2 * width << "</LineOffset>" << band_also
      << "</VRTRasterBand></VRTDataset>";
  return path;
}

TEST_F(RealMaps, WithoutHeadersComeThroughAVrt) {
  const tests::TemporaryFolder folder;
  const fs::path mars =
      write_vrt(folder / "mars.vrt", kData / "mars/megt90n000cb.img", 1440, 720, "0,0.25,0,90,0,-0.25", "");
  const MapStack maps = load({mars}, Filter::kNearest, budget_, {globe::geo::kMars});
  for (const Spot& spot : {Spot{"highest", 17.375, 226.875, 21134}, Spot{"lowest", -32.875, 62.125, -8068},
                           Spot{"Olympus Mons", 18.65, 226.2, 20009}, Spot{"Hellas", -42.4, 70.5, -6151},
                           Spot{"Gale", -5.4, 137.8, -893}, Spot{"north pole", 89.9, 0.1, -1971}})
    expect_spot(maps, spot, 0.0);
}

TEST_F(RealMaps, OfTheGeoidAddItsHeights) {
  const tests::TemporaryFolder folder;
  const fs::path grid =
      write_vrt(folder / "egm96.vrt", kData / "earth/earth_geoid_egm96_15min_be16.dat", 1440, 721,
                "-0.125,0.25,0,90.125,0,-0.25", "<Scale>0.01</Scale><UnitType>m</UnitType>");
  const auto geoid = open_geoid(grid.string(), {globe::geo::kWgs84}, budget_);
  for (const Spot& spot : {Spot{"Sri Lanka", 4.75, 78.75, -106.99}, Spot{"New Guinea", -8.25, 147.25, 85.39},
                           Spot{"0, 0", 0, 0, 17.16}, Spot{"north pole", 90, 0, 13.61}}) {
    constexpr int kLevel = 24;
    const globe::planet::Place place =
        globe::planet::locate(globe::geo::normal_from_degrees(spot.lat_deg, spot.lon_deg), kLevel);
    float height = 1000;
    geoid->add({place.d, kLevel, static_cast<int>(std::lround(place.ij.x)),
                static_cast<int>(std::lround(place.ij.y)), 1, 1},
               &height);
    EXPECT_NEAR(height, 1000 + spot.value, 0.011) << spot.file;
  }
}

}  // namespace
}  // namespace converters
