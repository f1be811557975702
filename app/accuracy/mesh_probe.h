#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <vector>

#include "globe/clipmap/patch.h"
#include "globe/clipmap/stream.h"
#include "globe/gl/buffer.h"
#include "globe/gl/framebuffer.h"
#include "globe/gl/program.h"
#include "globe/gl/vertex_array.h"
#include "globe/planet/surface.h"
#include "globe/render/camera.h"
#include "globe/render/clipmap_textures.h"
#include "globe/render/draw_list.h"

namespace app::accuracy {

using glm::dvec3;
using globe::planet::Surface;
using globe::render::Camera;

/// A corner of a drawn triangle: what the vertex shader made of it, and which node it stands on.
struct ProbeVertex {
  glm::vec4 seen;            ///< clip space, or with Space::kRelative metres from the camera
  globe::planet::Node node;  ///< of the level it was drawn at
  bool on_rim = false;       ///< taken from the coarser level
  globe::render::Kind kind = globe::render::Kind::kPlain;
};

/// Reads back every triangle the ground is drawn with: the renderer's own draw list, textures and vertex
/// shader, recorded by transform feedback. Nothing is culled.
class MeshProbe {
 public:
  enum class Space { kClip, kRelative };

  /// @param reader  gives the shaders, for negative controls
  MeshProbe(std::shared_ptr<const Surface> surface, const globe::clipmap::Settings& settings,
            const globe::gl::ShaderReader& reader = globe::gl::read_shader);

  /// Loads what a camera at `position` wants down to level `finest`.
  void load(const dvec3& position, int finest, const globe::clipmap::Lighting& lighting = {});

  /// Corners of all triangles, three a triangle, in an order that the camera does not change.
  ///
  /// @param space       kRelative: the projection is left out, so positions come back bit for bit
  /// @param all_as_rim  every patch by the program for rims, with no edge on one
  std::vector<ProbeVertex> triangles(const Camera& camera, float fade, Space space,
                                     bool all_as_rim = false) const;

  /// The same of another's state and textures, of the levels up to `finest`.
  std::vector<ProbeVertex> triangles(const globe::clipmap::ClipmapState& state,
                                     const globe::render::ClipmapTextures& textures, const Camera& camera,
                                     int finest, float fade, Space space, bool all_as_rim = false) const;

  const globe::clipmap::ClipmapState& state() const { return *state_; }
  const globe::clipmap::Settings& settings() const { return settings_; }
  const globe::render::ClipmapTextures& textures() const { return textures_; }

 private:
  std::shared_ptr<const Surface> surface_;
  globe::clipmap::Settings settings_;
  globe::clipmap::PatchMesh mesh_;
  globe::gl::Buffer vertices_;
  globe::gl::Framebuffer nowhere_{1, 1};  ///< drawing wants one, though nothing is rasterised
  globe::render::ClipmapTextures textures_;
  std::array<globe::gl::Program, 3> programs_;
  std::shared_ptr<const globe::clipmap::ClipmapState> state_;
};

}  // namespace app::accuracy
