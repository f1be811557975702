// How a frame's triangles and texels are best handed to the driver: globe_submission_bench [ROUNDS [DEVICE]].
// Draws, index orders and uploads, each in every way, one after the other in every round; medians with their
// 95 % intervals, until the calls return and until the picture is done.

#include <epoxy/gl.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "app/bench.h"
#include "app/flight_stats.h"
#include "globe/gl/context.h"
#include "tests/bench/submission/draw_ways.h"
#include "tests/bench/submission/index_orders.h"
#include "tests/bench/submission/upload_ways.h"

namespace {

using bench::DrawWay;
using bench::GroundScene;

struct Times {
  std::vector<double> issued, done;  ///< milliseconds from the start
};

double now_ms() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

std::string with_interval(const std::vector<double>& values) {
  const app::Interval interval = app::median_interval(values);
  char text[96];
  std::snprintf(text, sizeof text, "%.3f (%.3f-%.3f)", app::percentile(values, 50), interval.low,
                interval.high);
  return text;
}

/// Median of one over another, round by round.
double ratio(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (std::size_t k = 0; k < a.size(); ++k) ratios.push_back(a[k] / b[k]);
  return app::percentile(ratios, 50);
}

void print_table(const std::string& title, const std::vector<std::string>& names,
                 const std::vector<Times>& times) {
  std::printf("\n%s\n\n| way | calls, ms | done, ms | against the first |\n| --- | --- | --- | --- |\n",
              title.c_str());
  for (std::size_t k = 0; k < names.size(); ++k) {
    std::printf("| %s | %s | %s | %.2f |\n", names[k].c_str(), with_interval(times[k].issued).c_str(),
                with_interval(times[k].done).c_str(), ratio(times[k].done, times[0].done));
  }
  std::fflush(stdout);
}

void compare_draws(const std::string& title, const GroundScene& scene, const std::vector<DrawWay>& ways,
                   int rounds) {
  std::vector<Times> times(ways.size());
  std::vector<std::string> names;
  std::vector<std::uint8_t> expected;
  for (const DrawWay& way : ways) {
    names.push_back(way.name);
    scene.begin_frame();
    way.issue();
    const auto picture = scene.target.read_rgba8();
    if (expected.empty()) expected = picture;
    if (picture != expected) throw std::runtime_error(way.name + " draws another picture");
  }
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < ways.size(); ++k) {
      scene.begin_frame();
      glFinish();
      const double begin = now_ms();
      ways[k].issue();
      times[k].issued.push_back(now_ms() - begin);
      glFinish();
      times[k].done.push_back(now_ms() - begin);
    }
  }
  std::size_t draws = scene.list.batches.size();
  print_table(
      title + ", " + std::to_string(scene.list.patches) + " patches in " + std::to_string(draws) + " batches",
      names, times);
}

void compare_orders(const std::string& title, const GroundScene& scene, int rounds) {
  std::vector<DrawWay> ways;
  for (const bench::IndexOrder& order : bench::index_orders()) {
    const auto mesh = order.reorder(scene.mesh);
    char name[128];
    std::snprintf(name, sizeof name, "%s: %.2f, %.2f vertices a triangle with a cache of 16, 32",
                  order.name.c_str(), bench::cache_misses(mesh.indices[0], 16),
                  bench::cache_misses(mesh.indices[0], 32));
    ways.push_back(bench::instanced(name, scene, mesh));
  }
  compare_draws(title, scene, ways, rounds);
}

/// Into textures that the frame before, of the scene, has done with; a frame is drawn after each.
void compare_uploads(const std::string& title, const GroundScene& scene,
                     const std::shared_ptr<const globe::clipmap::LevelUpdate>& update, int rounds) {
  const auto ways = bench::upload_ways(scene.settings, update);
  const DrawWay draw = bench::instanced("", scene, scene.mesh);
  std::vector<Times> times(ways.size());
  std::vector<std::string> names;
  for (const bench::UploadWay& way : ways) {
    names.push_back(way.name);
    way.upload();
    if (way.read() != ways.front().read()) throw std::runtime_error(way.name + " uploads something else");
  }
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t k = 0; k < ways.size(); ++k) {
      scene.begin_frame();
      glFinish();
      const double begin = now_ms();
      ways[k].upload();
      times[k].issued.push_back(now_ms() - begin);
      draw.issue();
      glFinish();
      times[k].done.push_back(now_ms() - begin);
    }
  }
  char kib[32];
  std::snprintf(kib, sizeof kib, "%.0f KiB", static_cast<double>(update->upload_bytes()) / 1024.0);
  print_table(title + ", " + kib + ", and a frame after it", names, times);
}

void compare_all_uploads(const GroundScene& scene, int rounds) {
  namespace clipmap = globe::clipmap;
  const auto& held = scene.state->levels.back();
  const auto level = [&](clipmap::Region region, const clipmap::LevelData* before) {
    return std::make_shared<const clipmap::LevelUpdate>(
        clipmap::update_level(scene.settings, *scene.surface, std::move(region), held->lighting, before));
  };
  compare_uploads("A level from nothing", scene, level(held->region, nullptr), rounds);
  // A step of the window's centre.
  clipmap::GridPoint point = clipmap::grid_point(held->region.centre);
  point.at.i += scene.settings.unit() * clipmap::kSubcell;
  compare_uploads("A level's strip", scene, level(clipmap::make_region(scene.settings, point), held.get()),
                  rounds);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 100;
    const globe::gl::Context context(argc > 2 ? argv[2] : "auto");
    std::printf("%s, OpenGL %s, 1280x720, %d rounds\n", context.renderer().c_str(), context.version().c_str(),
                rounds);
    for (const int detail : {64, 128}) {
      const GroundScene ground(detail, 200.0, 0.0);
      const std::string of = "detail " + std::to_string(detail);
      compare_draws("Draws, 200 m above ground, " + of, ground, bench::draw_ways(ground), rounds);
      compare_orders("Index orders, 200 m above ground, " + of, ground, rounds);
      compare_all_uploads(ground, rounds);
    }
    for (const std::string& error : context.errors()) std::fprintf(stderr, "OpenGL: %s\n", error.c_str());
    return context.errors().empty() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "globe_submission_bench: %s\n", error.what());
    return 1;
  }
}
