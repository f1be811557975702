#include "converters/map_input.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <fstream>

#include "converters/geoid.h"
#include "converters/sampler.h"
#include "globe/base/angles.h"
#include "globe/base/error.h"
#include "tests/temporary_folder.h"
#include "tests/unit/converters/gdal_maps.h"
#include "tests/unit/converters/test_maps.h"

namespace converters {
namespace {

using globe::kDegree;
using globe::geo::degrees_from_normal;
using globe::geo::Geodetic;
using globe::geo::kMars;
using globe::geo::kWgs84;
using globe::planet::node_direction;
using test::GeoTiff;
using tests::TemporaryFolder;

const PlanetFrame kEarth{kWgs84};

double smooth(double lat, double lon) { return 1000.0 * std::sin(3 * lat * kDegree) + 10.0 * lon; }

struct Loaded {
  MemoryBudget budget = test::plenty();
  MapStack maps;
  std::string frame, values;
};

Loaded load(const MapInput& input, MapKind kind = MapKind::kHeights, const PlanetFrame& frame = kEarth,
            Filter filter = Filter::kBilinear) {
  Loaded loaded;
  OpenedMap map = open_map(input, kind, frame, 1);
  loaded.frame = map.frame;
  loaded.values = map.values;
  loaded.maps.add(
      std::make_shared<SourceMap>(*map.raster, map.geometry, map.rule, 1, loaded.budget, [](double) {}),
      filter);
  return loaded;
}

/// The value at the node of a level that is nearest to a place; its weight beside it.
std::array<float, 4> value_at(const MapStack& maps, double lat, double lon, int level) {
  const globe::planet::Place place = globe::planet::locate(globe::geo::normal_from_degrees(lat, lon), level);
  std::array<float, 4> values{};
  float weight = 0;
  sample_rect(maps,
              {place.d, level, static_cast<int>(std::lround(place.ij.x)),
               static_cast<int>(std::lround(place.ij.y)), 1, 1},
              Gaps::kZero, values.data(), &weight);
  values[3] = weight;
  return values;
}

std::string refusal(const MapInput& input) {
  try {
    open_map(input, MapKind::kHeights, kEarth, 1);
  } catch (const globe::Error& error) {
    return error.what();
  }
  return "none";
}

/// A map of smooth() in degrees, from a corner.
GeoTiff degrees_map(int width, int height, double west, double north, double step) {
  GeoTiff map;
  map.width = width;
  map.height = height;
  map.transform = {west, step, 0, north, 0, -step};
  map.crs = "EPSG:4326";
  map.value = [=](int x, int y, int) { return smooth(north - (y + 0.5) * step, west + (x + 0.5) * step); };
  return map;
}

TEST(OpenMap, FindsWholePlanetsWhateverTheirOrigin) {
  const TemporaryFolder folder;
  const auto wave = [](double lat, double lon) {
    return 500.0 * std::cos(lat * kDegree) * std::cos(lon * kDegree);
  };
  for (const double west : {-180.0, 0.0, 20.0}) {
    for (const bool south_up : {false, true}) {
      GeoTiff map = degrees_map(360, 180, west, south_up ? -90 : 90, 1);
      map.transform[5] = south_up ? 1 : -1;
      map.value = [=](int x, int y, int) {
        return wave(south_up ? -90 + y + 0.5 : 90 - y - 0.5, west + x + 0.5);
      };
      map.write(folder / "map.tif");
      OpenedMap opened = open_map({folder / "map.tif"}, MapKind::kHeights, kEarth, 1);
      EXPECT_TRUE(opened.geometry.is_whole_planet()) << opened.frame;
      const Loaded loaded = load({folder / "map.tif"});
      for (const Geodetic& at :
           {Geodetic{10, 179.7}, Geodetic{-30, 20.1}, Geodetic{60, -0.2}, Geodetic{89.9, 45}}) {
        EXPECT_NEAR(value_at(loaded.maps, at.lat_deg, at.lon_deg, 16)[0], wave(at.lat_deg, at.lon_deg), 1.0)
            << west << south_up;
      }
    }
  }
}

TEST(OpenMap, PlacesRastersOfAnyProjectionWhereTheyLie) {
  const TemporaryFolder folder;
  struct Case {
    const char* crs;
    Geodetic middle;
    double step;
  };
  for (const Case& one : {Case{"EPSG:32632", {47, 8}, 100}, Case{"EPSG:3857", {40, -100}, 150},
                          Case{"EPSG:3031", {-90, 0}, 1000}, Case{"EPSG:3413", {85, 170}, 1000},
                          Case{"EPSG:3035", {52, 10}, 100}, Case{"EPSG:32601", {10, -180}, 100}}) {
    use_gdal();
    OGRSpatialReference from, to;
    from.SetFromUserInput("OGC:CRS84");
    to.SetFromUserInput(one.crs);
    to.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const std::unique_ptr<OGRCoordinateTransformation> there(OGRCreateCoordinateTransformation(&from, &to));
    const std::unique_ptr<OGRCoordinateTransformation> back(OGRCreateCoordinateTransformation(&to, &from));
    double x = one.middle.lon_deg, y = one.middle.lat_deg;
    ASSERT_TRUE(there->Transform(1, &x, &y));
    GeoTiff map;
    map.width = map.height = 200;
    map.transform = {x - 100 * one.step, one.step, 0, y + 100 * one.step, 0, -one.step};
    map.crs = one.crs;
    map.value = [&](int column, int row, int) {
      double lon = map.transform[0] + (column + 0.5) * one.step,
             lat = map.transform[3] - (row + 0.5) * one.step;
      EXPECT_TRUE(back->Transform(1, &lon, &lat));
      return 1000.0 * std::sin(20 * lat * kDegree) * std::cos(lon * kDegree);
    };
    map.write(folder / "map.tif");
    const Loaded loaded = load({folder / "map.tif"});
    EXPECT_NE(loaded.frame.find("as the file says"), std::string::npos) << loaded.frame;
    for (int k = 0; k < 20; ++k) {
      double lon = x + (k * 9 - 90) * one.step, lat = y + (k * 7 - 70) * one.step;
      ASSERT_TRUE(back->Transform(1, &lon, &lat));
      constexpr int kLevel = 22;
      const std::array<float, 4> found = value_at(loaded.maps, lat, lon, kLevel);
      EXPECT_EQ(found[3], 1.0F) << one.crs << " at " << lat << ", " << lon;
      EXPECT_NEAR(found[0], 1000.0 * std::sin(20 * lat * kDegree) * std::cos(lon * kDegree), 0.3)
          << one.crs << " at " << lat << ", " << lon;
    }
    EXPECT_EQ(value_at(loaded.maps, -one.middle.lat_deg - 1, one.middle.lon_deg + 170, 8)[3], 0.0F)
        << one.crs;
  }
}

TEST(OpenMap, GivesTheSameBitsOnAnyThreadsAndOnBothSidesOfABorder) {
  const TemporaryFolder folder;
  GeoTiff map;  // around the north pole, where all diamonds meet; a datum of its own
  map.width = map.height = 500;
  map.transform = {-2.5e6, 1e4, 0, 2.5e6, 0, -1e4};
  map.crs = "+proj=stere +lat_0=90 +lat_ts=71 +lon_0=-45 +datum=NAD27 +units=m";
  map.value = [](int x, int y, int) { return (x * 7919 + y * 104729) % 1000; };
  map.write(folder / "map.tif");
  for (const Filter filter : {Filter::kNearest, Filter::kBilinear, Filter::kBicubic, Filter::kArea}) {
    Loaded loaded = load({folder / "map.tif"}, MapKind::kHeights, kEarth, filter);
    const NodeGrid<float> whole = test::sample(loaded.maps, 7, loaded.budget);
    EXPECT_EQ(test::broken_edges(whole), 0);
    tbb::task_arena alone(1);
    alone.execute([&] {
      const NodeGrid<float> again = test::sample(loaded.maps, 7, loaded.budget);
      test::for_each_node(whole, [&](const globe::planet::Node& node, float value) {
        ASSERT_EQ(value, *again.at(node.d, node.i, node.j));
      });
    });
    std::vector<float> part(9 * 11), weights(part.size());
    sample_rect(loaded.maps, {2, 7, 3, 1, 9, 11}, Gaps::kFill, part.data(), weights.data());
    for (int j = 0; j < 11; ++j)
      for (int i = 0; i < 9; ++i)
        ASSERT_EQ(part[static_cast<std::size_t>(j * 9 + i)], *whole.at(2, 3 + i, 1 + j));
  }
}

TEST(OpenMap, KeepsPlanetaryCoordinatesAndPlainMapsInMetres) {
  const TemporaryFolder folder;
  // The whole of Mars, in metres along the equator, from 0 eastwards.
  GeoTiff map = degrees_map(360, 180, 0, 90, 1);
  const double metres = 3396190.0 * kDegree;
  map.transform = {0, metres, 0, 90 * metres, 0, -metres};
  map.crs = "+proj=eqc +lon_0=0 +R=3396190 +units=m +over";
  map.transform[0] = -180 * metres;
  map.value = [](int x, int y, int) { return smooth(90 - y - 0.5, -180 + x + 0.5); };
  map.write(folder / "mars.tif");
  OpenedMap opened = open_map({folder / "mars.tif"}, MapKind::kHeights, {kMars}, 1);
  EXPECT_TRUE(opened.geometry.is_whole_planet()) << opened.frame;
  EXPECT_EQ(opened.geometry.period, 360);
  EXPECT_NEAR(opened.geometry.west_deg, -179.5, 1e-9);
}

TEST(OpenMap, FollowsRotatedGridsAndControlPoints) {
  const TemporaryFolder folder;
  constexpr double kStep = 0.001;
  GeoTiff map;
  map.width = map.height = 100;
  map.crs = "EPSG:4326";
  map.transform = {10, 0.8 * kStep, 0.6 * kStep, 45, 0.6 * kStep, -0.8 * kStep};
  const auto place = [&](double x, double y) {
    return Geodetic{45 + 0.6 * kStep * x - 0.8 * kStep * y, 10 + 0.8 * kStep * x + 0.6 * kStep * y};
  };
  map.value = [&](int x, int y, int) {
    const Geodetic at = place(x + 0.5, y + 0.5);
    return 1e4 * (at.lat_deg - 45) + 1e3 * (at.lon_deg - 10);
  };
  map.write(folder / "rotated.tif");
  map.transform = {};
  map.crs = "";
  map.also = [&](GDALDataset& file) {
    std::vector<GDAL_GCP> points(4);
    GDALInitGCPs(4, points.data());
    for (std::size_t k = 0; k < 4; ++k) {
      points[k].dfGCPPixel = k % 2 == 0 ? 0 : 100;
      points[k].dfGCPLine = k < 2 ? 0 : 100;
      const Geodetic at = place(points[k].dfGCPPixel, points[k].dfGCPLine);
      points[k].dfGCPX = at.lon_deg;
      points[k].dfGCPY = at.lat_deg;
    }
    OGRSpatialReference system;
    system.SetFromUserInput("EPSG:4326");
    file.SetGCPs(4, points.data(), &system);
    GDALDeinitGCPs(4, points.data());
  };
  map.write(folder / "points.tif");
  for (const char* name : {"rotated.tif", "points.tif"}) {
    const Loaded loaded = load({folder / name});
    for (const auto& [x, y] : {std::pair(20.0, 30.0), std::pair(70.0, 55.0), std::pair(50.0, 90.0)}) {
      const Geodetic at = place(x, y);
      const std::array<float, 4> found = value_at(loaded.maps, at.lat_deg, at.lon_deg, 23);
      EXPECT_EQ(found[3], 1.0F) << name;
      EXPECT_NEAR(found[0], 1e4 * (at.lat_deg - 45) + 1e3 * (at.lon_deg - 10), 0.1) << name;
    }
  }
}

TEST(OpenMap, CountsSamplesAsTheFileSaysUnlessToldOtherwise) {
  const TemporaryFolder folder;
  GeoTiff map = degrees_map(100, 100, 10, 50, 0.01);
  map.value = [](int x, int, int) { return x; };
  for (const bool point : {false, true}) {
    map.also = [&](GDALDataset& file) { file.SetMetadataItem("AREA_OR_POINT", point ? "Point" : "Area"); };
    map.write(folder / "map.tif");
    const auto column_at = [&](const MapInput& input) {
      return static_cast<double>(value_at(load(input).maps, 49.5, 10.5, 22)[0]);
    };
    // The transform is of edges either way: what is written comes back.
    EXPECT_NEAR(column_at({folder / "map.tif"}), 49.5, 0.01);
    MapInput input{folder / "map.tif"};
    input.registration = Registration::kPoint;
    EXPECT_NEAR(column_at(input), point ? 49.5 : 50.0, 0.01);
    input.registration = Registration::kArea;
    EXPECT_NEAR(column_at(input), point ? 49.0 : 49.5, 0.01);
  }
}

TEST(OpenMap, TurnsRawNumbersOfEveryTypeIntoMetres) {
  const TemporaryFolder folder;
  for (const GDALDataType type :
       {GDT_Byte, GDT_UInt16, GDT_Int16, GDT_UInt32, GDT_Int32, GDT_Float32, GDT_Float64}) {
    GeoTiff map = degrees_map(20, 10, 10, 50, 0.1);
    map.type = type;
    map.value = [](int x, int, int) { return x < 10 ? 50.0 : 200.0; };
    map.also = [](GDALDataset& file) {
      file.GetRasterBand(1)->SetNoDataValue(200);
      file.GetRasterBand(1)->SetScale(0.5);
      file.GetRasterBand(1)->SetOffset(7);
      file.GetRasterBand(1)->SetUnitType("US survey foot");
    };
    map.write(folder / "map.tif");
    const Loaded loaded = load({folder / "map.tif"}, MapKind::kHeights, kEarth, Filter::kNearest);
    EXPECT_NE(loaded.values.find("scale 0.5"), std::string::npos) << loaded.values;
    EXPECT_NEAR(value_at(loaded.maps, 49.5, 10.5, 18)[0], (50 * 0.5 + 7) * 1200.0 / 3937.0, 1e-4) << type;
    EXPECT_EQ(value_at(loaded.maps, 49.5, 11.5, 18)[3], 0.0F) << type;
    MapInput told{folder / "map.tif"};
    told.nodata = 50;
    told.scale = 2;
    told.offset = 1;
    told.unit = "m";
    const Loaded by_hand = load(told, MapKind::kHeights, kEarth, Filter::kNearest);
    EXPECT_EQ(value_at(by_hand.maps, 49.5, 11.5, 18)[0], 401.0F) << type;
    EXPECT_EQ(value_at(by_hand.maps, 49.5, 10.5, 18)[3], 0.0F) << type;
  }
}

TEST(OpenMap, TakesColorsByTheirMeaningAndWhatTheyHide) {
  const TemporaryFolder folder;
  GeoTiff map = degrees_map(20, 10, 10, 50, 0.1);
  map.type = GDT_Byte;
  map.bands = 4;
  map.value = [](int x, int, int band) { return band == 4 ? (x < 10 ? 255 : 0) : band * 50.0; };
  map.also = [](GDALDataset& file) {
    const GDALColorInterp meaning[] = {GCI_BlueBand, GCI_GreenBand, GCI_RedBand, GCI_AlphaBand};
    for (int band = 1; band <= 4; ++band) file.GetRasterBand(band)->SetColorInterpretation(meaning[band - 1]);
  };
  map.write(folder / "map.tif");
  const Loaded loaded = load({folder / "map.tif"}, MapKind::kColors, kEarth, Filter::kNearest);
  const std::array<float, 4> color = value_at(loaded.maps, 49.5, 10.5, 18);
  EXPECT_GT(color[0], color[1]);  // red is the third band, 150
  EXPECT_GT(color[1], color[2]);

  GeoTiff indexed = degrees_map(20, 10, 10, 50, 0.1);
  indexed.type = GDT_Byte;
  indexed.value = [](int x, int, int) { return x < 10 ? 1 : 0; };
  indexed.also = [](GDALDataset& file) {
    GDALColorTable table;
    const GDALColorEntry black{0, 0, 0, 255}, red{255, 0, 0, 255};
    table.SetColorEntry(0, &black);
    table.SetColorEntry(1, &red);
    file.GetRasterBand(1)->SetColorTable(&table);
  };
  indexed.write(folder / "indexed.tif");
  const Loaded palette = load({folder / "indexed.tif"}, MapKind::kColors, kEarth, Filter::kNearest);
  EXPECT_EQ(value_at(palette.maps, 49.5, 10.5, 18)[0], 1.0F);
  EXPECT_EQ(value_at(palette.maps, 49.5, 10.5, 18)[1], 0.0F);
  EXPECT_EQ(value_at(palette.maps, 49.5, 11.5, 18)[0], 0.0F);

  GeoTiff masked = degrees_map(20, 10, 10, 50, 0.1);
  masked.type = GDT_UInt16;
  masked.bands = 3;
  masked.value = [](int x, int, int band) { return x < 10 ? (band == 1 ? 0 : 30000) : 0; };
  masked.also = [](GDALDataset& file) {
    for (int band = 1; band <= 3; ++band) file.GetRasterBand(band)->SetNoDataValue(0);
  };
  masked.write(folder / "masked.tif");
  const Loaded hidden = load({folder / "masked.tif"}, MapKind::kColors, kEarth, Filter::kNearest);
  EXPECT_EQ(value_at(hidden.maps, 49.5, 10.5, 18)[3], 1.0F) << "only one band is nodata";
  EXPECT_EQ(value_at(hidden.maps, 49.5, 11.5, 18)[3], 0.0F);
}

TEST(OpenMap, HidesWhatIsTransparentInAPicture) {
  const TemporaryFolder folder;
  std::vector<std::uint8_t> samples;
  for (int k = 0; k < 64 * 32; ++k) {
    const std::uint8_t alpha = k % 64 < 32 ? 255 : 0;
    samples.insert(samples.end(), {200, 100, 50, alpha});
  }
  const auto output = OIIO::ImageOutput::create((folder / "map.png").string());
  OIIO::ImageSpec spec(64, 32, 4, OIIO::TypeDesc::UINT8);
  spec.alpha_channel = 3;
  ASSERT_TRUE(output->open((folder / "map.png").string(), spec));
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::UINT8, samples.data()) && output->close());
  const Loaded loaded = load({folder / "map.png"}, MapKind::kColors, kEarth, Filter::kNearest);
  EXPECT_EQ(value_at(loaded.maps, 10, -90, 10)[3], 1.0F);
  EXPECT_GT(value_at(loaded.maps, 10, -90, 10)[0], 0.5F);
  EXPECT_EQ(value_at(loaded.maps, 10, 90, 10)[3], 0.0F);
}

TEST(OpenMap, NamesTheVerticalDatumOfTheFile) {
  const TemporaryFolder folder;
  GeoTiff map = degrees_map(20, 10, 10, 50, 0.1);
  map.crs = "EPSG:4326+5773";
  map.write(folder / "egm96.tif");
  EXPECT_EQ(open_map({folder / "egm96.tif"}, MapKind::kHeights, kEarth, 1).raster->info().vertical_datum,
            "EGM96 height");
  map.crs = "EPSG:4979";
  map.write(folder / "ellipsoid.tif");
  EXPECT_EQ(open_map({folder / "ellipsoid.tif"}, MapKind::kHeights, kEarth, 1).raster->info().vertical_datum,
            "ellipsoid");
  map.crs = "EPSG:4326";
  map.write(folder / "none.tif");
  EXPECT_EQ(open_map({folder / "none.tif"}, MapKind::kHeights, kEarth, 1).raster->info().vertical_datum, "");
}

TEST(OpenMap, RefusesWhatLiesNowhere) {
  const TemporaryFolder folder;
  EXPECT_NE(refusal({folder / "absent.tif"}).find("no such file"), std::string::npos);
  EXPECT_NE(refusal({"/vsicurl/http://example.org/map.tif"}).find("no such file"), std::string::npos);
  GeoTiff map = degrees_map(20, 10, 500000, 4000000, 30);
  map.crs = "";
  map.write(folder / "metres.tif");
  EXPECT_NE(refusal({folder / "metres.tif"}).find("--crs"), std::string::npos);
  MapInput told{folder / "metres.tif"};
  told.crs = "EPSG:32610";
  EXPECT_EQ(refusal(told), "none");
  told.crs = "EPSG:999999";
  EXPECT_NE(refusal(told).find("no coordinate reference system"), std::string::npos);
  told.crs = "http://example.org/crs";
  EXPECT_NE(refusal(told).find("no coordinate reference system"), std::string::npos);
  map.crs = "LOCAL_CS[\"nowhere\",UNIT[\"metre\",1]]";
  map.write(folder / "nowhere.tif");
  EXPECT_NE(refusal({folder / "nowhere.tif"}).find("does not lie on a planet"), std::string::npos);
}

TEST(OpenMap, FetchesNothingThatAFileRefersTo) {
  const TemporaryFolder folder;
  std::ofstream(folder / "map.vrt")
      << "<VRTDataset rasterXSize=\"8\" rasterYSize=\"4\"><GeoTransform>-180,45,0,90,0,-45</GeoTransform>"
         "<VRTRasterBand dataType=\"Byte\" band=\"1\"><SimpleSource>"
         "<SourceFilename>/vsicurl/http://127.0.0.1:9/map.tif</SourceFilename><SourceBand>1</SourceBand>"
         "</SimpleSource></VRTRasterBand></VRTDataset>";
  EXPECT_THROW(load({folder / "map.vrt"}), globe::Error);
}

TEST(Geoid, AddsTheHeightsOfARasterAndOfGeographicLib) {
  const TemporaryFolder folder;
  const auto wave = [](double lat, double lon) {
    return 30.0 * std::cos(lat * kDegree) * std::cos(lon * kDegree);
  };
  GeoTiff map = degrees_map(360, 181, -0.5, 90.5, 1);  // points, from 0 eastwards, poles included
  map.value = [&](int x, int y, int) { return wave(90 - y, x); };
  map.write(folder / "geoid.tif");
  // GeographicLib's own format: 16 bits, big end first, offset and scale in comments.
  std::ofstream pgm(folder / "wave.pgm", std::ios::binary);
  pgm << "P5\n# Offset -50\n# Scale 0.002\n# Origin 90N 0E\n# AREA_OR_POINT Point\n360 181\n65535\n";
  for (int y = 0; y <= 180; ++y) {
    for (int x = 0; x < 360; ++x) {
      const auto raw = static_cast<unsigned>(std::lround((wave(90 - y, x) + 50) / 0.002));
      pgm.put(static_cast<char>(raw >> 8)).put(static_cast<char>(raw & 255));
    }
  }
  pgm.close();
  MemoryBudget budget = test::plenty();
  for (const char* name : {"geoid.tif", "wave.pgm"}) {
    const auto geoid = open_geoid((folder / name).string(), kEarth, budget);
    constexpr int kLevel = 5;
    const NodeRect rect = whole_diamond(1, kLevel);
    std::vector<float> heights(static_cast<std::size_t>(rect.ni * rect.nj), 100.0F);
    geoid->add(rect, heights.data());
    for (int j = 0; j < rect.nj; ++j) {
      for (int i = 0; i < rect.ni; ++i) {
        const Geodetic at = degrees_from_normal(node_direction({1, kLevel, i, j}));
        ASSERT_NEAR(heights[static_cast<std::size_t>(j * rect.ni + i)], 100 + wave(at.lat_deg, at.lon_deg),
                    0.01)
            << name << " at " << at.lat_deg << ", " << at.lon_deg;
      }
    }
  }
  EXPECT_THROW(open_geoid("no-such-geoid", kEarth, budget), globe::Error);
  degrees_map(20, 10, 10, 50, 0.1).write(folder / "part.tif");
  EXPECT_THROW(open_geoid((folder / "part.tif").string(), kEarth, budget), globe::Error);
}

}  // namespace
}  // namespace converters
