#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <memory>
#include <vector>

#include "app/accuracy/study.h"
#include "globe/clipmap/culling.h"
#include "globe/effects/shape_lines.h"
#include "globe/geo/ellipsoid.h"
#include "globe/render/camera.h"

namespace app::accuracy {
namespace {

namespace effects = globe::effects;
namespace geo = globe::geo;
using effects::Arc;
using effects::MapCorner;
using glm::dvec3;

constexpr double kUsual_px = 0.25;
constexpr int kPictureHeight = 720;
constexpr int kPlaces = 2000;  ///< of an edge

/// Edges that are far from great circles, and where they are looked at.
constexpr std::array kEdges{std::array{MapCorner{60.0, -120.0}, MapCorner{60.0, 120.0}},
                            std::array{MapCorner{-40.0, 10.0}, MapCorner{62.0, 170.0}},
                            std::array{MapCorner{89.0, -170.0}, MapCorner{89.0, 170.0}}};
constexpr std::array kHeights_m{2.0, 100.0, 1e4, 1e6, 2e7};

/// An edge from above its middle.
struct Looked {
  Looked(const std::array<MapCorner, 2>& edge, double above_m)
      : ends(edge),
        above(above_m),
        camera(globe::render::make_camera(
            geo::kWgs84,
            {0.5 * (ends[0].lat_deg + ends[1].lat_deg), 0.5 * (ends[0].lon_deg + ends[1].lon_deg), above_m},
            0.0, -90.0, 60.0, 1.0)),
        frustum(camera.forward, camera.right, camera.up, camera.tan_x(), camera.tan_y()),
        horizon(geo::kWgs84, -1.0, camera.position),
        line(geo::kWgs84, {ends[0], ends[1]}, 1.0f) {}

  double pixel() const { return 2.0 * camera.tan_y() / kPictureHeight; }

  std::vector<Arc> arcs(double tolerance_px) const {
    const effects::LineView view{geo::kWgs84,
                                 camera.position,
                                 frustum,
                                 horizon,
                                 pixel(),
                                 tolerance_px,
                                 0.0,
                                 above,
                                 -1.0,
                                 1.0,
                                 [](const dvec3&, double, double) { return glm::dvec2(-1.0, 1.0); }};
    std::vector<Arc> made;
    line.add_arcs(view, made);
    return made;
  }

  std::array<MapCorner, 2> ends;
  double above;
  globe::render::Camera camera;
  globe::clipmap::Frustum frustum;
  globe::clipmap::Horizon horizon;
  effects::ShapeLine line;
};

/// How far places of the edge that are in view lie from the nearest arc, pixels.
void add_errors(const Looked& looked, double tolerance_px, ErrorSum& sum) {
  const std::vector<Arc> arcs = looked.arcs(tolerance_px);
  for (int k = 0; k <= kPlaces; ++k) {
    const double t = static_cast<double>(k) / kPlaces;
    const double lat = looked.ends[0].lat_deg + t * (looked.ends[1].lat_deg - looked.ends[0].lat_deg);
    const double lon = looked.ends[0].lon_deg + t * (looked.ends[1].lon_deg - looked.ends[0].lon_deg);
    const dvec3 place = geo::surface_point(geo::kWgs84, geo::normal_from_degrees(lat, lon));
    const dvec3 at = place - looked.camera.position;
    if (!looked.frustum.sees(at, 0.0) || !looked.horizon.sees(place, 0.0, 0.0)) continue;
    double least = 1e30;
    for (const Arc& arc : arcs) {
      const double along = glm::dot(dvec3(arc.along), at) - static_cast<double>(arc.along.w);
      const double across = glm::dot(dvec3(arc.across), at) - static_cast<double>(arc.across.w);
      const double beyond = along - std::clamp(along, 0.0, static_cast<double>(arc.up_b.w));
      least = std::min(least, std::hypot(beyond, across));
    }
    sum.add(least / (glm::length(at) * looked.pixel()), [&] {
      char text[96];
      std::snprintf(text, sizeof text, "%.4f,%.4f from %.0f m", lat, lon, looked.above);
      return std::string(text);
    });
  }
}

}  // namespace

std::vector<Study> marks_studies(const Scope& /*scope*/) {
  auto views = std::make_shared<std::vector<Looked>>();
  for (const auto& edge : kEdges)
    for (const double above : kHeights_m) views->emplace_back(edge, above);
  Study study{
      "marks.lines",
      "Arcs that stand for an edge straight in latitude and longitude (effects.shapes, error)",
      "",
      "places of the edge",
      "places in view of edges far along a parallel, aslant and by the pole, from 2 m to 20,000 km above "
      "their middles",
      "pixels",
      "us a view",
      {}};
  for (const double tolerance : {0.05, kUsual_px, 1.0, 4.0}) {
    ErrorSum sum;
    for (const Looked& looked : *views) add_errors(looked, tolerance, sum);
    char name[32];
    std::snprintf(name, sizeof name, "%g pixels", tolerance);
    study.settings.push_back({name, sum.figure(),
                              timed(
                                  static_cast<double>(views->size()),
                                  [views, tolerance] {
                                    std::size_t count = 0;
                                    for (const Looked& looked : *views)
                                      count += looked.arcs(tolerance).size();
                                    keep(static_cast<double>(count));
                                  },
                                  1e3),
                              tolerance == kUsual_px});
  }
  return {std::move(study)};
}

}  // namespace app::accuracy
