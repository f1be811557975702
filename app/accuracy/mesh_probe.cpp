#include "app/accuracy/mesh_probe.h"

#include <epoxy/gl.h>

#include <map>
#include <string>
#include <utility>

#include "globe/clipmap/morph.h"
#include "globe/render/view_block.h"

namespace app::accuracy {
namespace {

using globe::gl::Buffer;
using globe::render::Batch;
using globe::render::DrawList;
using globe::render::Kind;

globe::gl::Program probe_program(Kind kind, const globe::render::ClipmapTextures& textures,
                                 const globe::gl::ShaderReader& reader) {
  globe::gl::ProgramSources sources;
  sources.files = {"clipmap.vert"};
  sources.defines = textures.defines();
  sources.defines.push_back("MAX_SLOTS " + std::to_string(globe::render::kMaxSlots));
  sources.defines.emplace_back("HAZE_STEPS 1");
  if (kind != Kind::kPlain) sources.defines.emplace_back("MORPH");
  if (kind == Kind::kRim) sources.defines.emplace_back("RIM");
  sources.captured = {"gl_Position"};
  sources.reader = reader;
  return globe::gl::Program(sources);
}

bool on_rim(const Batch& batch, int m, int a, int b) {
  return ((batch.rim & 1) != 0 && a + b == m) || ((batch.rim & 2) != 0 && a == 0) ||
         ((batch.rim & 4) != 0 && b == 0) || ((batch.rim_corners & 1) != 0 && a + b == 0) ||
         ((batch.rim_corners & 2) != 0 && a == m) || ((batch.rim_corners & 4) != 0 && b == m);
}

}  // namespace

MeshProbe::MeshProbe(std::shared_ptr<const Surface> surface, const globe::clipmap::Settings& settings,
                     const globe::gl::ShaderReader& reader)
    : surface_(std::move(surface)),
      settings_(settings),
      mesh_(globe::clipmap::make_patch_mesh(settings.m)),
      vertices_(Buffer::of(mesh_.vertices)),
      textures_(settings),
      programs_{probe_program(Kind::kPlain, textures_, reader),
                probe_program(Kind::kMorphing, textures_, reader),
                probe_program(Kind::kRim, textures_, reader)} {}

void MeshProbe::load(const dvec3& position, int finest, const globe::clipmap::Lighting& lighting) {
  const globe::geo::Geodetic place = globe::geo::geodetic_from_ecef(surface_->ellipsoid(), position);
  const globe::clipmap::Target target{globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg), finest,
                                      lighting};
  auto update =
      globe::clipmap::advance(settings_, *surface_, target, state_.get(), globe::clipmap::Stride::kWhole);
  state_ = update.state;
  textures_.apply(std::move(update));
}

std::vector<ProbeVertex> MeshProbe::triangles(const Camera& camera, float fade, Space space,
                                              bool all_as_rim) const {
  return triangles(*state_, textures_, camera, state_->target.finest, fade, space, all_as_rim);
}

std::vector<ProbeVertex> MeshProbe::triangles(const globe::clipmap::ClipmapState& state,
                                              const globe::render::ClipmapTextures& textures,
                                              const Camera& camera, int finest, float fade, Space space,
                                              bool all_as_rim) const {
  const DrawList list = globe::render::make_draw_list(settings_, state, textures, surface_->ellipsoid(),
                                                      camera, {finest, fade}, false);
  globe::render::ViewBlock view = globe::render::view_block(camera, *surface_, dvec3(1.0, 0.0, 0.0), 0.05);
  if (space == Space::kRelative) view.clip_from_relative = glm::mat4(1.0f);
  const Buffer view_buffer(sizeof view, &view);
  view_buffer.bind_base(GL_UNIFORM_BUFFER, 0);
  Buffer slots(globe::render::kMaxSlots * sizeof(globe::render::SlotBlock));
  slots.upload(0, list.slots.data(), list.slots.size() * sizeof(globe::render::SlotBlock));
  slots.bind_base(GL_UNIFORM_BUFFER, 1);
  textures.bind();
  nowhere_.bind();
  glEnable(GL_RASTERIZER_DISCARD);
  const globe::clipmap::MorphBand band = globe::clipmap::morph_band(settings_);
  std::map<std::array<int, 5>, std::vector<ProbeVertex>> patches;  // by level, diamond, corner, half
  std::vector<std::array<int, 2>> slot_names(list.slots.size());   // level and diamond
  for (const auto& level : state.levels) {
    for (int d = 0; d < globe::planet::kDiamonds; ++d) {
      const int layer = textures.vertex_layer(level->region.level, d);
      for (std::size_t k = 0; k < list.slots.size(); ++k) {
        if (layer >= 0 && list.slots[k].torus.z == layer) slot_names[k] = {level->region.level, d};
      }
    }
  }
  for (const Batch& batch : list.batches) {
    const auto& order = mesh_.indices[static_cast<std::size_t>(batch.rim)];
    const Buffer indices = Buffer::of(order);
    const Buffer instances = Buffer::of(batch.instances);
    globe::gl::VertexArray array = globe::gl::VertexArray::create();
    array.set_vertices(0, vertices_, 0, 2);
    array.set_attribute(0, {0, 2, GL_UNSIGNED_BYTE, 0, globe::gl::Attribute::Kind::kInteger});
    array.set_vertices(1, instances, 0, sizeof(glm::ivec4), 1);
    array.set_attribute(1, {1, 4, GL_INT, 0, globe::gl::Attribute::Kind::kInteger});
    array.set_indices(indices);
    array.bind();
    const Kind kind = all_as_rim ? Kind::kRim : batch.look.kind;
    const globe::gl::Program& program = programs_[static_cast<std::size_t>(kind)];
    program.use();
    program.set(0, glm::ivec4(settings_.window(), band.begin, band.end, settings_.m));
    if (kind == Kind::kRim) program.set(2, batch.rim | batch.rim_corners << 3);
    const std::size_t count = order.size() * batch.instances.size();
    const Buffer recorded(count * sizeof(glm::vec4));
    recorded.bind_base(GL_TRANSFORM_FEEDBACK_BUFFER, 0);
    glBeginTransformFeedback(GL_TRIANGLES);
    glDrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(order.size()), GL_UNSIGNED_SHORT, nullptr,
                            static_cast<GLsizei>(batch.instances.size()));
    glEndTransformFeedback();
    const auto positions = recorded.read<glm::vec4>(0, count);
    for (std::size_t k = 0; k < count; ++k) {
      const glm::ivec4& instance = batch.instances[k / order.size()];
      const auto [a, b] = mesh_.vertices[order[k % order.size()]];
      const auto [level, d] = slot_names[static_cast<std::size_t>(instance.w)];
      const auto& rect = state.levels[static_cast<std::size_t>(level - settings_.base_level)]
                             ->vertices[static_cast<std::size_t>(d)];
      patches[{level, d, instance.x, instance.y, instance.z}].push_back(
          {positions[k],
           {d, level, rect.i0 + instance.x + instance.z * a, rect.j0 + instance.y + instance.z * b},
           on_rim(batch, settings_.m, a, b),
           batch.look.kind});
    }
  }
  glDisable(GL_RASTERIZER_DISCARD);
  std::vector<ProbeVertex> result;
  for (const auto& [name, vertices] : patches) result.insert(result.end(), vertices.begin(), vertices.end());
  return result;
}

}  // namespace app::accuracy
