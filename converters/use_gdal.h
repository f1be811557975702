#pragma once

#include <cpl_error.h>

namespace converters {

/// Makes GDAL's raster drivers known, once. Call before anything else of GDAL.
///
/// OpenImageIO reads and writes TIFF with the same libtiff: GDAL's drivers would turn libtiff's messages,
/// which OpenImageIO keeps to itself or passes on, into lines on standard error. Its handlers stay as they
/// were.
void use_gdal();

/// While it lives, GDAL prints nothing in this thread; what went wrong is there to ask.
class QuietGdal {
 public:
  QuietGdal() {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;

  bool failed() const { return CPLGetLastErrorType() >= CE_Failure; }
};

}  // namespace converters
