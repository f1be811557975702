// Writes app/accuracy/scattering_values.cpp: the light of the looks that the atmosphere is judged by.
//   globe_scattering_reference > app/accuracy/scattering_values.cpp
// takes half an hour on two cores.

#include <tbb/parallel_for.h>

#include <cstddef>
#include <cstdio>
#include <vector>

#include "app/accuracy/scattering_cases.h"

namespace {

using namespace app::accuracy;

constexpr double kInterval = 0.01;
constexpr std::int64_t kMost = 4'000'000;

void write(const char* function, const std::vector<ScatteringCase>& cases, std::uint64_t first_seed) {
  std::vector<ScatteredLight> values(cases.size());
  tbb::parallel_for(std::size_t{0}, cases.size(), [&](std::size_t k) {
    std::fprintf(stderr, "%s\n", cases[k].name.c_str());
    values[k] = scattered_light(globe::effects::AirModel{}, cases[k].ray, kInterval, kMost, first_seed + k);
  });
  std::printf("std::vector<ScatteredLight> %s() {\n  return {\n", function);
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const ScatteredLight& v = values[k];
    std::printf("      {{%.5e, %.5e, %.5e}, {%.5e, %.5e, %.5e}, {%.1e, %.1e, %.1e}},  // %s\n", v.once.x,
                v.once.y, v.once.z, v.again.x, v.again.y, v.again.z, v.interval.x, v.interval.y, v.interval.z,
                cases[k].name.c_str());
  }
  std::printf("  };\n}\n");
}

}  // namespace

int main() {
  std::printf("%s",
              "// Written by globe_scattering_reference (tests/bench/air/scattering_reference.cpp).\n\n"
              "#include \"app/accuracy/scattering_cases.h\"\n\n"
              "namespace app::accuracy {\n\n"
              "// clang-format off\n"
              "// Light scattered once, light scattered again, half the width of the latter's 95 % "
              "confidence interval.\n");
  write("scattering_values", scattering_cases(), 1);
  std::printf("\n");
  write("drawn_scattering_values", drawn_scattering_cases(), 1001);
  std::printf("%s", "// clang-format on\n\n}  // namespace app::accuracy\n");
}
