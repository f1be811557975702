#pragma once

#include <string>

namespace app::view {

// Numbers as people read them on a screen.

/// "47.12345° N 11.00000° E".
std::string latitude_longitude(double lat_deg, double lon_deg);
/// "47° 07' 24.4\" N".
std::string sexagesimal(double degrees, char positive, char negative);
/// "523 m", "12.3 km", "1.2 m".
std::string length(double metres);
/// "12.3 MB".
std::string bytes(double count);

}  // namespace app::view
