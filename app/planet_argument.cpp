#include "app/planet_argument.h"

#include <charconv>
#include <cstdint>
#include <cstdio>
#include <string_view>

#include "globe/base/error.h"

namespace app {
namespace {

constexpr std::uint64_t kDefaultSeed = 1;

}  // namespace

std::optional<std::uint64_t> procedural_seed(const std::string& planet) {
  constexpr std::string_view kName = "procedural";
  if (!planet.starts_with(kName)) return std::nullopt;
  if (planet == kName) return kDefaultSeed;
  std::uint64_t seed = 0;
  const char* last = planet.data() + planet.size();
  const char* first = planet[kName.size()] == ':' ? planet.data() + kName.size() + 1 : last;
  const auto [end, error] = std::from_chars(first, last, seed);
  if (first == last || end != last || error != std::errc()) {
    throw globe::UsageError(planet, "the seed is not a whole number below 2^64",
                            "write procedural or procedural:7");
  }
  return seed;
}

std::shared_ptr<const globe::planet::Surface> open_planet(const std::string& planet) {
  return open_planet(planet, kDatasetCache, globe::planet::Surface::kDefaultCache);
}

std::shared_ptr<const globe::planet::Surface> open_planet(const std::string& planet,
                                                          std::size_t dataset_cache,
                                                          std::size_t surface_cache, double exaggeration,
                                                          globe::planet::SeaFloor sea_floor,
                                                          const globe::planet::LayerChoice& layers) {
  using globe::planet::Dataset;
  using globe::planet::Surface;
  if (const auto seed = procedural_seed(planet))
    return Surface::builtin(*seed, surface_cache, exaggeration, sea_floor);
  return Surface::from_dataset(std::make_shared<const Dataset>(Dataset::open(planet, dataset_cache, layers)),
                               surface_cache, exaggeration, sea_floor);
}

void require_heights(const globe::planet::Surface& surface, const std::string& planet) {
  if (!surface.has_heights()) {
    throw globe::Error(planet, "the planet has no heights", "convert it again with a height map");
  }
}

void warn_of_unknown_datum(const globe::planet::Surface& surface, const std::string& planet) {
  if (surface.info().vertical_datum != "unknown") return;
  std::fprintf(stderr, "globe: warning: %s: what its heights count from is unknown; taken as the ellipsoid\n",
               planet.c_str());
}

}  // namespace app
