// Marks on the ground against where they have to be, by the places that picking the drawn surface tells.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

#include "globe/effects/list.h"
#include "globe/effects/shape_cells.h"
#include "tests/render/ground/depth_picture.h"
#include "tests/temporary_folder.h"

namespace {

using globe::geo::Geodetic;
using views::Camera;
using views::GlobeRenderer;

constexpr int kWide = 320, kHigh = 180;

/// Pictures with and without marks, from the same camera.
class Marked : public GlTest {
 protected:
  struct Pair {
    std::vector<std::uint8_t> with, without;
    std::vector<float> depth;

    /// How much darker or lighter a pixel became.
    int change(int x, int y) const {
      int sum = 0;
      for (int c = 0; c < 3; ++c) {
        const auto k = static_cast<std::size_t>(4 * (y * kWide + x) + c);
        sum = std::max(sum, std::abs(int{with[k]} - int{without[k]}));
      }
      return sum;
    }
  };

  static GlobeRenderer renderer(const std::string& scene) {
    globe::render::RenderSettings settings;
    settings.clipmap = globe::clipmap::Settings::for_detail(32);
    return {views::builtin_planet(), settings,
            globe::effects::make_effects(
                globe::scene::parse_scene(scene, "s.toml", globe::effects::effect_kinds()),
                *views::builtin_planet())};
  }

  Pair pair(const std::string& scene, const views::Place& place, double above_m, double heading_deg,
            double pitch_deg) {
    const globe::gl::Framebuffer frame(kWide, kHigh);
    GlobeRenderer marked = renderer(scene), bare = renderer("");
    camera_ = views::camera_above(bare, *views::builtin_planet(), place, above_m, heading_deg, pitch_deg);
    near_m_ = globe::render::near_distance(globe::geo::kWgs84, bare.nearest_drawn(camera_.position));
    const glm::dvec3 sun = glm::normalize(camera_.position);
    Pair made;
    marked.draw(camera_, sun, true, frame);
    made.with = frame.read_rgba8();
    bare.draw(camera_, sun, true, frame);
    made.without = frame.read_rgba8();
    made.depth = frame.read_depth();
    return made;
  }

  /// Where the middle of a pixel shows the ground, by its depth; nothing for the sky.
  std::optional<Geodetic> ground(const Pair& pictures, double x, double y) const {
    const float depth =
        pictures.depth[static_cast<std::size_t>(static_cast<int>(y) * kWide + static_cast<int>(x))];
    if (depth <= 0.0f) return std::nullopt;
    const glm::dvec3 ray = globe::render::direction_through(camera_, x / kWide, y / kHigh);
    const double away = near_m_ / static_cast<double>(depth) / glm::dot(ray, camera_.forward);
    return globe::geo::geodetic_from_ecef(globe::geo::kWgs84, camera_.position + ray * away);
  }

  std::string write(const std::string& text) const {
    std::ofstream(folder_ / "shapes.geojson") << text;
    return "[effects.shapes]\nfile = \"" + (folder_ / "shapes.geojson").string() +
           "\"\nwidth = 0\npoints = 0\nfill = 0.8\n";
  }
  std::string write_line(const std::string& text) const {
    std::ofstream(folder_ / "lines.geojson") << text;
    return "[effects.shapes]\nfile = \"" + (folder_ / "lines.geojson").string() +
           "\"\nwidth = 1.5\nhalo = 0\ncolor = \"ff00ff\"\n";
  }

  /// Rows of a column in which a picture of a line changes the most, and where the line's latitude lies.
  void expect_parallel(const Pair& pictures, double lat_deg, int columns) const {
    int seen = 0;
    for (int x = 4; x < kWide; x += kWide / columns) {
      int row = -1, most = 40;
      for (int y = 0; y < kHigh; ++y) {
        if (pictures.change(x, y) > most) {
          most = pictures.change(x, y);
          row = y;
        }
      }
      if (row < 1 || row + 1 >= kHigh) continue;
      ++seen;
      const auto above = ground(pictures, x + 0.5, row - 0.5), below = ground(pictures, x + 0.5, row + 1.5);
      if (!above || !below) continue;
      // The line lies between the places a pixel above and below.
      EXPECT_LE((above->lat_deg - lat_deg) * (below->lat_deg - lat_deg), 0.0) << x << ' ' << row;
    }
    EXPECT_GT(seen, columns / 3);
  }

  tests::TemporaryFolder folder_;
  Camera camera_;
  double near_m_ = 0;
};

TEST_F(Marked, AParallelLiesOnItsPixelsFromOrbitAndOverRoughGround) {
  for (const auto& [lat, above, pitch] : {std::tuple(20.0, 8e6, -90.0), std::tuple(-43.4165, 150.0, -30.0)}) {
    const std::string at = std::to_string(lat);
    const views::Place eye{"near it", lat - (above < 1e5 ? 0.0025 : 3.0), -106.43};
    const Pair line =
        pair(write_line(R"({"type":"LineString","coordinates":[[-150,)" + at + "],[-60," + at + "]]}"), eye,
             above, 0.0, pitch);
    expect_parallel(line, lat, 40);
  }
}

TEST_F(Marked, AGraticulesParallelsLieOnTheirPixels) {
  const Pair orbit = pair("[effects.graticule]\nstep = 90\ncolor = \"ff00ff\"\nopacity = 1\n",
                          {"near the equator", 4.0, -45.0}, 2e6, 0.0, -90.0);
  expect_parallel(orbit, 0.0, 40);
}

TEST_F(Marked, WhatIsFilledIsWhatLiesInsideByItsPickedPlace) {
  const std::vector<std::pair<std::string, std::vector<globe::effects::ShapeCells::Rings>>> polygons{
      {R"([[[-106.44,-43.41],[-106.42,-43.412],[-106.425,-43.425],[-106.45,-43.42],[-106.44,-43.41]],)"
       R"([[-106.437,-43.415],[-106.433,-43.415],[-106.433,-43.417],[-106.437,-43.415]]])",
       {{{{-43.41, -106.44}, {-43.412, -106.42}, {-43.425, -106.425}, {-43.42, -106.45}},
         {{-43.415, -106.437}, {-43.415, -106.433}, {-43.417, -106.433}}}}},
      {R"([[[160,-20],[200,-20],[200,30],[160,20],[160,-20]]])",
       {{{{-20, 160}, {-20, 200}, {30, 200}, {20, 160}}}}},
      {R"([[[-180,-90],[180,-90],[180,-70],[0,-60],[-180,-70],[-180,-90]]])",
       {{{{-90, -180}, {-90, 180}, {-70, 180}, {-60, 0}, {-70, -180}}}}}};
  const struct {
    std::size_t polygon;
    views::Place place;
    double above_m, pitch_deg;
  } kViews[] = {{0, {"low", -43.425, -106.43}, 200.0, -15.0},
                {0, {"lower", -43.4135, -106.4345}, 3.0, -60.0},
                {1, {"over the antimeridian", 0.0, 179.0}, 8e6, -90.0},
                {2, {"over the pole", -88.0, 30.0}, 8e6, -90.0}};
  for (const auto& view : kViews) {
    const globe::effects::ShapeCells inside(polygons[view.polygon].second);
    const Pair filled =
        pair(write(R"({"type":"Polygon","coordinates":)" + polygons[view.polygon].first + "}"), view.place,
             view.above_m, 0.0, view.pitch_deg);
    int held = 0, wrong = 0, border = 0;
    for (int y = 1; y + 1 < kHigh; ++y) {
      for (int x = 1; x + 1 < kWide; ++x) {
        bool all = true, any = false, sky = false;
        for (const auto& [dx, dy] :
             {std::pair(0, 0), std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
          const auto at = ground(filled, x + dx + 0.5, y + dy + 0.5);
          sky = sky || !at;
          const bool in = at && inside.contains(at->lat_deg, at->lon_deg);
          all = all && in;
          any = any || in;
        }
        if (sky) continue;
        if (all != any) {
          ++border;
          continue;
        }
        held += all ? 1 : 0;
        wrong += (filled.change(x, y) > 8) != all ? 1 : 0;
      }
    }
    EXPECT_GT(held, 500) << view.place.name;
    EXPECT_EQ(wrong, 0) << view.place.name << ": of " << held << ", at the border " << border;
  }
}

TEST_F(Marked, WhatAHillHidesIsNotDrawn) {
  // A point behind the camera's horizon, and one in front.
  const Pair pictures = pair(write_line(R"({"type":"MultiPoint","coordinates":[[73.6,43.4],[-106.43,-60]]})"),
                             {"land", -43.42, -106.43}, 200.0, 180.0, -10.0);
  EXPECT_EQ(pictures.with, pictures.without);
}

}  // namespace
