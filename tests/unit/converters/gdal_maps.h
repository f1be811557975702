#pragma once

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "converters/use_gdal.h"

namespace converters::test {

/// A GeoTIFF for tests: value(column, row, band).
struct GeoTiff {
  int width = 0, height = 0, bands = 1;
  GDALDataType type = GDT_Float32;
  std::array<double, 6> transform{};
  std::string crs;  ///< as OGRSpatialReference::SetFromUserInput takes it; "": none
  std::function<double(int x, int y, int band)> value;
  std::function<void(GDALDataset& file)> also = [](GDALDataset&) {};

  void write(const std::filesystem::path& path) const {
    use_gdal();
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    GDALDataset* file = driver->Create(path.c_str(), width, height, bands, type, nullptr);
    ASSERT_NE(file, nullptr) << path;
    std::array<double, 6> copy = transform;
    if (copy != std::array<double, 6>{}) file->SetGeoTransform(copy.data());
    if (!crs.empty()) {
      OGRSpatialReference system;
      ASSERT_EQ(system.SetFromUserInput(crs.c_str()), OGRERR_NONE) << crs;
      file->SetSpatialRef(&system);
    }
    also(*file);
    std::vector<double> row(static_cast<std::size_t>(width));
    for (int band = 1; band <= bands; ++band) {
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) row[static_cast<std::size_t>(x)] = value(x, y, band);
        ASSERT_EQ(file->GetRasterBand(band)->RasterIO(GF_Write, 0, y, width, 1, row.data(), width, 1,
                                                      GDT_Float64, 0, 0, nullptr),
                  CE_None);
      }
    }
    GDALClose(GDALDataset::ToHandle(file));
  }
};

}  // namespace converters::test
