#include "app/view/text.h"

#include <cmath>
#include <cstdio>

namespace app::view {
namespace {

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char text[96];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

}  // namespace

std::string latitude_longitude(double lat_deg, double lon_deg) {
  return formatted("%.5f° %c  %.5f° %c", std::abs(lat_deg), lat_deg < 0.0 ? 'S' : 'N', std::abs(lon_deg),
                   lon_deg < 0.0 ? 'W' : 'E');
}

std::string sexagesimal(double degrees, char positive, char negative) {
  const auto tenths = std::llround(std::abs(degrees) * 36000.0);
  return formatted("%lld° %02lld' %04.1f\" %c", tenths / 36000, tenths / 600 % 60,
                   static_cast<double>(tenths % 600) / 10.0, degrees < 0.0 ? negative : positive);
}

std::string length(double metres) {
  const double size = std::abs(metres);
  if (size < 10.0) return formatted("%.1f m", metres);
  if (size < 10e3) return formatted("%.0f m", metres);
  if (size < 100e3) return formatted("%.1f km", metres / 1e3);
  return formatted("%.0f km", metres / 1e3);
}

std::string bytes(double count) {
  return count < 1e6 ? formatted("%.0f kB", count / 1e3) : formatted("%.1f MB", count / 1e6);
}

}  // namespace app::view
