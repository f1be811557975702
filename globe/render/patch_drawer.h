#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "globe/clipmap/patch.h"
#include "globe/clipmap/settings.h"
#include "globe/gl/buffer.h"
#include "globe/gl/program.h"
#include "globe/gl/vertex_array.h"
#include "globe/render/clipmap_textures.h"
#include "globe/render/draw_list.h"

namespace globe::render {

/// Draws patches of the clipmap: the mesh of one, instanced, with a program for each look.
class PatchDrawer {
 public:
  /// A GL context must be current and stay so.
  explicit PatchDrawer(const clipmap::Settings& settings);

  /// What a view's patches and their slots are, for the calls of draw() that follow.
  void upload(const DrawList& list);

  /// The program for a batch; called as programs change. Null: its patches are left out.
  using ProgramFor = std::function<const gl::Program*(const Batch& batch)>;
  /// Draws the list uploaded last. Programs are built from shaders/clipmap.vert: their uniforms `window` and
  /// `rim` are set here.
  void draw(const DrawList& list, const ClipmapTextures& textures, const ProgramFor& program_for) const;

  /// Those of the ground: the patches inside a room are for seas alone.
  std::size_t triangles(const DrawList& list) const;

 private:
  clipmap::Settings settings_;
  clipmap::PatchMesh mesh_;
  std::array<std::size_t, 8> index_offset_{};
  gl::Buffer vertices_, indices_, instances_, slots_;
  gl::VertexArray array_;
};

}  // namespace globe::render
