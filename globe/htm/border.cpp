#include "globe/htm/border.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace globe::htm {
namespace {

/// More than the rounding of a direction and of the products below, radians.
constexpr double kRounding = 1e-15;

}  // namespace

/// Inward normals of a trixel's sides, and their lengths.
struct Border::Sides {
  std::array<dvec3, 3> normal;
  std::array<double, 3> length;

  explicit Sides(const Corners& t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const dvec3& a = t[k];
      const dvec3& b = t[k == 2 ? 0 : k + 1];
      normal[k] = glm::cross(a + b, b - a);
      length[k] = glm::length(normal[k]);
    }
  }
};

Border::Border(std::vector<std::shared_ptr<const Curve>> curves, double margin)
    : curves_(std::move(curves)), margin_(margin), tree_({}) {
  std::vector<Box> boxes;
  for (const auto& curve : curves_)
    add_pieces({curve.get(), 0.0, 1.0, curve->at(0.0), curve->at(1.0)}, boxes);
  tree_ = BoxTree(boxes);
}

double Border::stray(const Piece& piece) const {
  const double length = piece.t1 - piece.t0;
  return 0.125 * length * length * piece.curve->bend(piece.t0, piece.t1) + margin_ + kRounding;
}

/// Halves the piece until it is nearly straight, so that boxes around its parts are slim.
void Border::add_pieces(const Piece& piece, std::vector<Box>& boxes) {
  constexpr double kStraight = 1.0 / 32.0;
  constexpr double kSlight = 1e-12;
  const double thickness = stray(piece);
  const double chord = glm::distance(piece.p, piece.q);
  if (thickness <= std::max(kStraight * chord, kSlight + margin_)) {
    const std::array<dvec3, 2> ends{piece.p, piece.q};
    boxes.push_back(box_around(ends, thickness));
    pieces_.push_back(piece);
    return;
  }
  const double t = 0.5 * (piece.t0 + piece.t1);
  const dvec3 middle = piece.curve->at(t);
  add_pieces({piece.curve, piece.t0, t, piece.p, middle}, boxes);
  add_pieces({piece.curve, t, piece.t1, middle, piece.q}, boxes);
}

bool Border::touches(const Corners& trixel) const {
  const Box around = trixel_box(trixel);
  const Sides sides(trixel);
  return tree_.any([&](const Box& box) { return around.meets(box); },
                   [&](std::uint32_t k) { return touches(pieces_[k], trixel, sides); });
}

bool Border::touches(const Piece& piece, const Corners& trixel, const Sides& sides) const {
  const double thickness = stray(piece);
  // Beyond one of the trixel's sides, both ends by more than the thickness.
  bool p_inside = true, q_inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const double p = glm::dot(sides.normal[k], piece.p - trixel[k]);
    const double q = glm::dot(sides.normal[k], piece.q - trixel[k]);
    if (std::max(p, q) < -thickness * sides.length[k]) return false;
    p_inside = p_inside && p >= 0.0;
    q_inside = q_inside && q >= 0.0;
  }
  if (p_inside || q_inside) return true;
  // The trixel to one side of the piece's great circle, all corners by more than the thickness.
  const dvec3 normal = glm::cross(piece.p + piece.q, piece.q - piece.p);
  const double slack = thickness * glm::length(normal);
  std::array<double, 3> height{};
  for (std::size_t k = 0; k < 3; ++k) height[k] = glm::dot(normal, trixel[k] - piece.p);
  const auto [low, high] = std::minmax_element(height.begin(), height.end());
  if (*low > slack || *high < -slack) return false;
  if (thickness <= margin_ + 2.0 * kRounding) return true;
  const double t = 0.5 * (piece.t0 + piece.t1);
  const dvec3 middle = piece.curve->at(t);
  return touches({piece.curve, piece.t0, t, piece.p, middle}, trixel, sides) ||
         touches({piece.curve, t, piece.t1, middle, piece.q}, trixel, sides);
}

}  // namespace globe::htm
