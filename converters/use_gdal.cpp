#include "converters/use_gdal.h"

#include <OpenImageIO/imageio.h>
#include <cpl_conv.h>
#include <gdal_frmts.h>
#include <gdal_priv.h>
#include <tiffio.h>

#include <algorithm>
#include <mutex>

namespace converters {
namespace {

constexpr GIntBig kBlockCacheBytes = GIntBig{32} << 20;

thread_local std::string the_first_failure;

void CPL_STDCALL keep_first_failure(CPLErr kind, CPLErrorNum, const char* message) {
  if (kind < CE_Failure || !the_first_failure.empty()) return;
  the_first_failure = message;
  std::replace(the_first_failure.begin(), the_first_failure.end(), '\n', ' ');
}

/// Drivers of rasters that lie in files of their own, most asked for first: each is asked in turn whether a
/// file is its.
void register_drivers() {
  GDALRegister_GTiff();
  GDALRegister_VRT();
  GDALRegister_MEM();
  GDALRegister_netCDF();
  GDALRegister_SRTMHGT();
  GDALRegister_AAIGrid();
  GDALRegister_USGSDEM();
  GDALRegister_DTED();
  GDALRegister_PNG();
  GDALRegister_JPEG();
  GDALRegister_HFA();
  GDALRegister_EHdr();
  GDALRegister_ENVI();
  GDALRegister_PDS();
  GDALRegister_PDS4();
  GDALRegister_ISIS2();
  GDALRegister_ISIS3();
  GDALRegister_VICAR();
  GDALRegister_GRIB();
  GDALRegister_HDF5();
  GDALRegister_HDF5Image();
  GDALRegister_BAG();
  GDALRegister_JP2OpenJPEG();
  GDALRegister_GTX();
  GDALRegister_BYN();
  GDALRegister_ISG();
  GDALRegister_NGSGEOID();
  GDALRegister_GRASSASCIIGrid();
  GDALRegister_GSAG();
  GDALRegister_GSBG();
  GDALRegister_GS7BG();
  GDALRegister_SAGA();
  GDALRegister_RRASTER();
  GDALRegister_ERS();
  GDALRegister_IDRISI();
  GDALRegister_ILWIS();
  GDALRegister_PCIDSK();
  GDALRegister_SDTS();
  GDALRegister_SIGDEM();
  GDALRegister_FITS();
  GDALRegister_GXF();
  GDALRegister_BT();
  GDALRegister_HF2();
  GDALRegister_Terragen();
  GDALRegister_Leveller();
  GDALRegister_NWT_GRD();
  GDALRegister_ZMap();
  GDALRegister_XYZ();
}

}  // namespace

void use_gdal() {
  static std::once_flag registered;
  std::call_once(registered, [] {
    CPLSetErrorHandler(keep_first_failure);
    CPLSetConfigOption("GDAL_DRIVER_PATH", "disable");           // no plug-ins
    CPLSetConfigOption("GDAL_DISABLE_READDIR_ON_OPEN", "TRUE");  // side files yes, lists of folders no
    CPLSetConfigOption("CPL_VSIL_CURL_ALLOWED_FILENAME", "none");
    CPLSetConfigOption("GDAL_VRT_ENABLE_PYTHON", "NO");
    GDALSetCacheMax64(kBlockCacheBytes);
    register_drivers();
    // OpenImageIO sets libtiff's handlers when it first makes a reader, the GeoTIFF driver when it is first
    // used.
    const auto reader = OIIO::ImageInput::create("first.tif");
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

std::string first_failure() { return the_first_failure; }

void forget_failures() { the_first_failure.clear(); }

}  // namespace converters
