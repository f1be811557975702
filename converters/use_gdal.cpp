#include "converters/use_gdal.h"

#include <gdal_priv.h>
#include <tiffio.h>

#include <mutex>

namespace converters {

void use_gdal() {
  static std::once_flag registered;
  std::call_once(registered, [] {
    GDALAllRegister();
    // The GeoTIFF driver sets the handlers when it is first used.
    const TIFFErrorHandler errors = TIFFSetErrorHandler(nullptr);
    const TIFFErrorHandler warnings = TIFFSetWarningHandler(nullptr);
    const QuietGdal quiet;
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    delete driver->Create("/vsimem/globe-first.tif", 1, 1, 1, GDT_Byte, nullptr);
    VSIUnlink("/vsimem/globe-first.tif");
    TIFFSetErrorHandler(errors);
    TIFFSetWarningHandler(warnings);
  });
}

}  // namespace converters
