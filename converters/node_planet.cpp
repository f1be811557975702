#include "converters/node_planet.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "converters/layer_output.h"
#include "globe/planet/planet_file.h"

namespace converters {

void write_node_planet(const std::filesystem::path& folder, int level, const globe::geo::Ellipsoid& ellipsoid,
                       const HeightOfNode& height, const std::string& body) {
  std::filesystem::create_directories(folder);
  MemoryBudget budget{std::size_t{1} << 32, folder};
  const PartFiles parts{folder / "work"};
  std::filesystem::create_directories(parts.folder);
  const NodeSource nodes = [&](const NodeRect& rect, const RowSink& sink) {
    tbb::parallel_for(rect.j0, rect.j0 + rect.nj, [&](int j) {
      std::vector<float> row(static_cast<std::size_t>(rect.ni));
      const std::vector<float> valid(row.size(), 1.0F);
      for (int i = 0; i < rect.ni; ++i)
        row[static_cast<std::size_t>(i)] = static_cast<float>(height({rect.d, level, rect.i0 + i, j}));
      sink(rect.i0, j, rect.ni, row.data(), valid.data());
    });
  };
  Range all{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (const Job& job : jobs_of(JobLayer::kHeight, level)) {
    const Range range = run_job(job, nodes, ellipsoid, parts, [](double) {});
    all = {std::min(all.min, range.min), std::max(all.max, range.max)};
  }
  globe::planet::PlanetFile file;
  file.info = {"nodes", body, "", ellipsoid, "ellipsoid", kTileSize, {}, {}};
  file.layers = write_layers(height_layers(level, all, parts, ellipsoid, budget), folder, [](double) {});
  globe::planet::write_planet_file(folder, std::move(file));
  std::filesystem::remove_all(parts.folder);
}

}  // namespace converters
