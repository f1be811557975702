#include "app/accuracy/harmonic_planet.h"

#include <stdlib.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cerrno>
#include <limits>
#include <string>
#include <system_error>
#include <vector>

#include "converters/layer_output.h"
#include "globe/geo/ellipsoid.h"
#include "globe/planet/grid.h"

namespace app::accuracy {
namespace {

namespace planet = globe::planet;

std::filesystem::path scratch_folder() {
  std::string name = (std::filesystem::temp_directory_path() / "globe-accuracy-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::system_error(errno, std::generic_category(), name);
  return name;
}

void write(const std::filesystem::path& folder, const converters::Harmonics& harmonics, int level) {
  converters::MemoryBudget budget{std::size_t{1} << 30, folder};
  const converters::PartFiles parts{folder / "work"};
  std::filesystem::create_directories(parts.folder);
  const converters::NodeSource nodes = [&](const converters::NodeRect& rect,
                                           const converters::RowSink& sink) {
    tbb::parallel_for(rect.j0, rect.j0 + rect.nj, [&](int j) {
      std::vector<float> row(static_cast<std::size_t>(rect.ni));
      const std::vector<float> valid(row.size(), 1.0F);
      for (int i = 0; i < rect.ni; ++i) {
        // By the node's own name, so that diamonds agree on what they share.
        const planet::Node node = planet::fold({rect.d, level, rect.i0 + i, j});
        const globe::geo::Geodetic place = globe::geo::degrees_from_normal(planet::node_direction(node));
        row[static_cast<std::size_t>(i)] = static_cast<float>(harmonics.at(place.lat_deg, place.lon_deg));
      }
      sink(rect.i0, j, rect.ni, row.data(), valid.data());
    });
  };
  converters::Range all{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (const converters::Job& job : converters::jobs_of(converters::JobLayer::kHeight, level)) {
    const converters::Range range = converters::run_job(job, nodes, globe::geo::kWgs84, parts, [](double) {});
    all = {std::min(all.min, range.min), std::max(all.max, range.max)};
  }
  planet::PlanetFile file;
  file.info = {"harmonics", "other", "", globe::geo::kWgs84, "ellipsoid", converters::kTileSize, {}, {}};
  file.layers = converters::write_layers(
      converters::height_layers(level, all, parts, globe::geo::kWgs84, budget), folder, [](double) {});
  planet::write_planet_file(folder, std::move(file));
}

}  // namespace

HarmonicPlanet::HarmonicPlanet(const converters::Harmonics& harmonics, int level)
    : folder_(scratch_folder()) {
  try {
    write(folder_, harmonics, level);
    surface_ = planet::Surface::from_dataset(
        std::make_shared<const planet::Dataset>(planet::Dataset::open(folder_, std::size_t{64} << 20)));
  } catch (...) {
    std::filesystem::remove_all(folder_);
    throw;
  }
}

HarmonicPlanet::~HarmonicPlanet() {
  surface_.reset();
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

}  // namespace app::accuracy
