/// Table 6.1 of Christopoulos 1999 again: triangles and frames a second on a low flight over 24 km of fractal
/// ground, 1024x768, for 7 to 10 iterations, with levels and culling and without either.
///
///   globe_fractal_table [FRAMES (200)]
///
/// Frame k of all eight is drawn before frame k + 1 of any, so that what else the machine does falls on all
/// alike.

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <vector>

#include "flat/fractal/drawer.h"
#include "flat/fractal/low_flight.h"
#include "globe/gl/context.h"

namespace {

namespace fractal = globe::flat::fractal;

constexpr int kWidth = 1024, kHeight = 768;
constexpr double kArea = 24000.0, kClearance = 300.0, kHeading = 30.0, kPitch = -8.0;

struct Theirs {
  double plain, lod_and_culling, plain_fps, lod_and_culling_fps;
};
constexpr std::array<Theirs, 4> kTheirs{
    {{32768, 3292, 24, 86}, {131072, 11816, 6, 32}, {524288, 45000, 1.7, 9.5}, {2097152, 169000, 0, 2.5}}};

struct Run {
  explicit Run(int iterations, bool lod, bool culling)
      : terrain(settings(iterations, lod, culling)),
        drawer(terrain, {.sight_m = 0.4 * kArea}),
        flight(terrain.pager().ground(),
               {.heading_deg = kHeading, .length_m = kArea, .clearance_m = kClearance}) {}

  static fractal::TerrainSettings settings(int iterations, bool lod, bool culling) {
    fractal::TerrainSettings result;
    result.ground.method = fractal::Method::kDiamondSquare;
    result.ground.iterations = iterations;
    result.ground.area_m = kArea;
    // Blocks of 9x9 posts; as many of them as an area has; rings that grow with them, as his triangles tell.
    result.pager.log2_cells = 3;
    result.pager.log2_blocks = iterations - 3;
    const double blocks = 1 << result.pager.log2_blocks;
    result.rings = {0.16 * blocks, 0.32 * blocks};
    result.lod = lod;
    result.culling = culling;
    return result;
  }

  fractal::Drawer::Stats draw(double t, const globe::gl::Framebuffer& target) {
    const globe::render::Camera camera =
        fractal::flat_camera(kHeading, kPitch, 60.0, double(kWidth) / kHeight);
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t cpu_begin = std::clock();
    const fractal::Drawer::Stats stats = drawer.draw(camera, flight.at(t), 1.0, target);
    glFinish();
    cpu_ms.push_back(1e3 * static_cast<double>(std::clock() - cpu_begin) / CLOCKS_PER_SEC);
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    triangles += static_cast<double>(stats.triangles);
    planes += static_cast<double>(stats.culling.planes);
    return stats;
  }

  fractal::Terrain terrain;
  fractal::Drawer drawer;
  fractal::LowFlight flight;
  std::vector<double> ms, cpu_ms;
  double triangles = 0, planes = 0;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

int main(int argc, char** argv) {
  const int frames = argc > 1 ? std::max(2, std::atoi(argv[1])) : 200;
  const globe::gl::Context context;
  const globe::gl::Framebuffer target(kWidth, kHeight);
  std::printf("%s, %dx%d, %d frames over %.0f km at %.0f m above ground\n\n", context.renderer().c_str(),
              kWidth, kHeight, frames, kArea / 1000, kClearance);
  std::vector<std::unique_ptr<Run>> runs;
  for (int iterations = 7; iterations <= 10; ++iterations) {
    for (int mode = 0; mode < 4; ++mode)
      runs.push_back(std::make_unique<Run>(iterations, (mode & 1) != 0, (mode & 2) != 0));
  }
  for (const auto& run : runs) run->draw(0.0, target);
  for (const auto& run : runs) {
    run->ms.clear();
    run->cpu_ms.clear();
    run->triangles = run->planes = 0;
  }
  for (int k = 0; k < frames; ++k) {
    for (const auto& run : runs) run->draw(double(k) / (frames - 1), target);
  }
  std::printf(
      "                       triangles a frame, mean     frames a second, median   processor ms, all "
      "threads\n");
  std::printf(
      "iterations  mode          ours    theirs   share        ours  theirs    gain    ours    gain  their "
      "gain\n");
  const char* const names[] = {"neither", "levels", "culling", "both"};
  for (std::size_t row = 0; row < 4; ++row) {
    const Run& plain = *runs[4 * row];
    for (std::size_t mode = 0; mode < 4; ++mode) {
      const Run& run = *runs[4 * row + mode];
      const Theirs& theirs = kTheirs[row];
      const double ms = median(run.ms), cpu_ms = median(run.cpu_ms);
      std::printf("%10zu  %-8s %9.0f ", row + 7, names[mode], run.triangles / frames);
      if (mode == 0 || mode == 3) {
        std::printf("%9.0f", mode == 0 ? theirs.plain : theirs.lod_and_culling);
      } else {
        std::printf("%9s", "");
      }
      std::printf("  %5.1f %%  %10.1f ", 100.0 * run.triangles / plain.triangles, 1000.0 / ms);
      if (mode == 0 ? theirs.plain_fps > 0 : mode == 3) {
        std::printf("%7.1f", mode == 0 ? theirs.plain_fps : theirs.lod_and_culling_fps);
      } else {
        std::printf("%7s", "");
      }
      std::printf(" %7.2f %7.1f %7.2f", median(plain.ms) / ms, cpu_ms, median(plain.cpu_ms) / cpu_ms);
      if (mode == 3 && theirs.plain_fps > 0)
        std::printf(" %11.2f", theirs.lod_and_culling_fps / theirs.plain_fps);
      std::printf("\n");
    }
  }
  std::printf("\niterations  plane tests a frame  pagings  blocks made  area cache hits  misses\n");
  for (std::size_t row = 0; row < 4; ++row) {
    const Run& run = *runs[4 * row + 3];
    const fractal::Pager::Counts counts = run.terrain.pager().counts();
    std::printf("%10zu  %19.0f  %7llu  %11llu  %15llu  %6llu\n", row + 7, run.planes / frames,
                static_cast<unsigned long long>(counts.moves), static_cast<unsigned long long>(counts.blocks),
                static_cast<unsigned long long>(counts.hits), static_cast<unsigned long long>(counts.misses));
  }
  return context.errors().empty() ? 0 : 1;
}
