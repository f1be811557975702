// Map -> diamonds -> map, on harmonics that are known everywhere and on real elevation: error and time of
// each filter and level, as CSV. round_trip.sh makes a table and a plot of it.
//
//     globe_round_trip_bench DATA_FOLDER [RUNS]

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "converters/raster_source.h"
#include "converters/round_trip.h"

namespace {

using converters::HeightMap;
using converters::RoundTripLoss;

/// Heights of a picture file; integers as they are.
HeightMap read_picture(const std::filesystem::path& path, double west_deg) {
  const auto raster = converters::open_image(path, 1);
  const converters::RasterInfo& info = raster->info();
  HeightMap map{info.width, west_deg, {}};
  const auto count = static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.height);
  map.metres.resize(count);
  if (info.type == converters::SampleType::kInt16) {
    std::vector<std::int16_t> raw(count);
    raster->read_rows(info.height, raw.data());
    std::copy(raw.begin(), raw.end(), map.metres.begin());
  } else {
    raster->read_rows(info.height, map.metres.data());
  }
  return map;
}

/// MOLA's heights: 16 bits, big end first, no header, longitudes from 0.
HeightMap read_mars(const std::filesystem::path& path) {
  HeightMap map{1440, 0.0, {}};
  std::ifstream in(path, std::ios::binary);
  for (int k = 0; k < map.width * map.height(); ++k) {
    const int high = in.get(), low = in.get();
    map.metres.push_back(static_cast<std::int16_t>(high << 8 | low));
  }
  return map;
}

void run(const char* name, const HeightMap& map, const HeightMap& truth, int first_level, int last_level,
         int runs) {
  for (const converters::NamedRoundTrip& method : converters::round_trip_methods()) {
    for (int level = first_level; level <= last_level; ++level) {
      RoundTripLoss loss = converters::round_trip(map, method.method, level, truth);
      for (int k = 1; k < runs; ++k) {
        const RoundTripLoss again = converters::round_trip(map, method.method, level, truth);
        loss.there_s = std::min(loss.there_s, again.there_s);
        loss.back_s = std::min(loss.back_s, again.back_s);
      }
      std::printf("%s;%s;%d;%llu;%llu;%.3f;%.4f;%.2f;%.4f;%.4f\n", name, method.name, level,
                  static_cast<unsigned long long>(loss.nodes), static_cast<unsigned long long>(loss.pixels),
                  loss.max_m, loss.rms_m, loss.psnr_db, loss.there_s, loss.back_s);
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "globe_round_trip_bench DATA_FOLDER [RUNS]\n");
    return 2;
  }
  const std::filesystem::path data = argv[1];
  const int runs = argc > 2 ? std::max(1, std::atoi(argv[2])) : 3;
  try {
    std::printf("map;filter;level;nodes;pixels;max_m;rms_m;psnr_db;there_s;back_s\n");
    const converters::Harmonics relief(64, 20261124, 1000.0);
    run("harmonics to degree 64", map_of(relief, 1024), map_of(relief, 1536), 6, 10, runs);
    const auto real = [&](const char* name, const std::filesystem::path& path, const auto& read, int first,
                          int last) {
      if (!std::filesystem::exists(path)) {
        std::fprintf(stderr, "globe_round_trip_bench: %s is missing: left out\n", path.c_str());
        return;
      }
      const HeightMap map = read(path);
      run(name, map, map, first, last, runs);
    };
    real(
        "Earth, ETOPO20", data / "earth/earth_etopo20_f32.tif",
        [](const auto& path) { return read_picture(path, -180.0); }, 7, 10);
    real("Mars, MOLA", data / "mars/megt90n000cb.img", read_mars, 7, 10);
    real(
        "Moon, GLD100", data / "moon/moon_gld100_12.8ppd_int16.tif",
        [](const auto& path) { return read_picture(path, 0.0); }, 9, 11);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "globe_round_trip_bench: %s\n", error.what());
    return 1;
  }
  return 0;
}
