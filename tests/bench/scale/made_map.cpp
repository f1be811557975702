#include <gdal_priv.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

// A map of heights of any size, made and written row by row, never held whole: waves from the width of an
// ocean down to a few samples, and noise in the last metres so that it packs like a measured one.
//     globe_made_map WIDTH HEIGHT MAP.tif

namespace {

struct Wave {
  double waves;  ///< around the equator
  double metres;
};
constexpr Wave kWaves[] = {{3, 2000}, {17, 800}, {130, 200}, {1500, 40}, {9000, 10}};

std::int16_t noise(std::uint32_t x, std::uint32_t y) {
  std::uint32_t h = x * 0x9E3779B1U ^ y * 0x85EBCA77U;
  h = (h ^ (h >> 15)) * 0xC2B2AE3DU;
  return static_cast<std::int16_t>((h >> 24) % 7) - 3;
}

}  // namespace

int main(int argc, char** argv) {
  const int width = argc == 4 ? std::atoi(argv[1]) : 0, height = argc == 4 ? std::atoi(argv[2]) : 0;
  if (width < 2 || height < 1) {
    std::fprintf(stderr, "usage: globe_made_map WIDTH HEIGHT MAP.tif\n");
    return 2;
  }
  GDALAllRegister();
  char** options = nullptr;
  for (const char* option :
       {"TILED=YES", "COMPRESS=DEFLATE", "ZLEVEL=1", "PREDICTOR=2", "BIGTIFF=YES", "NUM_THREADS=ALL_CPUS"})
    options = CSLAddString(options, option);
  const std::unique_ptr<GDALDataset> map(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
      argv[3], width, height, 1, GDT_Int16, options));
  CSLDestroy(options);
  if (!map) return 1;
  double frame[6] = {-180, 360.0 / width, 0, 90, 0, -180.0 / height};
  map->SetGeoTransform(frame);
  OGRSpatialReference wgs84;
  wgs84.importFromEPSG(4326);
  map->SetSpatialRef(&wgs84);

  std::vector<std::vector<float>> columns;
  for (const Wave& wave : kWaves) {
    std::vector<float>& row = columns.emplace_back(static_cast<std::size_t>(width));
    for (int x = 0; x < width; ++x) {
      const double turn = 2.0 * std::numbers::pi * (x + 0.5) / width;
      row[static_cast<std::size_t>(x)] =
          static_cast<float>(wave.metres * std::cos(wave.waves * turn + wave.metres));
    }
  }
  std::vector<std::int16_t> row(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    float rows[std::size(kWaves)];
    for (std::size_t k = 0; k < std::size(kWaves); ++k) {
      const double turn = std::numbers::pi * (y + 0.5) / height;
      rows[k] = static_cast<float>(std::sin(turn) * std::cos(kWaves[k].waves * turn));
    }
    for (std::size_t x = 0; x < row.size(); ++x) {
      float h = 0;
      for (std::size_t k = 0; k < std::size(kWaves); ++k) h += columns[k][x] * rows[k];
      row[x] = static_cast<std::int16_t>(std::lrint(h) +
                                         noise(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)));
    }
    if (map->GetRasterBand(1)->RasterIO(GF_Write, 0, y, width, 1, row.data(), width, 1, GDT_Int16, 0, 0) !=
        CE_None)
      return 1;
  }
  return map->FlushCache(), 0;
}
