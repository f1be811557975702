#include "app/planet_argument.h"

#include <charconv>
#include <cstdint>

#include "globe/base/error.h"

namespace app {
namespace {

constexpr std::uint64_t kDefaultSeed = 1;
constexpr std::size_t kDatasetCache = std::size_t{256} << 20;

}  // namespace

std::shared_ptr<const globe::planet::Surface> open_planet(const std::string& planet) {
  using globe::planet::Dataset;
  using globe::planet::Surface;
  if (planet.rfind("procedural", 0) == 0) {
    if (planet == "procedural") return Surface::builtin(kDefaultSeed);
    std::uint64_t seed = 0;
    const char* first = planet.data() + 11;
    const char* last = planet.data() + planet.size();
    const bool has_seed = planet.size() > 11 && planet[10] == ':';
    if (!has_seed || std::from_chars(first, last, seed).ptr != last) {
      throw globe::UsageError(planet, "the seed is not a whole number", "write procedural or procedural:7");
    }
    return Surface::builtin(seed);
  }
  return Surface::from_dataset(std::make_shared<const Dataset>(Dataset::open(planet, kDatasetCache)));
}

}  // namespace app
