#include "globe/render/forecast.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace globe::render {
namespace {

constexpr double kAlike = 0.5;  ///< share of a step by which the next one may differ and still be a motion
constexpr double kFarthestTurn = 0.5;  ///< radians ahead

}  // namespace

void Forecast::note(const Place& place) {
  glm::dvec3 turn(0.0);
  double growth = 1.0;
  if (noted_ > 0) {
    const glm::dvec3 across = glm::cross(last_.u, place.u);
    const double sine = glm::length(across);
    if (sine > 0.0) turn = across * (std::atan2(sine, glm::dot(last_.u, place.u)) / sine);
    growth = place.height_m / last_.height_m;
  }
  const double rate = std::log(growth), rate_before = std::log(growth_);
  const bool known = noted_ >= 2;
  turns_ = known && glm::length(turn) > 0.0 && glm::distance(turn, turn_) <= kAlike * glm::length(turn_);
  grows_ = known && growth != 1.0 && std::abs(rate - rate_before) <= kAlike * std::abs(rate_before);
  turn_ = turn;
  growth_ = growth;
  last_ = place;
  noted_ = std::min(noted_ + 1, 2);
}

Forecast::Place Forecast::ahead(int frames) const {
  Place place = last_;
  if (turns_) {
    const double angle = std::min(glm::length(turn_) * frames, kFarthestTurn);
    const glm::dvec3 along = glm::cross(glm::normalize(turn_), last_.u);
    place.u = glm::normalize(last_.u * std::cos(angle) + along * std::sin(angle));
  }
  if (grows_) place.height_m = last_.height_m * std::pow(growth_, frames);
  return place;
}

}  // namespace globe::render
