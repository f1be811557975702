#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "flat/terrain.h"
#include "globe/planet/appearance.h"

namespace globe::flat {

/// Adds what is known of the ground at a place, by its geodetic normal: whatever `ground` has besides height,
/// slope, cavity, latitude and distance of posts, which are there already. Called from any thread.
using GroundKnowledge = std::function<void(const dvec3& normal, planet::Ground& ground)>;

/// Albedo of every post, linear light (planet::albedo), row by row from the south-west; in w 1 where a sea
/// lies open over it.
/// @param coloring  a look in its place; null: none
std::vector<glm::vec4> post_colors(const Terrain& terrain, const GroundKnowledge& knowledge = {},
                                   const planet::Coloring* coloring = nullptr);

/// Normal of the ground at a post, in the frame: the cross product of the differences of its neighbours.
glm::vec3 post_normal(const Terrain& terrain, int column, int row);

/// Share of the sun's disc that is seen from a post over the region's own ground, [0, 1].
/// @param sun  unit vector toward it, in the frame
float sun_seen(const Terrain& terrain, int column, int row, const dvec3& sun);

/// The whole region lit by a sun that stands still, a texel a post, static shadows and all: as
/// clipmap::lit_texel has it. On all threads.
/// @param shadows  false: only the ground's tilt counts
std::vector<glm::u8vec4> light_posts(const Terrain& terrain, const std::vector<glm::vec4>& colors,
                                     const dvec3& sun, bool shadows = true);

/// In its place, to be shown: normals, a component to [0, 1].
std::vector<glm::u8vec4> shown_normals(const Terrain& terrain);

}  // namespace globe::flat
