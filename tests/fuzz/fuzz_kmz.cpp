#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "globe/base/error.h"
#include "globe/scene/track_file.h"
#include "tests/fuzz/scratch_file.h"

/// Bytes of an archive: refused in one line, or a path.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::ScratchFile file("fuzz.kmz");
  file.write(data, size);
  try {
    globe::scene::read_track_file(file.path(), {});
  } catch (const globe::Error& error) {
    if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
  }
  return 0;
}
