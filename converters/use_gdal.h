#pragma once

#include <cpl_error.h>

#include <string>

namespace converters {

/// Makes GDAL's drivers of georeferenced rasters in files known, once; nothing that reaches for a network,
/// even when a file asks for it. GDAL prints nothing from then on. Call before anything else of GDAL.
///
/// OpenImageIO reads and writes TIFF with the same libtiff: GDAL's drivers would turn libtiff's messages,
/// which OpenImageIO keeps to itself or passes on, into lines on standard error. Its handlers stay as they
/// were.
void use_gdal();

/// What went wrong first in this thread since forget_failures(), in one line; "" when nothing did.
std::string first_failure();
void forget_failures();

/// While it lives, GDAL's last error in this thread is one that came up meanwhile.
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
