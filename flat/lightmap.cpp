#include "flat/lightmap.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "globe/clipmap/lighting.h"

namespace globe::flat {
namespace {

constexpr double kSunRadius = 0.00465;  ///< of its disc, radians

/// Calls work(column, row, index) for every post, on all threads.
template <class Work>
void for_each_post(const Terrain& terrain, const Work& work) {
  const PostRect& posts = terrain.posts();
  tbb::parallel_for(0, posts.rows, [&](int row) {
    for (int column = 0; column < posts.columns; ++column)
      work(column, row,
           static_cast<std::size_t>(row) * static_cast<std::size_t>(posts.columns) +
               static_cast<std::size_t>(column));
  });
}

std::uint8_t code(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

/// z between four posts, bilinear; only for places within the region, counted in posts.
double z_between(const Terrain& terrain, double column, double row) {
  const int i = std::min(static_cast<int>(column), terrain.posts().columns - 2);
  const int j = std::min(static_cast<int>(row), terrain.posts().rows - 2);
  const double u = column - i;
  const double v = row - j;
  const auto z = [&](int di, int dj) { return static_cast<double>(terrain.z(i + di, j + dj)); };
  return (z(0, 0) * (1.0 - u) + z(1, 0) * u) * (1.0 - v) + (z(0, 1) * (1.0 - u) + z(1, 1) * u) * v;
}

/// Steps along one axis until the next patch is entered, from a place along it; a little more, to be inside.
double steps_to_next_patch(double place, double direction) {
  if (direction == 0.0) return std::numeric_limits<double>::infinity();
  const double within = place - std::floor(place / kPatchCells) * kPatchCells;
  const double left = direction > 0.0 ? kPatchCells - within : within;
  return (left + 1e-6) / std::abs(direction);
}

}  // namespace

glm::vec3 post_normal(const Terrain& terrain, int column, int row) {
  const int west = std::max(column - 1, 0);
  const int east = std::min(column + 1, terrain.posts().columns - 1);
  const int south = std::max(row - 1, 0);
  const int north = std::min(row + 1, terrain.posts().rows - 1);
  const auto spacing = static_cast<float>(terrain.spacing_m());
  const glm::vec3 along_x(static_cast<float>(east - west) * spacing, 0.0f,
                          terrain.z(east, row) - terrain.z(west, row));
  const glm::vec3 along_y(0.0f, static_cast<float>(north - south) * spacing,
                          terrain.z(column, north) - terrain.z(column, south));
  return glm::normalize(glm::cross(along_x, along_y));
}

std::vector<glm::vec4> post_colors(const Terrain& terrain, const GroundKnowledge& knowledge,
                                   const planet::Coloring* coloring) {
  const PostRect& posts = terrain.posts();
  std::vector<glm::vec4> colors(static_cast<std::size_t>(posts.columns) *
                                static_cast<std::size_t>(posts.rows));
  for_each_post(terrain, [&](int column, int row, std::size_t k) {
    const glm::vec3 n = post_normal(terrain, column, row);
    const dvec3 normal = terrain.frame().normal_at(terrain.x_m(column), terrain.y_m(row),
                                                   static_cast<double>(terrain.height(column, row)));
    planet::Ground ground;
    ground.height_m = static_cast<double>(terrain.height(column, row));
    ground.slope = -glm::dvec2(n) / static_cast<double>(n.z);
    const int west = std::max(column - 1, 0);
    const int east = std::min(column + 1, posts.columns - 1);
    const int south = std::max(row - 1, 0);
    const int north = std::min(row + 1, posts.rows - 1);
    const float around = 0.25f * (terrain.z(west, row) + terrain.z(east, row) + terrain.z(column, south) +
                                  terrain.z(column, north));
    ground.cavity = static_cast<double>(terrain.z(column, row) - around) / terrain.spacing_m();
    ground.sin_latitude = normal.z;
    ground.edge_m = terrain.spacing_m();
    if (knowledge) knowledge(normal, ground);
    glm::vec3 color = planet::albedo(ground);
    const bool water = !ground.bare_floor && planet::is_open_water(ground, color);
    if (coloring != nullptr) color = (*coloring)(ground, color);
    colors[k] = glm::vec4(color, water ? 1.0f : 0.0f);
  });
  return colors;
}

float sun_seen(const Terrain& terrain, int column, int row, const dvec3& sun) {
  const double level = std::hypot(sun.x, sun.y);
  if (level < 1e-9) return sun.z > 0.0 ? 1.0f : 0.0f;
  // Places along the way count in posts, z in metres a post of way.
  const double dx = sun.x / level;
  const double dy = sun.y / level;
  const double rise = sun.z / level * terrain.spacing_m();
  const double half_disc =
      kSunRadius * (1.0 + rise * rise / (terrain.spacing_m() * terrain.spacing_m())) * terrain.spacing_m();
  const auto z0 = static_cast<double>(terrain.z(column, row));
  const double last_column = terrain.posts().columns - 1.0;
  const double last_row = terrain.posts().rows - 1.0;
  double highest = -1e30;  // slope up to what stands highest on the way
  for (double way = 1.0;;) {
    const double x = column + dx * way;
    const double y = row + dy * way;
    if (x < 0.0 || y < 0.0 || x > last_column || y > last_row) break;
    const auto patch =
        static_cast<std::size_t>(std::min(static_cast<int>(y) / kPatchCells, terrain.patches_north() - 1)) *
            static_cast<std::size_t>(terrain.patches_east()) +
        static_cast<std::size_t>(std::min(static_cast<int>(x) / kPatchCells, terrain.patches_east() - 1));
    const double above = static_cast<double>(terrain.patch(patch).highest_m) - z0;
    if (above < (rise - half_disc) * way) {  // the patch can hide nothing of the disc
      way += std::max(std::min(steps_to_next_patch(x, dx), steps_to_next_patch(y, dy)), 1.0);
      continue;
    }
    highest = std::max(highest, (z_between(terrain, x, y) - z0) / way);
    if (highest > rise + half_disc) return 0.0f;
    way += 1.0;
  }
  return static_cast<float>(1.0 - glm::smoothstep(rise - half_disc, rise + half_disc, highest));
}

std::vector<glm::u8vec4> light_posts(const Terrain& terrain, const std::vector<glm::vec4>& colors,
                                     const dvec3& sun, bool shadows) {
  std::vector<glm::u8vec4> texels(colors.size());
  const double radius = terrain.frame().ellipsoid().mean_radius();
  for_each_post(terrain, [&](int column, int row, std::size_t k) {
    const glm::vec3 normal = post_normal(terrain, column, row);
    const glm::vec3 up(glm::normalize(dvec3(terrain.x_m(column), terrain.y_m(row), radius)));
    float facing = std::max(glm::dot(normal, glm::vec3(sun)), 0.0f);
    if (shadows && facing > 0.0f) facing *= sun_seen(terrain, column, row, sun);
    const glm::vec4 lit = clipmap::lit_texel(glm::vec3(colors[k]), glm::dot(normal, up), facing);
    texels[k] = {code(lit.r), code(lit.g), code(lit.b), code(lit.a)};
  });
  return texels;
}

std::vector<glm::u8vec4> shown_normals(const Terrain& terrain) {
  const PostRect& posts = terrain.posts();
  std::vector<glm::u8vec4> texels(static_cast<std::size_t>(posts.columns) *
                                  static_cast<std::size_t>(posts.rows));
  for_each_post(terrain, [&](int column, int row, std::size_t k) {
    const glm::vec3 shown = 0.5f * post_normal(terrain, column, row) + 0.5f;
    texels[k] = {code(shown.x), code(shown.y), code(shown.z), 255};
  });
  return texels;
}

}  // namespace globe::flat
