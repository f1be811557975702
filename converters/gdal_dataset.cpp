#include "converters/gdal_dataset.h"

#include <cpl_string.h>
#include <gdal_priv.h>

#include <filesystem>

#include "converters/use_gdal.h"

namespace converters {
namespace {

DatasetHandle open(const std::string& path, const CPLStringList& options) {
  return DatasetHandle(GDALDataset::FromHandle(
      GDALOpenEx(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, nullptr, options.List(), nullptr)));
}

}  // namespace

void CloseDataset::operator()(GDALDataset* dataset) const { GDALClose(GDALDataset::ToHandle(dataset)); }

DatasetHandle open_dataset(const std::string& path, int threads) {
  use_gdal();
  forget_failures();
  CPLStringList options;
  options.SetNameValue("NUM_THREADS", std::to_string(threads).c_str());
  DatasetHandle dataset = open(path, options);
  // Integers would hide the "nan" of a text.
  if (dataset && dataset->GetDriverName() == std::string("AAIGrid") &&
      dataset->GetRasterBand(1)->GetRasterDataType() == GDT_Int32) {
    options.SetNameValue("DATATYPE", "Float64");
    dataset = open(path, options);
  }
  return dataset;
}

bool is_subdataset(const std::string& words) {
  const std::size_t colon = words.find(':');
  if (colon == std::string::npos || colon < 3 || words.find("/vsi") != std::string::npos ||
      words.find("://") != std::string::npos)
    return false;
  std::string file = words.substr(colon + 1);
  if (file.starts_with('"')) {
    file = file.substr(1, file.find('"', 1) - 1);
  } else if (!std::filesystem::is_regular_file(file)) {
    file = file.substr(0, file.rfind(':'));
  }
  std::error_code ignored;
  return std::filesystem::is_regular_file(file, ignored);
}

}  // namespace converters
