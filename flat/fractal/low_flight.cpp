#include "flat/fractal/low_flight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <glm/geometric.hpp>

#include "globe/base/angles.h"

namespace globe::flat::fractal {
namespace {

constexpr double kReach = 2.0;          // how far ahead and behind ground counts, clearances
constexpr std::size_t kMost = 200'000;  // places looked at

/// The largest of every `reach` values on either side.
std::vector<double> highest_within(const std::vector<double>& values, std::size_t reach) {
  std::vector<double> result;
  std::deque<std::size_t> falling;  // places whose values are larger than all after them
  for (std::size_t k = 0; k < values.size() + reach; ++k) {
    if (k < values.size()) {
      while (!falling.empty() && values[falling.back()] <= values[k]) falling.pop_back();
      falling.push_back(k);
    }
    if (k < reach) continue;
    while (falling.front() + 2 * reach < k) falling.pop_front();
    result.push_back(values[falling.front()]);
  }
  return result;
}

/// Their mean.
std::vector<double> mean_within(const std::vector<double>& values, std::size_t reach) {
  std::vector<double> sums{0.0};
  for (const double value : values) sums.push_back(sums.back() + value);
  std::vector<double> result;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const std::size_t first = k < reach ? 0 : k - reach;
    const std::size_t last = std::min(values.size(), k + reach + 1);
    result.push_back((sums[last] - sums[first]) / static_cast<double>(last - first));
  }
  return result;
}

}  // namespace

LowFlight::LowFlight(const Ground& ground, const Course& course) : clearance_m_(course.clearance_m) {
  const double spacing = ground.settings().spacing_m();
  const double heading = course.heading_deg * kDegree;
  from_posts_ = course.from_m / spacing;
  along_posts_ = glm::dvec2(std::sin(heading), std::cos(heading)) * (course.length_m / spacing);
  const double step_m = std::max(spacing, course.length_m / double(kMost));
  const auto count = static_cast<std::size_t>(std::ceil(course.length_m / step_m)) + 2;
  Ground::Workspace workspace;
  std::vector<double> heights;
  for (std::size_t k = 0; k < count; ++k) {
    const glm::dvec2 place =
        glm::floor(from_posts_ + along_posts_ * (static_cast<double>(k) / static_cast<double>(count - 1)));
    std::array<float, 16> around{};  // the cells about the place and about all that is nearer than a step
    ground.heights(ground.settings().iterations,
                   {static_cast<std::int64_t>(place.x) - 1, static_cast<std::int64_t>(place.y) - 1, 4, 4, 1},
                   around, workspace);
    heights.push_back(static_cast<double>(*std::max_element(around.begin(), around.end())));
  }
  // The mean of what is never below the ground within reach is never below it either.
  const auto reach =
      static_cast<std::size_t>(std::min(kReach * course.clearance_m / step_m, static_cast<double>(count)));
  floor_m_ = mean_within(highest_within(heights, reach), reach);
}

glm::dvec3 LowFlight::at(double t) const {
  const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(floor_m_.size() - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(place), floor_m_.size() - 2);
  const double floor = std::lerp(floor_m_[k], floor_m_[k + 1], place - static_cast<double>(k));
  return {from_posts_ + along_posts_ * t, floor + clearance_m_};
}

render::Camera flat_camera(double heading_deg, double pitch_deg, double fov_y_deg, double aspect) {
  const double heading = heading_deg * kDegree, pitch = pitch_deg * kDegree;
  render::Camera camera;
  camera.forward = {std::cos(pitch) * std::sin(heading), std::cos(pitch) * std::cos(heading),
                    std::sin(pitch)};
  camera.right = {std::cos(heading), -std::sin(heading), 0.0};
  camera.up = glm::cross(camera.right, camera.forward);
  camera.fov_y_deg = fov_y_deg;
  camera.aspect = aspect;
  return camera;
}

}  // namespace globe::flat::fractal
