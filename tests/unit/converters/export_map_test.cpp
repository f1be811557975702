#include "converters/export_map.h"

#include <OpenImageIO/imageio.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "converters/use_gdal.h"
#include "globe/base/angles.h"
#include "globe/base/error.h"
#include "globe/planet/interpolation.h"
#include "tests/node_planet.h"
#include "tests/temporary_folder.h"

namespace converters {
namespace {

using globe::kDegree;
using globe::planet::Node;
using globe::planet::Surface;
using tests::bytes_of;
using tests::TemporaryFolder;

/// Smooth, without symmetry, metres.
double hills(const globe::geo::dvec3& u) {
  return 1000.0 * (u.x + 0.5 * u.y * u.z + 0.25 * (3.0 * u.z * u.z - 1.0) + u.x * u.y);
}

double hills_at(double lat_deg, double lon_deg) {
  return hills(globe::geo::normal_from_degrees(lat_deg, lon_deg));
}

std::shared_ptr<const Surface> planet_of_hills(const std::filesystem::path& folder, int level,
                                               const globe::geo::Ellipsoid& ellipsoid = globe::geo::kWgs84) {
  tests::write_node_planet(folder, level, ellipsoid,
                           [](const Node& node) { return hills(globe::planet::node_direction(node)); });
  return tests::open_surface(folder);
}

struct Raster {
  int width = 0, height = 0;
  std::vector<float> values;

  float at(int x, int y) const { return values[static_cast<std::size_t>(y * width + x)]; }
};

/// The first band, by GDAL.
Raster read(const std::filesystem::path& path) {
  use_gdal();
  const std::unique_ptr<GDALDataset> file(GDALDataset::Open(path.c_str()));
  EXPECT_NE(file, nullptr) << path;
  Raster raster{file->GetRasterXSize(), file->GetRasterYSize(), {}};
  raster.values.resize(static_cast<std::size_t>(raster.width * raster.height));
  EXPECT_EQ(file->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, raster.width, raster.height, raster.values.data(),
                                             raster.width, raster.height, GDT_Float32, 0, 0),
            CE_None);
  return raster;
}

class ExportMap : public testing::Test {
 protected:
  Raster exported(const std::shared_ptr<const Surface>& planet, ExportOptions options) {
    options.output = folder_ / "map.tif";
    options.overwrite = true;
    export_map(planet, options, {});
    return read(options.output);
  }
  static double rms_error(const Raster& map) {
    double squares = 0;
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        const double truth =
            hills_at(90.0 - (y + 0.5) * 180.0 / map.height, -180.0 + (x + 0.5) * 360.0 / map.width);
        squares += std::pow(static_cast<double>(map.at(x, y)) - truth, 2.0);
      }
    }
    return std::sqrt(squares / (map.width * map.height));
  }

  TemporaryFolder folder_;
};

TEST_F(ExportMap, ErrsAsTheInterpolationDoes) {
  const auto coarse = planet_of_hills(folder_ / "coarse", 4);
  const auto fine = planet_of_hills(folder_ / "fine", 5);
  const auto error = [&](const auto& planet, Sampling sampling) {
    ExportOptions options;
    options.size = {360, 180};
    options.sampling = sampling;
    return rms_error(exported(planet, options));
  };
  // Halving the cells quarters the error of linear, halves that of nearest.
  EXPECT_NEAR(error(coarse, Sampling::kLinear) / error(fine, Sampling::kLinear), 4.0, 0.6);
  EXPECT_NEAR(error(coarse, Sampling::kNearest) / error(fine, Sampling::kNearest), 2.0, 0.3);
  EXPECT_LT(error(fine, Sampling::kLinear), 0.05 * error(fine, Sampling::kNearest));
}

TEST_F(ExportMap, PixelsAreWhatTheHeightCommandAnswersAtTheirCentres) {
  const auto folder = folder_ / "planet";
  tests::write_node_planet(folder, 6, globe::geo::kWgs84, tests::hashed_heights(3, -1000, 1000));
  const auto planet = tests::open_surface(folder);
  using globe::planet::Interpolation;
  for (const auto& [sampling, interpolation] : {std::pair{Sampling::kNearest, Interpolation::kNearest},
                                                std::pair{Sampling::kLinear, Interpolation::kLinear},
                                                std::pair{Sampling::kCubic, Interpolation::kCubic}}) {
    ExportOptions options;
    options.size = {72, 37};
    options.sampling = sampling;
    const Raster map = exported(planet, options);
    for (int y = 0; y < map.height; ++y) {
      for (int x = 0; x < map.width; ++x) {
        const auto u = globe::geo::normal_from_degrees(90.0 - (y + 0.5) * 180.0 / map.height,
                                                       -180.0 + (x + 0.5) * 360.0 / map.width);
        ASSERT_NEAR(map.at(x, y), height_at(*planet, u, 6, interpolation).height_m, 1e-3);
      }
    }
  }
}

TEST_F(ExportMap, TakesAsManyPixelsAlongTheEquatorAsTheLevelHasCells) {
  const auto planet = planet_of_hills(folder_ / "planet", 5);
  const Raster map = exported(planet, {});
  EXPECT_EQ(map.width, 128);
  EXPECT_EQ(map.height, 64);
  ExportOptions part;
  part.extent = {5.9, 45.8, 10.5, 47.8};
  const Raster piece = exported(planet, part);
  EXPECT_EQ(piece.width, 2);
  EXPECT_EQ(piece.height, 1);
}

TEST_F(ExportMap, AnyExtentHasTheSamePixels) {
  const auto planet = planet_of_hills(folder_ / "planet", 5);
  const Raster whole = exported(planet, {});
  ExportOptions options;
  options.extent = {0, -90, 360, 90};
  const Raster eastwards = exported(planet, options);
  options.extent = {157.5, -45, 202.5, 45};
  const Raster across = exported(planet, options);
  ASSERT_EQ(across.width, 16);
  ASSERT_EQ(across.height, 32);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 128; ++x) ASSERT_EQ(eastwards.at(x, y), whole.at((x + 64) % 128, y));
  }
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 16; ++x) ASSERT_EQ(across.at(x, y), whole.at((x + 120) % 128, y + 16));
  }
}

TEST_F(ExportMap, AreaIsTheMeanOfThePixel) {
  const auto planet = planet_of_hills(folder_ / "planet", 5);
  ExportOptions options;
  options.size = {24, 12};
  const Raster area = exported(planet, options);
  options.sampling = Sampling::kLinear;
  const Raster centres = exported(planet, options);
  double worst = 0, worst_of_centres = 0;
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 24; ++x) {
      double sum = 0, weight = 0;
      for (int b = 0; b < 30; ++b) {
        const double lat = 90.0 - (y + (b + 0.5) / 30.0) * 15.0;
        for (int a = 0; a < 30; ++a) {
          sum += std::cos(lat * kDegree) * hills_at(lat, -180.0 + (x + (a + 0.5) / 30.0) * 15.0);
          weight += std::cos(lat * kDegree);
        }
      }
      worst = std::max(worst, std::abs(static_cast<double>(area.at(x, y)) - sum / weight));
      worst_of_centres =
          std::max(worst_of_centres, std::abs(static_cast<double>(centres.at(x, y)) - sum / weight));
    }
  }
  EXPECT_LT(worst, 3.0);
  EXPECT_GT(worst_of_centres, 5.0 * worst);
}

TEST_F(ExportMap, AreaOfAFineLevelReadsACoarserOneThatIsFiltered) {
  const MapWindow window{-180, 90, 360.0 / 64, 180.0 / 32, 64, 32};
  EXPECT_EQ(area_level(window, 4), 4);
  EXPECT_EQ(area_level(window, 6), 6);
  EXPECT_EQ(area_level(window, 7), 6);
  EXPECT_EQ(area_level(window, 12), 6);
  // Heights at random: the mean of many is small, whatever level it comes from; single ones are not.
  const auto folder = folder_ / "planet";
  tests::write_node_planet(folder, 9, globe::geo::kWgs84, tests::hashed_heights(7, -1000, 1000));
  ExportOptions options;
  options.size = {64, 32};
  const Raster map = exported(tests::open_surface(folder), options);
  double squares = 0;
  for (const float value : map.values) squares += static_cast<double>(value) * static_cast<double>(value);
  // 32 x 32 cells of samples that vary by 577: 18, and as much again for what the filters overlap.
  EXPECT_LT(std::sqrt(squares / 2048.0), 40.0);
}

TEST_F(ExportMap, SaysWhereItLiesAndWhatItHolds) {
  const auto earth = planet_of_hills(folder_ / "earth", 3);
  const auto moon = planet_of_hills(folder_ / "moon", 3, globe::geo::kMoon);
  ExportOptions options;
  options.extent = {170, -30, 190, 10};
  options.size = {40, 20};
  exported(earth, options);
  const auto open = [&] {
    return std::unique_ptr<GDALDataset>(GDALDataset::Open((folder_ / "map.tif").c_str()));
  };
  const std::unique_ptr<GDALDataset> map = open();
  std::array<double, 6> transform{};
  map->GetGeoTransform(transform.data());
  EXPECT_EQ(transform, (std::array<double, 6>{170, 0.5, 0, 10, 0, -2}));
  EXPECT_STREQ(map->GetSpatialRef()->GetAuthorityCode(nullptr), "4326");
  EXPECT_STREQ(map->GetMetadataItem("AREA_OR_POINT"), "Area");
  EXPECT_STREQ(map->GetMetadataItem("VERTICAL_DATUM"), "ellipsoid");
  EXPECT_STREQ(map->GetRasterBand(1)->GetUnitType(), "metre");
  EXPECT_EQ(map->GetRasterBand(1)->GetRasterDataType(), GDT_Float32);
  exported(moon, {});
  EXPECT_EQ(open()->GetSpatialRef()->GetSemiMajor(), 1737400.0);
  EXPECT_EQ(open()->GetSpatialRef()->GetInvFlattening(), 0.0);
}

TEST_F(ExportMap, WritesPicturesOfHeightsInMetresAndInSixteenBits) {
  const auto planet = planet_of_hills(folder_ / "planet", 4);
  const Raster metres = exported(planet, {});
  ExportOptions options;
  options.output = folder_ / "map.exr";
  export_map(planet, options, {});
  const auto exr = OIIO::ImageInput::open(options.output.string());
  ASSERT_TRUE(exr);
  std::vector<float> values(metres.values.size());
  ASSERT_TRUE(exr->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, values.data()));
  EXPECT_EQ(values, metres.values);

  options.output = folder_ / "map.png";
  options.range = {-500.0, 800.0};
  std::string notes;
  ConvertListener listener;
  listener.note = [&](const std::string& text) { notes += text; };
  export_map(planet, options, listener);
  EXPECT_NE(notes.find("16 bits span -500 to 800 m"), std::string::npos) << notes;
  const auto png = OIIO::ImageInput::open(options.output.string());
  ASSERT_TRUE(png);
  EXPECT_EQ(png->spec().format, OIIO::TypeDesc::UINT16);
  std::vector<std::uint16_t> words(metres.values.size());
  ASSERT_TRUE(png->read_image(0, 0, 0, 1, OIIO::TypeDesc::UINT16, words.data()));
  for (std::size_t k = 0; k < words.size(); ++k) {
    const double metre = std::clamp(static_cast<double>(metres.values[k]), -500.0, 800.0);
    ASSERT_NEAR(-500.0 + words[k] / 65535.0 * 1300.0, metre, 0.5 * 1300.0 / 65535.0 + 1e-9);
  }
}

TEST_F(ExportMap, MakesTheSameBytesWhateverTheThreadsAndTheMemory) {
  const auto planet = planet_of_hills(folder_ / "planet", 8);
  for (const char* name : {"map.tif", "map.png", "map.exr"}) {
    std::string reference;
    for (const int threads : {1, 2, 5}) {
      ExportOptions options;
      options.output = folder_ / name;
      options.overwrite = true;
      options.threads = threads;
      options.memory_bytes = threads == 5 ? 1 : 0;
      export_map(planet, options, {});
      if (reference.empty()) reference = bytes_of(options.output);
      EXPECT_TRUE(bytes_of(options.output) == reference) << name << ", " << threads << " threads";
    }
  }
}

TEST_F(ExportMap, ExportsWhatIsMadeUpWhenAskedTo) {
  const auto planet = planet_of_hills(folder_ / "planet", 4);
  ExportOptions options;
  options.extent = {10, 20, 11, 21};
  options.level = 12;
  const Raster map = exported(planet, options);
  EXPECT_EQ(map.width, 46);
  int rough = 0;
  for (int x = 1; x + 1 < map.width; ++x)
    rough += std::abs(map.at(x - 1, 20) - 2 * map.at(x, 20) + map.at(x + 1, 20)) > 1e-2F;
  EXPECT_GT(rough, 10) << "detail below the data";
  options.level.reset();
  options.size = {46, 46};
  const Raster smooth = exported(planet, options);
  for (int x = 1; x + 1 < map.width; ++x)
    EXPECT_NEAR(smooth.at(x - 1, 20) + smooth.at(x + 1, 20), 2 * smooth.at(x, 20), 2.0F);

  const auto procedural = Surface::builtin(3);
  options.content = MapContent::kColors;
  options.extent = {};
  options.size = {64, 32};
  exported(procedural, options);
  options.content = MapContent::kHeights;
  const Raster heights = exported(procedural, options);
  const auto [low, high] = std::minmax_element(heights.values.begin(), heights.values.end());
  EXPECT_LT(*low, -1000.0F);
  EXPECT_GT(*high, 100.0F);
}

TEST_F(ExportMap, RefusesWhatItCannotWriteAndLeavesNothingBehind) {
  const auto planet = planet_of_hills(folder_ / "planet", 3);
  const auto refused = [&](const ExportOptions& options) -> std::string {
    try {
      export_map(planet, options, {});
    } catch (const globe::Error& error) {
      return error.what();
    }
    return "no error";
  };
  ExportOptions options;
  options.output = folder_ / "map.jpg";
  EXPECT_NE(refused(options).find("map.jpg: maps are written as .tif"), std::string::npos);
  options.output = folder_ / "map.tif";
  options.content = MapContent::kColors;
  EXPECT_NE(refused(options).find("no colors"), std::string::npos);
  options.content.reset();
  options.size = {1 << 22, 16};
  EXPECT_NE(refused(options).find("--size"), std::string::npos);
  options.size.reset();
  options.extent = {10, 0, 10, 20};
  EXPECT_NE(refused(options).find("--extent"), std::string::npos);
  options.extent = {};
  options.output = folder_ / "no/such/map.tif";
  EXPECT_NE(refused(options).find("no folder"), std::string::npos);
  std::ofstream(folder_ / "map.tif") << "mine";
  options.output = folder_ / "map.tif";
  EXPECT_NE(refused(options).find("--overwrite"), std::string::npos);
  EXPECT_EQ(bytes_of(folder_ / "map.tif"), "mine");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path()))
    files += entry.is_regular_file();
  EXPECT_EQ(files, 1U) << "nothing but the file that was there";
}

}  // namespace
}  // namespace converters
