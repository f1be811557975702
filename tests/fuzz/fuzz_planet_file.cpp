#include <cstddef>
#include <cstdint>

#include "globe/base/error.h"
#include "globe/planet/dataset.h"
#include "globe/planet/planet_file.h"
#include "tests/fuzz/scratch_file.h"

/// A planet.json of any bytes is read or refused; so is a planet whose files are all missing.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFile file(globe::planet::kPlanetFileName);
  file.write(data, size);
  try {
    globe::planet::read_planet_file(file.folder());
    globe::planet::Dataset::open(file.folder(), std::size_t{1} << 20);
  } catch (const globe::Error&) {
  }
  return 0;
}
