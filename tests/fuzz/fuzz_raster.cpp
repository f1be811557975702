#include <cstddef>
#include <cstdint>
#include <vector>

#include "converters/raster_source.h"
#include "globe/base/error.h"
#include "tests/fuzz/scratch_file.h"

/// A map file of any bytes is read to its end or refused. Rasters that claim more than 1 MiB are left at
/// their header: what decoding them costs is no fault.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFile file("map.tif");
  file.write(data, size);
  try {
    const auto raster = converters::open_image(file.path(), 1);
    const converters::RasterInfo& info = raster->info();
    const std::size_t row = static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.channels) *
                            converters::size_of(info.type);
    if (row * static_cast<std::size_t>(info.height) > std::size_t{1} << 20) return 0;
    std::vector<std::uint8_t> rows(row * static_cast<std::size_t>(info.height));
    raster->read_rows(info.height, rows.data());
  } catch (const globe::Error&) {
  }
  return 0;
}
