#include "app/accuracy/pace.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <random>
#include <utility>

#include "app/accuracy/depth_scheme.h"

namespace app::accuracy {

Study pace_of_machine(const std::shared_ptr<globe::gl::Context>& context) {
  Study study{"pace", "The machine's own pace", "", "", "", "", "ms", {}};
  std::vector<std::uint64_t> numbers(100'000);
  std::mt19937_64 random(1);
  std::generate(numbers.begin(), numbers.end(), std::ref(random));
  const auto sort = [numbers = std::move(numbers)] {
    std::vector<std::uint64_t> sorted = numbers;
    std::sort(sorted.begin(), sorted.end());
    keep(static_cast<double>(sorted.front()));
  };
  const ErrorFigure none;
  study.settings.push_back({"100,000 numbers sorted on one core", none, timed(1.0, sort, 1e6)});
  if (!context) return study;
  const auto planes = std::make_shared<const DepthPlanes>(context, DepthScheme::kStandard24, 1280, 720);
  const auto draw = [planes] { return planes->draw_ms({1, 2, 3, 4, 5, 6, 7, 8}); };
  study.settings.push_back({"8 planes of 1280x720 pixels drawn, nearest first", none, draw});
  return study;
}

}  // namespace app::accuracy
