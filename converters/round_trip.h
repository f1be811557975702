#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "converters/harmonics.h"
#include "converters/map_sampler.h"
#include "converters/map_stack.h"

namespace converters {

/// Heights of a whole planet in memory: twice as wide as high, pixels are areas, north row first.
struct HeightMap {
  int width = 0;
  double west_deg = -180;
  std::vector<float> metres;

  int height() const { return width / 2; }
  double step_deg() const { return 360.0 / width; }
};

/// The harmonics at the centres of pixels.
HeightMap map_of(const Harmonics& harmonics, int width);

/// How a map becomes nodes, and nodes become a map again.
struct RoundTripMethod {
  Filter filter = Filter::kBilinear;      ///< there
  Sampling sampling = Sampling::kLinear;  ///< and back
  bool as_thesis = false;                 ///< nodes taken where the thesis has them, for comparison
};

/// A method, by the name that tables give it.
struct NamedRoundTrip {
  const char* name;
  RoundTripMethod method;
};

/// The methods that tables and plots compare.
std::span<const NamedRoundTrip> round_trip_methods();

/// What a map loses on its way to the nodes of a level and back to a map.
struct RoundTripLoss {
  double max_m = 0;  ///< largest difference
  int worst_x = 0;   ///< the pixel that has it
  int worst_y = 0;
  double rms_m = 0;    ///< root of the mean square, by area
  double psnr_db = 0;  ///< 20 log10 of (highest less lowest of the truth) / rms
  std::uint64_t nodes = 0;
  std::uint64_t pixels = 0;
  double there_s = 0;  ///< on the threads of the calling arena; reading, pyramids and files not counted
  double back_s = 0;
};

/// @param truth  what the map that comes back is compared with, pixel by pixel. The map itself where nothing
///               better is known, which flatters `nearest`: its own samples come back. Of a function that is
///               known everywhere: a map of another width, so that what lies between the samples counts.
RoundTripLoss round_trip(const HeightMap& map, const RoundTripMethod& method, int level,
                         const HeightMap& truth);

}  // namespace converters
