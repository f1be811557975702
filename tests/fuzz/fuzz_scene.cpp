#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "globe/base/error.h"
#include "globe/scene/scene.h"

namespace {

std::any read_mist(globe::scene::Fields& fields) {
  const double top_m = fields.length_m("top", globe::scene::at_least(0.0)).value_or(300.0);
  if (!std::isfinite(top_m) || top_m < 0.0) std::abort();
  return top_m;
}

}  // namespace

/// A text is refused in one line, or is a scene whose numbers are in their ranges.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const globe::scene::EffectKind mist{"mist", read_mist};
  try {
    const auto scene = globe::scene::parse_scene(std::string(reinterpret_cast<const char*>(data), size),
                                                 "fuzz.toml", {&mist, 1});
    if (scene.camera && scene.path) std::abort();
    if (scene.camera && !(std::abs(scene.camera->at.position.lat_deg) <= 90.0)) std::abort();
    if (scene.picture.fov_deg && !(*scene.picture.fov_deg > 0.0 && *scene.picture.fov_deg <= 360.0))
      std::abort();
    if (scene.path && scene.path->keys.size() < 2) std::abort();
  } catch (const globe::Error& error) {
    if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
  }
  return 0;
}
