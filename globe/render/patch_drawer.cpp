#include "globe/render/patch_drawer.h"

#include <epoxy/gl.h>

#include <glm/vec4.hpp>

#include "globe/clipmap/morph.h"

namespace globe::render {
namespace {

constexpr std::size_t kMaxInstances = 32768;

}  // namespace

PatchDrawer::PatchDrawer(const clipmap::Settings& settings)
    : settings_(settings),
      mesh_(clipmap::make_patch_mesh(settings.m)),
      vertices_(gl::Buffer::of(mesh_.vertices)),
      instances_(kMaxInstances * sizeof(glm::ivec4)),
      slots_(kMaxSlots * sizeof(SlotBlock)),
      array_(gl::VertexArray::create()) {
  std::vector<std::uint16_t> indices;
  for (std::size_t rim = 0; rim < 8; ++rim) {
    index_offset_[rim] = indices.size() * sizeof(std::uint16_t);
    indices.insert(indices.end(), mesh_.indices[rim].begin(), mesh_.indices[rim].end());
  }
  indices_ = gl::Buffer::of(indices);
  array_.set_vertices(0, vertices_, 0, 2);
  array_.set_attribute(0, {0, 2, GL_UNSIGNED_BYTE, 0, gl::Attribute::Kind::kInteger});
  array_.set_vertices(1, instances_, 0, sizeof(glm::ivec4), 1);
  array_.set_attribute(1, {1, 4, GL_INT, 0, gl::Attribute::Kind::kInteger});
  array_.set_indices(indices_);
}

void PatchDrawer::upload(const DrawList& list) {
  slots_.upload(0, list.slots.data(), list.slots.size() * sizeof(SlotBlock));
  std::size_t first = 0;
  for (const Batch& batch : list.batches) {
    instances_.upload(first * sizeof(glm::ivec4), batch.instances.data(),
                      batch.instances.size() * sizeof(glm::ivec4));
    first += batch.instances.size();
  }
}

void PatchDrawer::draw(const DrawList& list, const ClipmapTextures& textures,
                       const ProgramFor& program_for) const {
  const clipmap::MorphBand band = clipmap::morph_band(settings_);
  slots_.bind_base(GL_UNIFORM_BUFFER, 1);
  textures.bind();
  array_.bind();
  std::size_t first = 0;
  const gl::Program* bound = nullptr;
  for (const Batch& batch : list.batches) {
    const std::size_t from = first;
    first += batch.instances.size();
    const gl::Program* program = program_for(batch);
    if (program == nullptr) continue;
    if (bound != program) {
      program->use();
      program->set(0, glm::ivec4(settings_.window(), band.begin, band.end, settings_.m));
      bound = program;
    }
    if (batch.look.kind == Kind::kRim) program->set(2, batch.rim | batch.rim_corners << 3);
    const auto rim = static_cast<std::size_t>(batch.rim);
    // OpenGL takes an offset into the bound buffer as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
    const void* const first_index = reinterpret_cast<const void*>(index_offset_[rim]);
    glDrawElementsInstancedBaseInstance(
        GL_TRIANGLES, static_cast<GLsizei>(mesh_.indices[rim].size()), GL_UNSIGNED_SHORT, first_index,
        static_cast<GLsizei>(batch.instances.size()), static_cast<GLuint>(from));
  }
}

std::size_t PatchDrawer::triangles(const DrawList& list) const {
  std::size_t triangles = 0;
  for (const Batch& batch : list.batches)
    if (batch.room != RoomSide::kInside)
      triangles += batch.instances.size() * mesh_.indices[static_cast<std::size_t>(batch.rim)].size() / 3;
  return triangles;
}

}  // namespace globe::render
