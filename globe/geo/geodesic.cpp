#include "globe/geo/geodesic.h"

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/GeodesicExact.hpp>
#include <GeographicLib/GeodesicLine.hpp>
#include <GeographicLib/GeodesicLineExact.hpp>
#include <cassert>
#include <cmath>
#include <string>
#include <variant>

#include "globe/base/error.h"

namespace globe::geo {
namespace {

constexpr double kSeriesFlattening = 0.02;  ///< up to here the series err by 30 nm at most (Geodesic.hpp)
constexpr double kLeastAxisRatio = 0.01, kGreatestAxisRatio = 100.0;  ///< of GeodesicExact.hpp's table

using AnySolver = std::variant<GeographicLib::Geodesic, GeographicLib::GeodesicExact>;

AnySolver make_solver(const Ellipsoid& ellipsoid) {
  const double ratio = 1.0 - ellipsoid.f;
  if (!(ratio >= kLeastAxisRatio && ratio <= kGreatestAxisRatio)) {
    throw UsageError("ellipsoid",
                     "a flattening of " + std::to_string(ellipsoid.f) + " is too much for geodesics",
                     "give one from -99 to 0.99");
  }
  if (std::abs(ellipsoid.f) > kSeriesFlattening)
    return GeographicLib::GeodesicExact(ellipsoid.a, ellipsoid.f);
  return GeographicLib::Geodesic(ellipsoid.a, ellipsoid.f);
}

/// One name for the way south.
double azimuth(double azi_deg) { return azi_deg == -180.0 ? 180.0 : azi_deg; }

}  // namespace

struct GeodesicSolver::Solver {
  AnySolver any;
};

GeodesicSolver::GeodesicSolver(const Ellipsoid& ellipsoid)
    : solver_(std::make_shared<const Solver>(Solver{make_solver(ellipsoid)})) {}

Geodesic GeodesicSolver::inverse(const Geodetic& a, const Geodetic& b) const {
  Geodesic result;
  std::visit(
      [&](const auto& solver) {
        solver.Inverse(a.lat_deg, a.lon_deg, b.lat_deg, b.lon_deg, result.s12_m, result.azi1_deg,
                       result.azi2_deg);
      },
      solver_->any);
  result.azi1_deg = azimuth(result.azi1_deg);
  result.azi2_deg = azimuth(result.azi2_deg);
  return result;
}

std::vector<Geodetic> GeodesicSolver::places_along(const Geodetic& a, const Geodetic& b,
                                                   std::size_t count) const {
  assert(count >= 2);
  std::vector<Geodetic> places(count);
  places.front() = {a.lat_deg, a.lon_deg};
  places.back() = {b.lat_deg, b.lon_deg};
  std::visit(
      [&](const auto& solver) {
        const auto line = solver.InverseLine(a.lat_deg, a.lon_deg, b.lat_deg, b.lon_deg);
        for (std::size_t k = 1; k + 1 < count; ++k) {
          Geodetic& place = places[k];
          const double share = static_cast<double>(k) / static_cast<double>(count - 1);
          line.Position(share * line.Distance(), place.lat_deg, place.lon_deg);
          if (place.lon_deg >= 180.0) place.lon_deg -= 360.0;
        }
      },
      solver_->any);
  return places;
}

}  // namespace globe::geo
