#pragma once

namespace converters {

/// A part of the planet as an equirectangular map: pixels are areas, the first row is the northernmost.
struct MapWindow {
  double west_deg = -180;  ///< of the first column's outer edge
  double north_deg = 90;   ///< of the first row's
  double step_x_deg = 0;   ///< of a pixel
  double step_y_deg = 0;
  int width = 0;  ///< pixels
  int height = 0;

  /// Of a place in the map, in pixels from its outer edges: the centre of the first pixel is (0.5, 0.5).
  double longitude(double x) const { return west_deg + x * step_x_deg; }
  double latitude(double y) const { return north_deg - y * step_y_deg; }
};

}  // namespace converters
