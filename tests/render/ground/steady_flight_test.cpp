// H17 in pictures: on a steady way down and along, no frame differs more from the one before than its
// neighbours do.

#include <algorithm>
#include <cmath>

#include "tests/hard/table.h"
#include "tests/render/ground/shader_variant.h"
#include "tests/render/ground/views.h"

namespace {

using globe::gl::Framebuffer;
using views::Camera;
using views::dvec3;
using views::GlobeRenderer;
using views::Place;

constexpr int kSteadyWidth = 320, kSteadyHeight = 180;

/// Mean difference of two pictures' channels, of 255.
double difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += std::abs(a[k] - b[k]);
  return sum / static_cast<double>(a.size());
}

constexpr double kFramesAnOctave = 96;  ///< of height

/// The largest ratio, either way, of a frame's difference from the one before to that of its neighbour, on a
/// way on which everything on the screen moves alike from frame to frame: down toward the ground, by a fixed
/// share of the height.
double worst_spike(const Place& place, std::size_t frames) {
  const auto surface = views::builtin_planet();
  globe::render::RenderSettings settings = views::geometry_settings(32);
  settings.clipmap = globe::clipmap::Settings::for_detail(32, 2);
  GlobeRenderer renderer(surface, settings);
  const Framebuffer picture(kSteadyWidth, kSteadyHeight);
  const dvec3 u = globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg);
  const double ground = surface->drawn_height(surface->height(u, 20));
  std::vector<double> differences;
  std::vector<std::uint8_t> before;
  for (std::size_t k = 0; k < frames; ++k) {
    const double above = 2e5 * std::exp2(-static_cast<double>(k) / kFramesAnOctave);
    const Camera camera = globe::render::make_camera(
        surface->ellipsoid(), {place.lat_deg, place.lon_deg, ground + above}, 30.0, -90.0, 60.0, 16.0 / 9.0);
    renderer.draw(camera, glm::normalize(u + dvec3(0.3, 0.5, -0.2)), true, picture);
    std::vector<std::uint8_t> now = picture.read_rgba8();
    if (!before.empty()) differences.push_back(difference(before, now));
    before = std::move(now);
  }
  double worst = 1.0;
  for (std::size_t k = 1; k < differences.size(); ++k) {
    const double ratio = differences[k] / differences[k - 1];
    worst = std::max({worst, ratio, 1.0 / ratio});
  }
  return worst;
}

TEST_F(GlTest, H17FramesOfASteadyFlightDifferEvenly) {
  constexpr double kMost = 1.2;
  const auto frames = static_cast<std::size_t>((hard::full() ? 8.0 : 1.25) * kFramesAnOctave);
  const Place place{"mountains", -43.42, -106.43};
  const double worst = worst_spike(place, frames);
  const views::ShaderVariant abrupt(
      "clipmap.vert", "max(morph_factor(distance, window.y, window.z), slot.offset.w)",
      "(distance > (window.y + window.z) / 2 ? 1.0 : (slot.offset.w > 0.5 ? 1.0 : 0.0))");
  const double control = worst_spike(place, frames);
  hard::report("H17",
               "difference of successive frames against the next, steady descent, " + std::to_string(frames),
               hard::figure(kMost) + " times", hard::figure(worst) + " times");
  hard::report("H17", "negative control: morph in one step", "> " + hard::figure(kMost) + " times",
               hard::figure(control) + " times");
  EXPECT_LE(worst, kMost);
  EXPECT_GT(control, kMost);
}

}  // namespace
