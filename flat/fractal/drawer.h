#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "flat/fractal/terrain.h"
#include "globe/gl/buffer.h"
#include "globe/gl/framebuffer.h"
#include "globe/gl/program.h"
#include "globe/gl/vertex_array.h"
#include "globe/render/camera.h"

namespace globe::flat::fractal {

/// How the ground looks.
struct Look {
  glm::vec3 to_sun{-0.5f, 0.5f, 0.6f};  ///< any length, not 0
  glm::vec3 sky{0.62f, 0.73f, 0.86f};   ///< what is behind the ground and, by distance, before it
  double sight_m = 0;                   ///< distance at which fog leaves 1/e of the ground; 0: no fog
  bool wireframe = false;
};

/// Draws a Terrain: all blocks in one indirect draw, the vertices of each in a place of its own that is
/// written when the block is first in view. Colour and light are worked out at the vertices.
///
/// A post's place is worked out from whole numbers of posts and its height, by the same operations whichever
/// block it is drawn with, so that blocks meet bit for bit.
class Drawer {
 public:
  /// Needs a current context, here and to draw. The terrain must outlive the drawer.
  explicit Drawer(Terrain& terrain, const Look& look = {});

  struct Stats {
    std::size_t triangles = 0;
    std::size_t blocks = 0;
    std::size_t upload_bytes = 0;
    HeightTree::Counts culling;
  };

  /// Pages for the eye, uploads what is new in view and draws over the whole target.
  /// @param camera  forward, right and up east, north, up; its position is not read
  /// @param eye     posts east and north, metres up
  /// @param near_m  metres to the near plane
  Stats draw(const render::Camera& camera, const glm::dvec3& eye, double near_m,
             const gl::Framebuffer& target);

 private:
  struct Mesh {
    unsigned count = 0, first = 0;  ///< indices
  };
  struct Command {  // as OpenGL lays it out
    unsigned count, instances, first_index;
    int base_vertex;
    unsigned base_instance;
  };
  /// Height and slopes of the post, and of the two that it goes between on the way to the next coarser level.
  struct Vertex {
    glm::vec3 post{0.0f}, one{0.0f}, other{0.0f};
  };

  void upload(int slot);

  Terrain& terrain_;
  Look look_;
  std::array<std::array<Mesh, 16>, kLevels> meshes_{};
  gl::Program program_;
  gl::Buffer indices_, vertices_, corners_, commands_;
  gl::VertexArray array_;
  GLint clip_, eye_post_, eye_within_, eye_height_, spacing_, sun_, sky_, per_sight_, relief_, bands_;
  std::vector<std::optional<BlockKey>> uploaded_;  ///< by slot
  std::vector<Vertex> block_vertices_;
  std::vector<Command> command_list_;
  std::vector<glm::ivec2> corner_list_;
};

}  // namespace globe::flat::fractal
