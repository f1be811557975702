#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "globe/base/error.h"
#include "globe/scene/camera_path.h"
#include "globe/scene/track_file.h"

namespace {

/// A path along which every view is finite.
void check(const std::vector<globe::scene::PathKey>& keys) {
  const auto stops = globe::scene::stops_of(
      keys, globe::geo::kWgs84, [](const globe::geo::Geodetic&) { return 0.0; }, 2.0);
  const globe::scene::CameraPath path(stops, -10.0);
  for (int k = 0; k <= 16; ++k) {
    const auto view = path.at(path.duration_s() * k / 16);
    if (!std::isfinite(view.u.x + view.u.y + view.u.z) || !std::isfinite(view.heading_deg + view.roll_deg) ||
        !(view.above_m > 0.0) || !(std::abs(view.pitch_deg) <= 90.0))
      std::abort();
  }
}

}  // namespace

/// Whatever the bytes are taken for, KML, GPX or CSV: refused in one line, or a path.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const auto& read :
       {+[](const std::string& t) { return globe::scene::read_kml(t, "fuzz", {}); },
        +[](const std::string& t) { return globe::scene::read_gpx(t, "fuzz", {}); },
        +[](const std::string& t) { return globe::scene::read_track_csv(t, "fuzz", {}); }}) {
    try {
      check(read(text));
    } catch (const globe::Error& error) {
      if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
    }
  }
  return 0;
}
