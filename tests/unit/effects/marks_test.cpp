// Marks on a planet: what lies where on the map near an eye, which lines a graticule has, what polygons hold,
// how lines are cut and labels laid out.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <random>
#include <set>

#include "globe/base/angles.h"
#include "globe/base/error.h"
#include "globe/effects/graticule.h"
#include "globe/effects/label_font.h"
#include "globe/effects/label_layout.h"
#include "globe/effects/map_eye.h"
#include "globe/effects/named_places.h"
#include "globe/effects/shape_cells.h"
#include "globe/effects/shape_lines.h"
#include "globe/region/map_polygon.h"
#include "tests/temporary_folder.h"

namespace {
namespace mark_shader {
using namespace glm;
#include "shaders/lib/map_place.glsl"
}  // namespace mark_shader
}  // namespace

namespace globe::effects {
namespace {

using glm::dvec3;

double folded_deg(double lon_deg) { return std::remainder(lon_deg, 360.0); }

TEST(MapPlace, IsOffByLessThanAMillionthOfTheDistance) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double worst = 0.0;
  for (int k = 0; k < 20'000; ++k) {
    const geo::Ellipsoid& ellipsoid = k % 3 == 0 ? geo::kMars : k % 3 == 1 ? geo::kMoon : geo::kWgs84;
    // Eyes from 1 m to 40,000 km, ground from 1 m away to the horizon and over the pole.
    const geo::Geodetic eye{k % 7 == 0 ? 89.9999 : 180.0 * unit(random) - 90.0, 360.0 * unit(random) - 180.0,
                            std::pow(10.0, 7.6 * unit(random)), false};
    const dvec3 eye_at = geo::ecef_from_geodetic(ellipsoid, eye);
    const geo::LocalFrame frame = geo::local_frame(eye.lat_deg, eye.lon_deg);
    const double seen = std::acos(ellipsoid.b() / (ellipsoid.a + eye.h_m));
    const double away = seen * std::pow(10.0, -6.0 * unit(random)), heading = 360.0 * unit(random);
    const dvec3 u =
        glm::normalize(frame.up * std::cos(away) + geo::look_direction(frame, heading, 0.0) * std::sin(away));
    const geo::Geodetic at = geo::geodetic_from_ecef(
        ellipsoid, geo::ecef_from_normal(ellipsoid, u, 9000.0 * (unit(random) - 0.5)));
    const glm::vec3 relative(geo::ecef_from_geodetic(ellipsoid, at) - eye_at);
    const MapEye block = map_eye(ellipsoid, eye);
    const mark_shader::MapPlace place = mark_shader::map_place({block.axes, block.lengths}, relative);
    // What single precision makes of the place itself is no fault of the function.
    const geo::Geodetic exact = geo::geodetic_from_ecef(ellipsoid, eye_at + dvec3(relative));
    const double north = exact.lat_deg - eye.lat_deg - static_cast<double>(place.offset.y) * kRadian;
    const double east =
        folded_deg(exact.lon_deg - eye.lon_deg - static_cast<double>(place.offset.x) * kRadian);
    const double off_m = std::hypot(north, east * std::cos(exact.lat_deg * kDegree)) * kDegree * ellipsoid.a;
    worst = std::max(worst, off_m / glm::length(dvec3(relative)));
  }
  // A pixel of a usual picture is 8e-4 of the distance.
  EXPECT_LT(worst, 2e-6);
}

TEST(Graticule, StepsDivideAQuarterAndChangeWithoutAJump) {
  GraticuleSteps before{};
  for (double above = 5e7; above > 1.0; above *= 0.99) {
    const auto camera =
        render::make_camera(geo::kWgs84, {30.0, 20.0, above + 500.0, false}, 0.0, -45.0, 60.0, 1.6);
    const GraticuleSteps steps = steps_in_view(geo::kWgs84, camera, 500.0);
    EXPECT_TRUE(divides_quarter(steps.step_arcsec / 3600.0)) << steps.step_arcsec;
    EXPECT_EQ(std::fmod(std::round(steps.step_arcsec * 1000.0), std::round(steps.finer_arcsec * 1000.0)),
              0.0);
    if (before.step_arcsec > steps.step_arcsec) {
      EXPECT_EQ(before.finer_arcsec, steps.step_arcsec);
      EXPECT_GT(before.finer_share, 0.9);
      EXPECT_LT(steps.finer_share, 0.1);
    } else if (before.step_arcsec > 0.0) {
      EXPECT_NEAR(steps.finer_share, before.finer_share, 0.1);
    }
    before = steps;
  }
  EXPECT_LT(before.step_arcsec, 1.0);
  EXPECT_FALSE(divides_quarter(7.0));
  EXPECT_TRUE(divides_quarter(1.0 / 60.0));
  EXPECT_EQ(fixed_steps(1.0 / 3.0).step_arcsec, 1200.0);
}

TEST(Graticule, LinesAreNamedAsPeopleWriteThem) {
  EXPECT_EQ(latitude_text(45.0 * 3600, 5.0 * 3600), "45°N");
  EXPECT_EQ(latitude_text(0.0, 3600), "0°");
  EXPECT_EQ(longitude_text(-(7.5 * 3600), 1800), "7°30′W");
  EXPECT_EQ(longitude_text(-190.0 * 3600, 3600 * 10), "170°E");
  EXPECT_EQ(longitude_text(540.0 * 3600, 3600 * 10), "180°");
  EXPECT_EQ(latitude_text(-(12 * 3600 + 6 * 60 + 4.5), 0.5), "12°06′04.5″S");
  EXPECT_EQ(latitude_text(59.96 * 60, 60), "1°00′N");
}

/// Rings around a place that wiggle, and a hole.
std::vector<ShapeCells::Rings> wiggly(std::mt19937_64& random, int polygons, int corners) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<ShapeCells::Rings> made;
  for (int p = 0; p < polygons; ++p) {
    const double lat = 100.0 * unit(random) - 50.0, lon = 360.0 * unit(random) - 180.0,
                 r = 5.0 + 30.0 * unit(random);
    ShapeCells::Rings rings(2);
    for (int k = 0; k < corners; ++k) {
      const double angle = 2.0 * M_PI * k / corners * (p % 2 == 0 ? 1.0 : -1.0);
      const double out = r * (0.8 + 0.2 * unit(random)), in = 0.3 * r;
      rings[0].push_back({lat + out * std::sin(angle), lon + out * std::cos(angle)});
      if (k % 4 == 0) rings[1].push_back({lat + in * std::sin(angle), lon + in * std::cos(angle)});
    }
    made.push_back(std::move(rings));
  }
  return made;
}

TEST(ShapeCells, HoldWhatThePolygonsOfAMapHold) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (const auto& [polygons, corners] : {std::pair(1, 12), std::pair(6, 40), std::pair(3, 800)}) {
    const std::vector<ShapeCells::Rings> rings = wiggly(random, polygons, corners);
    const ShapeCells cells(rings);
    std::vector<region::MapPolygon::Rings> map;
    for (const ShapeCells::Rings& polygon : rings) {
      region::MapPolygon::Rings& to = map.emplace_back();
      for (const ShapeCells::Ring& ring : polygon) {
        to.emplace_back();
        for (const MapCorner& c : ring) to.back().push_back({c.lat_deg, c.lon_deg});
      }
    }
    const region::MapPolygon reference(map);
    int inside = 0;
    for (int k = 0; k < 5000; ++k) {
      const double lat = 180.0 * unit(random) - 90.0, lon = 720.0 * unit(random) - 360.0;
      const bool expected = reference.contains(geo::normal_from_degrees(lat, lon));
      ASSERT_EQ(cells.contains(lat, lon), expected) << lat << ' ' << lon;
      inside += expected ? 1 : 0;
    }
    EXPECT_GT(inside, 50);
  }
}

TEST(ShapeCells, ReachPolesAndCrossTheAntimeridian) {
  const std::vector<ShapeCells::Rings> antarctica{
      {{{-90, -180}, {-90, 180}, {-65, 180}, {-75, 90}, {-60, 0}, {-70, -90}, {-65, -180}}}};
  const ShapeCells south(antarctica);
  for (double lon = -180.0; lon <= 180.0; lon += 7.5) {
    EXPECT_TRUE(south.contains(-90.0, lon));
    EXPECT_TRUE(south.contains(-80.0, lon));
    EXPECT_FALSE(south.contains(-55.0, lon));
  }
  const std::vector<ShapeCells::Rings> across{{{{-10, 170}, {-10, 190}, {10, 190}, {10, 170}}}};
  const ShapeCells box(across);
  for (const double lon : {170.1, 179.9999, -180.0, 180.0, -179.9999, -170.1, 530.5}) {
    EXPECT_TRUE(box.contains(0.0, lon)) << lon;
    EXPECT_FALSE(box.contains(11.0, lon));
  }
  EXPECT_FALSE(box.contains(0.0, 169.9));
  EXPECT_FALSE(box.contains(0.0, -169.9));
}

/// A view for lines, the camera looking down.
struct DownView {
  DownView(double lat, double lon, double above, double tolerance_px)
      : camera(render::make_camera(geo::kWgs84, {lat, lon, above, false}, 0.0, -90.0, 60.0, 1.0)),
        frustum(camera.forward, camera.right, camera.up, camera.tan_x(), camera.tan_y()),
        horizon(geo::kWgs84, -1.0, camera.position),
        view{geo::kWgs84,
             camera.position,
             frustum,
             horizon,
             2.0 * camera.tan_y() / 720.0,
             tolerance_px,
             0.0,
             above,
             -1.0,
             1.0,
             [](const dvec3&, double, double) { return glm::dvec2(-1.0, 1.0); }} {}
  DownView(const DownView&) = delete;
  DownView& operator=(const DownView&) = delete;

  render::Camera camera;
  clipmap::Frustum frustum;
  clipmap::Horizon horizon;
  LineView view;
};

/// Farthest that arcs are off places of a line that a view sees, pixels; and places that no arc comes near.
double farthest_off(const std::vector<Arc>& arcs, const DownView& down,
                    const std::vector<MapCorner>& corners) {
  double worst = 0.0;
  const std::size_t every = std::max<std::size_t>(corners.size() / 100, 1);
  const int steps = corners.size() > 100 ? 3 : 400;
  for (std::size_t k = 0; k + 1 < corners.size(); k += every) {
    for (int step = 0; step <= steps; ++step) {
      const double t = static_cast<double>(step) / steps;
      const dvec3 u =
          geo::normal_from_degrees(corners[k].lat_deg + t * (corners[k + 1].lat_deg - corners[k].lat_deg),
                                   corners[k].lon_deg + t * (corners[k + 1].lon_deg - corners[k].lon_deg));
      const dvec3 at = geo::surface_point(geo::kWgs84, u) - down.camera.position;
      if (!down.frustum.sees(at, 0.0) || !down.horizon.sees(at + down.camera.position, 0.0, 0.0)) continue;
      double least = 1e30;
      for (const Arc& arc : arcs) {
        const double along = glm::dot(dvec3(arc.along), at) - static_cast<double>(arc.along.w);
        const double across = glm::dot(dvec3(arc.across), at) - static_cast<double>(arc.across.w);
        const double beyond = along - std::clamp(along, 0.0, static_cast<double>(arc.up_b.w));
        least = std::min(least, std::hypot(beyond, across));
      }
      worst = std::max(worst, least / (glm::length(at) * down.view.pixel));
    }
  }
  return worst;
}

TEST(ShapeLines, ArcsStayWithinTheirToleranceFromOrbitToTheGround) {
  const std::vector<MapCorner> parallel{{60.0, -120.0}, {60.0, 120.0}},
      slanting{{-40.0, 10.0}, {62.0, 170.0}};
  std::vector<MapCorner> coast;
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 4000; ++k)
    coast.push_back({40.0 + 0.01 * unit(random) + 5.0 * std::sin(k * 0.002), 20.0 + k * 0.005});
  for (const std::vector<MapCorner>* line :
       std::initializer_list<const std::vector<MapCorner>*>{&parallel, &slanting, &coast}) {
    const MapCorner &a = (*line)[line->size() / 2 - 1], &b = (*line)[line->size() / 2];
    const double lat = 0.5 * (a.lat_deg + b.lat_deg), lon = 0.5 * (a.lon_deg + b.lon_deg);
    for (const double above : {2.0, 100.0, 1e4, 1e6, 2e7}) {
      for (const double tolerance : {0.25, 2.0}) {
        const DownView down(lat, lon, above, tolerance);
        std::vector<Arc> arcs;
        ShapeLine(geo::kWgs84, *line, 1.0f).add_arcs(down.view, arcs);
        ASSERT_FALSE(arcs.empty());
        EXPECT_LT(farthest_off(arcs, down, *line), tolerance) << above;
        // What is finer than a pixel is not drawn corner by corner.
        EXPECT_LT(arcs.size(), 3000u) << above;
      }
    }
  }
}

TEST(ShapeLines, WhatIsOutOfViewIsNotCut) {
  const ShapeLine line(geo::kWgs84, {{10.0, 10.0}, {10.5, 10.5}}, 1.0f);
  for (const auto& [lat, lon] : {std::pair(-10.0, -170.0), std::pair(11.5, 10.0), std::pair(80.0, 10.0)}) {
    const DownView down(lat, lon, 1e4, 0.25);
    std::vector<Arc> arcs;
    line.add_arcs(down.view, arcs);
    EXPECT_TRUE(arcs.empty());
    EXPECT_FALSE(line.may_be_seen(down.view));
  }
}

TEST(LabelLayout, WhatMattersMoreStandsAndNoTwoShownOverlap) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<LabelBox> boxes;
  for (int k = 0; k < 400; ++k) {
    const glm::dvec2 low(1000.0 * unit(random), 600.0 * unit(random));
    boxes.push_back(
        {low, low + glm::dvec2(60.0 + 60.0 * unit(random), 18.0), k % 5 == 0 ? unit(random) : 1.0});
  }
  const std::vector<double> shares = label_shares(boxes);
  EXPECT_EQ(shares[1], 1.0);
  int shown = 0;
  for (std::size_t a = 0; a < boxes.size(); ++a) {
    shown += shares[a] > 0.0 ? 1 : 0;
    for (std::size_t b = 0; b < a; ++b) {
      if (shares[a] <= 0.0 || shares[b] <= 0.0) continue;
      const glm::dvec2 apart = glm::max(boxes[a].low - boxes[b].high, boxes[b].low - boxes[a].high);
      EXPECT_GE(std::max(apart.x, apart.y), 0.0) << a << ' ' << b;
    }
  }
  EXPECT_GT(shown, 30);
}

TEST(LabelLayout, AsTheViewMovesNothingPops) {
  // One label drifts past others; all shares change little by little.
  std::vector<double> before;
  for (double x = 0.0; x < 500.0; x += 0.25) {
    const std::vector<LabelBox> boxes{{{x, 100.0}, {x + 80.0, 118.0}, 1.0},
                                      {{200.0, 105.0}, {260.0, 123.0}, 1.0},
                                      {{270.0, 100.0}, {350.0, 118.0}, 1.0},
                                      {{340.0, 110.0}, {420.0, 128.0}, 1.0}};
    const std::vector<double> shares = label_shares(boxes);
    for (std::size_t k = 0; k < before.size(); ++k) EXPECT_NEAR(shares[k], before[k], 0.5) << x << ' ' << k;
    before = shares;
  }
}

TEST(LabelFont, WritesAnyScriptItHasAndNeverFails) {
  const LabelFont font(kUsualFont, 15.0, 1.8);
  EXPECT_GT(font.size_of("Mont Blanc").x, font.size_of("Mont").x);
  const auto ink = [&](const std::string& text) {
    std::size_t sum = 0;
    const TextPicture picture = font.draw(text);
    for (std::size_t k = 0; k < picture.texels.size(); k += 2) {
      sum += picture.texels[k];
      EXPECT_GE(picture.texels[k + 1], picture.texels[k]);  // the halo lies under the letters too
    }
    return sum;
  };
  EXPECT_GT(ink("°′″"), 0u);
  EXPECT_NE(ink("45°N"), ink("450N"));
  EXPECT_GT(ink("Çığ Ельбрус"), 1000u);
  EXPECT_EQ(font.size_of("\xff\xfe").x, font.size_of("??").x);
  EXPECT_EQ(ink(""), 0u);
  EXPECT_THROW(LabelFont("/dev/null", 15.0, 1.0), Error);
}

TEST(NamedPlaces, AreTakenFromWhatFilesUsuallyHave) {
  const tests::TemporaryFolder folder;
  const std::filesystem::path file = folder / "names.geojson";
  std::ofstream(file) << R"({"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{"name":"Low","rank":1},"geometry":{"type":"Point","coordinates":[1,2]}},
    {"type":"Feature","properties":{"NAME":"High\nland","rank":9},"geometry":{"type":"Polygon","coordinates":
      [[[0,0],[10,0],[10,10],[9,10],[9,1],[0,1],[0,0]]]}},
    {"type":"Feature","properties":{"rank":5},"geometry":{"type":"Point","coordinates":[1,2]}},
    {"type":"Feature","properties":{"label":7,"rank":4},"geometry":{"type":"LineString","coordinates":[[0,0],[8,0]]}},
    {"type":"Feature","properties":{"name":"Nowhere"},"geometry":null}]})";
  const std::vector<NamedPlace> places = read_named_places(file, "", "rank");
  ASSERT_EQ(places.size(), 3u);
  EXPECT_EQ(places[0].name, "High land");
  EXPECT_EQ(places[1].name, "7");
  EXPECT_NEAR(places[1].lon_deg, 4.0, 1e-9);
  EXPECT_EQ(places[2].name, "Low");
  // Within the angle, where its centre is not.
  const std::vector<ShapeCells::Rings> angle{{{{0, 0}, {0, 10}, {10, 10}, {10, 9}, {1, 9}, {1, 0}}}};
  EXPECT_TRUE(ShapeCells(angle).contains(places[0].lat_deg, places[0].lon_deg));
  EXPECT_TRUE(read_named_places(file, "rank", "").size() == 4u);
}

}  // namespace
}  // namespace globe::effects
