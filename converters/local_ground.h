#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "converters/map_input.h"
#include "converters/source_map.h"
#include "globe/geo/ellipsoid.h"

namespace converters {

/// A raster of heights of some place, to be asked what is where. Safe to ask from any thread.
class LocalGround {
 public:
  /// Reads the raster to its end, all of it into memory or scratch. Throws globe::Error when it cannot be
  /// used, or is a map of the whole planet.
  LocalGround(const MapInput& input, const globe::geo::Ellipsoid& ellipsoid, std::size_t memory_bytes,
              int threads, const std::function<void(double)>& progress = {});

  /// Samples along rows and down.
  int width() const { return map_->geometry().width; }
  int height() const { return map_->geometry().height; }
  /// Share of it that is void, 0 to 1.
  double void_share() const { return map_->void_share(); }
  /// How it lies on the planet, in words.
  const std::string& frame() const { return frame_; }
  const std::string& vertical_datum() const { return datum_; }

  /// Heights under geodetic normals, metres: bilinear between samples; in voids from the samples around them,
  /// off the raster those of its edge.
  void heights(std::span<const globe::geo::dvec3> normals, std::span<float> heights_m) const;
  /// Whether there is a sample's height at a place, neither void nor off the raster.
  bool is_known(const globe::geo::dvec3& normal) const;
  /// The geodetic normal of a place in the raster: samples from the first one's own place, along rows and
  /// down. To a thousandth of a sample. Throws globe::Error where the projection leads nowhere.
  globe::geo::dvec3 normal_of(double x, double y) const;

 private:
  void heights_at(std::span<const SamplePlace> places, std::span<float> heights_m) const;

  std::string name_, frame_, datum_;
  std::unique_ptr<MemoryBudget> budget_;
  std::unique_ptr<SourceMap> map_;
  globe::geo::dvec3 inside_{0.0};  ///< a place on the raster, or near it
};

}  // namespace converters
