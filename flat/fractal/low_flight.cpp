#include "flat/fractal/low_flight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace globe::flat::fractal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kReach = 0.5;          // how far ahead ground counts, clearances
constexpr int kSteps = 4;               // to a reach
constexpr std::size_t kMost = 100'000;  // places looked at

/// Of every `reach` values on either side, the largest, or their mean.
template <class Fold>
std::vector<double> folded(const std::vector<double>& values, int reach, const Fold& fold) {
  std::vector<double> result;
  const auto count = static_cast<int>(values.size());
  for (int k = 0; k < count; ++k) {
    const auto first = values.begin() + std::max(0, k - reach);
    const auto last = values.begin() + std::min(count, k + reach + 1);
    result.push_back(fold(first, last));
  }
  return result;
}

}  // namespace

LowFlight::LowFlight(const Ground& ground, const Course& course) : clearance_m_(course.clearance_m) {
  const double spacing = ground.settings().spacing_m();
  const double heading = course.heading_deg * kDegree;
  from_posts_ = course.from_m / spacing;
  along_posts_ = glm::dvec2(std::sin(heading), std::cos(heading)) * (course.length_m / spacing);
  const double step_m = std::max(course.clearance_m * kReach / kSteps, course.length_m / double(kMost));
  const auto count = static_cast<std::size_t>(std::ceil(course.length_m / step_m)) + 2;
  Ground::Workspace workspace;
  std::vector<double> heights;
  for (std::size_t k = 0; k < count; ++k) {
    const glm::dvec2 place =
        glm::floor(from_posts_ + along_posts_ * (static_cast<double>(k) / static_cast<double>(count - 1)));
    std::array<float, 4> around{};
    ground.heights(ground.settings().iterations,
                   {static_cast<std::int64_t>(place.x), static_cast<std::int64_t>(place.y), 2, 2, 1}, around,
                   workspace);
    heights.push_back(static_cast<double>(*std::max_element(around.begin(), around.end())));
  }
  // The mean of what is never below the ground within reach is never below it either.
  const auto highest = folded(heights, 4 * kSteps, [](auto a, auto b) { return *std::max_element(a, b); });
  floor_m_ = folded(highest, 4 * kSteps, [](auto a, auto b) {
    double sum = 0;
    for (auto at = a; at != b; ++at) sum += *at;
    return sum / static_cast<double>(b - a);
  });
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
