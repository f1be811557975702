#include <cstddef>
#include <cstdint>
#include <vector>

#include "converters/map_input.h"
#include "globe/base/error.h"
#include "tests/fuzz/scratch_file.h"

/// A georeferenced raster of any bytes finds its place and is read to its end, or is refused. The first byte
/// picks the file's kind by its name. Rasters that claim more than 1 MiB are left at their place: what
/// decoding them costs is no fault.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFile files[] = {fuzz::ScratchFile("map.tif"), fuzz::ScratchFile("map.asc"),
                                            fuzz::ScratchFile("map.vrt"), fuzz::ScratchFile("map.dt0"),
                                            fuzz::ScratchFile("map.dem"), fuzz::ScratchFile("map.img")};
  if (size == 0) return 0;
  const fuzz::ScratchFile& file = files[data[0] % std::size(files)];
  file.write(data + 1, size - 1);
  const auto kind = (data[0] & 0x80) != 0 ? converters::MapKind::kColors : converters::MapKind::kHeights;
  try {
    const converters::OpenedMap map = converters::open_map({file.path()}, kind, {globe::geo::kWgs84}, 1);
    static_cast<void>(place_of(map.geometry, globe::geo::normal_from_degrees(40, -100)));
    const converters::RasterInfo& info = map.raster->info();
    const std::size_t row = static_cast<std::size_t>(info.width) * static_cast<std::size_t>(info.channels) *
                            converters::size_of(info.type);
    if (row * static_cast<std::size_t>(info.height) > std::size_t{1} << 20) return 0;
    std::vector<std::uint8_t> rows(row * static_cast<std::size_t>(info.height));
    map.raster->read_rows(info.height, rows.data());
  } catch (const globe::Error&) {
  }
  return 0;
}
