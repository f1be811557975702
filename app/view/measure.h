#pragma once

#include <optional>
#include <vector>

#include "globe/geo/ellipsoid.h"
#include "globe/geo/geodesic.h"

namespace app::view {

/// The ground along a line that a person lays on it.
struct MeasuredLine {
  globe::geo::Geodetic from, to;
  globe::geo::Geodesic geodesic;
  std::vector<globe::geo::Geodetic> places;  ///< evenly from one end to the other
  std::vector<float> ground_m;               ///< heights there
};

/// A measuring line between two places that are pointed at, one after the other.
class Measure {
 public:
  static constexpr std::size_t kPlaces = 257;

  explicit Measure(const globe::geo::Ellipsoid& ellipsoid) : solver_(ellipsoid) {}

  bool is_on() const { return on_; }
  void set_on(bool on);
  /// One more place: the beginning of a line, or its end.
  /// @param ground_m  (lat_deg, lon_deg) to height above the ellipsoid, metres
  template <class Ground>
  void add(const globe::geo::Geodetic& place, const Ground& ground_m) {
    if (!add_place(place)) return;
    for (const globe::geo::Geodetic& at : line_->places)
      line_->ground_m.push_back(static_cast<float>(ground_m(at.lat_deg, at.lon_deg)));
  }

  const std::optional<globe::geo::Geodetic>& begun_at() const { return begin_; }
  const std::optional<MeasuredLine>& line() const { return line_; }

 private:
  bool add_place(const globe::geo::Geodetic& place);

  globe::geo::GeodesicSolver solver_;
  bool on_ = false;
  std::optional<globe::geo::Geodetic> begin_;
  std::optional<MeasuredLine> line_;
};

}  // namespace app::view
