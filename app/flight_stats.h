#pragma once

#include <string>
#include <vector>

#include "globe/geo/ellipsoid.h"
#include "globe/render/globe_renderer.h"

namespace app {

/// Figures of a flight, frame by frame: `--stats` and the table at its end (keys in COMMANDS.md).
class FlightStats {
 public:
  struct Frame {
    int frame = 0;
    globe::geo::Geodetic place;
    double above_ground_m = 0;
    double frame_ms = 0;  ///< from the start of the frame's work to the end of drawing
    double gpu_ms = 0;    ///< by timer query
    globe::render::FrameStats drawn;
  };

  FlightStats(std::string renderer, std::string gl_version, int width, int height, int detail,
              int planet_level);

  void add(const Frame& frame) { frames_.push_back(frame); }

  /// Writes the JSON file, whole or not at all. Throws globe::Error.
  void write(const std::string& path) const;

  /// A dozen lines along the flight and the percentiles.
  std::string table(std::size_t gpu_bytes) const;

 private:
  std::string renderer_, gl_version_;
  int width_, height_, detail_, planet_level_;
  std::vector<Frame> frames_;
};

/// The p-th percentile (0..100) by nearest rank; 0 of no values.
double percentile(std::vector<double> values, double p);

}  // namespace app
