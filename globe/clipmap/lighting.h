#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "globe/clipmap/region.h"
#include "globe/planet/appearance.h"

namespace globe::clipmap {

/// What the ground is shaded with before it is drawn.
struct Lighting {
  dvec3 sun{0.0, 0.0, 1.0};                            ///< unit vector toward it, ECEF
  bool normals = false;                                ///< show normals in place of light
  std::shared_ptr<const planet::Coloring> coloring{};  ///< of the ground; null: its own

  friend bool operator==(const Lighting&, const Lighting&) = default;
};

/// What the ground of a rectangle of shading nodes is, whatever light falls on it: row by row, i fastest.
/// @approximation shading.normals
struct ShadingNodes {
  std::vector<glm::u8vec4> albedo;   ///< square root of linear light; alpha: 255 where there is open water
  std::vector<glm::u16vec2> normal;  ///< normal's components along the shading frame, [-1, 1] as unorm16

  void resize(const NodeRect& rect);
};

/// Axis from which the shading frame of a diamond is made: t1 is its part perpendicular to the normal u, t2 =
/// u x t1. East on the diamond's central meridian; nowhere in the diamond along u, the poles included.
dvec3 shading_axis(int d);

/// @approximation shading.texels
/// Ground as a texel has it, before it is rounded to bytes, and the light that leaves it again;
/// shaders/lib/lit_ground.glsl, compiled here.
///
/// @param albedo  linear
/// @param up      cosine of the slope
/// @param facing  cosine between the ground's normal and the sun
glm::vec4 lit_texel(const glm::vec3& albedo, float up, float facing);
glm::vec3 light_of(const glm::vec4& lit, const glm::vec3& sunlight, const glm::vec3& skylight);

/// The nodes `part` of `held`, lit: what shaders/lib/lit_ground.glsl takes apart with one look-up a pixel,
/// where albedo and normal would take two.
///
/// A function of the node and the light alone: the sun's parts along the shading frame are taken exactly
/// every 16 nodes (fewer on coarse levels) and linearly between, which turns it by less than 0.05 degrees.
/// @param level   of the nodes
/// @param ground  of the nodes `held`
std::vector<glm::u8vec4> lit_nodes(const Lighting& lighting, int level, int d, const NodeRect& part,
                                   const NodeRect& held, const ShadingNodes& ground);

}  // namespace globe::clipmap
