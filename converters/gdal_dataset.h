#pragma once

#include <memory>
#include <string>

class GDALDataset;

namespace converters {

struct CloseDataset {
  void operator()(GDALDataset* dataset) const;
};
using DatasetHandle = std::unique_ptr<GDALDataset, CloseDataset>;

/// Opens a raster by GDAL for reading; null when GDAL does not know its kind. `path` may be a sub-dataset, as
/// in NETCDF:"file.nc":topo, of a file that exists. A handle is for one thread at a time.
DatasetHandle open_dataset(const std::string& path, int threads);

/// Whether the words name a sub-dataset of a file that exists, DRIVER:"file":name.
bool is_subdataset(const std::string& words);

}  // namespace converters
