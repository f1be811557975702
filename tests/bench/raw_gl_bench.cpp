#include <benchmark/benchmark.h>

#include "app/raw_gl.h"
#include "globe/gl/context.h"

namespace {

/// Arguments: triangles on the screen, triangles off it, in thousands.
void fly_raw_gl(benchmark::State& state) {
  const globe::gl::Context context;
  app::RawGl draw({.triangles_on_screen = 1000 * static_cast<int>(state.range(0)),
                   .triangles_off_screen = 1000 * static_cast<int>(state.range(1))});
  draw();
  for (auto _ : state) draw();
  state.counters["triangles"] = draw.triangles_on_screen() + draw.triangles_off_screen();
  state.SetLabel(context.renderer());
}

BENCHMARK(fly_raw_gl)
    ->Name("fly.raw_gl")
    ->Args({35, 0})
    ->Args({70, 0})
    ->Args({70, 100})
    ->Args({200, 0})
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

}  // namespace
