#include "converters/geoid.h"

#include <GeographicLib/Geoid.hpp>
#include <algorithm>
#include <filesystem>
#include <vector>

#include "converters/map_input.h"
#include "converters/sampler.h"
#include "globe/base/error.h"

namespace converters {
namespace {

class RasterGeoid : public Geoid {
 public:
  explicit RasterGeoid(std::shared_ptr<const SourceMap> map) { maps_.add(std::move(map), Filter::kBicubic); }

  void add(const NodeRect& rect, float* heights) const override {
    std::vector<float> values(static_cast<std::size_t>(rect.ni) * static_cast<std::size_t>(rect.nj));
    std::vector<float> weights(values.size());
    sample_rect(maps_, rect, Gaps::kFill, values.data(), weights.data());
    for (std::size_t k = 0; k < values.size(); ++k) heights[k] += values[k];
  }

 private:
  MapStack maps_;
};

class GeographicLibGeoid : public Geoid {
 public:
  GeographicLibGeoid(const std::string& name, const std::string& folder) : geoid_(name, folder, true, true) {}

  void add(const NodeRect& rect, float* heights) const override {
    for (int j = 0; j < rect.nj; ++j) {
      for (int i = 0; i < rect.ni; ++i) {
        const globe::geo::Geodetic at = globe::geo::degrees_from_normal(
            globe::planet::node_direction({rect.d, rect.level, rect.i0 + i, rect.j0 + j}));
        float& height = heights[static_cast<std::size_t>(j) * static_cast<std::size_t>(rect.ni) +
                                static_cast<std::size_t>(i)];
        height += static_cast<float>(geoid_(at.lat_deg, at.lon_deg));
      }
    }
  }

 private:
  GeographicLib::Geoid geoid_;
};

/// Null when it is no geoid of GeographicLib's kind.
std::unique_ptr<const Geoid> open_geographiclib(const std::string& grid) {
  const std::filesystem::path path = grid;
  const bool is_file = path.extension() == ".pgm";
  const std::filesystem::path folder = is_file ? path.parent_path() : std::filesystem::path();
  const std::string name = is_file ? path.stem().string() : grid;
  if (!is_file && name.find_first_of("/.:") != std::string::npos) return nullptr;
  try {
    return std::make_unique<GeographicLibGeoid>(name, is_file && folder.empty() ? "." : folder.string());
  } catch (const std::exception& error) {
    if (is_file && std::filesystem::exists(path))
      throw globe::Error(grid, error.what(), "give another --geoid");
    return nullptr;
  }
}

}  // namespace

std::unique_ptr<const Geoid> open_geoid(const std::string& grid, const PlanetFrame& frame,
                                        MemoryBudget& budget) {
  std::unique_ptr<const Geoid> geoid = open_geographiclib(grid);
  if (geoid) return geoid;
  if (!std::filesystem::is_regular_file(grid)) {
    throw globe::Error(grid,
                       "no such file, nor an installed geoid of GeographicLib in " +
                           GeographicLib::Geoid::DefaultGeoidPath(),
                       "check the name; geographiclib-get-geoids installs them");
  }
  OpenedMap map = open_map({grid}, MapKind::kHeights, frame, 1);
  if (!map.geometry.is_whole_planet())
    throw globe::Error(grid, "the geoid does not cover the planet",
                       "give a grid from pole to pole, all around");
  return std::make_unique<RasterGeoid>(
      std::make_shared<SourceMap>(*map.raster, map.geometry, map.rule, 1, budget, [](double) {}));
}

}  // namespace converters
