#include "tests/bench/submission/draw_ways.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <memory>

#include "globe/clipmap/morph.h"
#include "globe/gl/vertex_array.h"
#include "globe/render/air.h"
#include "globe/render/ground_program.h"
#include "tests/render/ground/shader_variant.h"

namespace bench {
namespace {

using globe::gl::Buffer;
using globe::gl::Program;
using globe::gl::VertexArray;
using globe::render::Batch;
using globe::render::Kind;
using globe::render::kLooks;

/// What all ways share: programs, the patch's vertices and indices.
struct Ground {
  Ground(const GroundScene& of, const globe::clipmap::PatchMesh& mesh, const globe::gl::ShaderReader& reader)
      : scene(of), vertices(Buffer::of(mesh.vertices)), array(VertexArray::create()) {
    std::vector<std::uint16_t> all;
    for (std::size_t rim = 0; rim < 8; ++rim) {
      first_index[rim] = static_cast<GLuint>(all.size());
      count[rim] = static_cast<GLsizei>(mesh.indices[rim].size());
      all.insert(all.end(), mesh.indices[rim].begin(), mesh.indices[rim].end());
    }
    indices = Buffer::of(all);
    array.set_vertices(0, vertices, 0, 2);
    array.set_attribute(0, {0, 2, GL_UNSIGNED_BYTE, 0, globe::gl::Attribute::Kind::kInteger});
    array.set_indices(indices);
    for (std::size_t k = 0; k < kLooks.size(); ++k) {
      globe::gl::ProgramSources sources =
          globe::render::ground_sources(kLooks[k], scene.textures, false, globe::render::AirSteps{}.haze);
      sources.reader = reader;
      programs[k] = globe::gl::Program(sources);
    }
  }

  void add_instances(const Buffer& instances) {
    array.set_vertices(1, instances, 0, sizeof(glm::ivec4), 1);
    array.set_attribute(1, {1, 4, GL_INT, 0, globe::gl::Attribute::Kind::kInteger});
  }

  const Program& use(const globe::render::Look& look) const {
    const Program& program =
        programs[static_cast<std::size_t>(std::find(kLooks.begin(), kLooks.end(), look) - kLooks.begin())];
    const auto band = globe::clipmap::morph_band(scene.settings);
    program.use();
    program.set(0, glm::ivec4(scene.settings.window(), band.begin, band.end, scene.settings.m));
    return program;
  }

  const void* index_at(int rim) const {
    // OpenGL takes an offset into the bound buffer as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
    return reinterpret_cast<const void*>(first_index[static_cast<std::size_t>(rim)] * sizeof(std::uint16_t));
  }

  const GroundScene& scene;
  Buffer vertices, indices;
  VertexArray array;
  std::array<GLuint, 8> first_index{};
  std::array<GLsizei, 8> count{};
  std::array<Program, kLooks.size()> programs;
};

std::vector<glm::ivec4> all_instances(const GroundScene& scene) {
  std::vector<glm::ivec4> all;
  for (const Batch& batch : scene.list.batches)
    all.insert(all.end(), batch.instances.begin(), batch.instances.end());
  return all;
}

int rim_word(const Batch& batch) { return batch.rim | batch.rim_corners << 3; }

/// glDrawElementsIndirect's command.
struct Command {
  GLuint count, instances, first_index, base_vertex, base_instance;
};

DrawWay indirect(const GroundScene& scene) {
  // A rim is a word for each draw instead of a uniform.
  const globe::gl::ShaderReader reader = [](const std::string& name) {
    auto text = globe::gl::read_shader(name);
    if (text && name == "clipmap.vert") {
      text = "#extension GL_ARB_shader_draw_parameters : require\n" +
             views::exchanged(*text, "layout(location = 2) uniform int rim;",
                              "layout(location = 2) uniform int first_draw;\n"
                              "layout(std430, binding = 0) readonly buffer Rims { int rims[]; };\n"
                              "#define rim rims[first_draw + gl_DrawIDARB]");
    }
    return text;
  };
  struct Way {
    Ground ground;
    Buffer instances, commands, rims;
  };
  auto way = std::make_shared<Way>(
      Way{Ground(scene, scene.mesh, reader), Buffer(1 << 20), Buffer(1 << 16), Buffer(1 << 16)});
  way->ground.add_instances(way->instances);
  return {"multi-draw indirect", [way] {
            const auto& batches = way->ground.scene.list.batches;
            const std::vector<glm::ivec4> all = all_instances(way->ground.scene);
            std::vector<Command> commands;
            std::vector<int> rims;
            GLuint first = 0;
            for (const Batch& batch : batches) {
              const auto rim = static_cast<std::size_t>(batch.rim);
              commands.push_back({static_cast<GLuint>(way->ground.count[rim]),
                                  static_cast<GLuint>(batch.instances.size()), way->ground.first_index[rim],
                                  0, first});
              rims.push_back(rim_word(batch));
              first += static_cast<GLuint>(batch.instances.size());
            }
            way->instances.upload(0, all.data(), all.size() * sizeof(glm::ivec4));
            way->commands.upload(0, commands.data(), commands.size() * sizeof(Command));
            way->rims.upload(0, rims.data(), rims.size() * sizeof(int));
            way->rims.bind_base(GL_SHADER_STORAGE_BUFFER, 0);
            way->commands.bind(GL_DRAW_INDIRECT_BUFFER);
            way->ground.array.bind();
            for (std::size_t k = 0; k < batches.size();) {
              std::size_t end = k;
              while (end < batches.size() && batches[end].look == batches[k].look) ++end;
              const Program& program = way->ground.use(batches[k].look);
              if (batches[k].look.kind == Kind::kRim) program.set(2, static_cast<int>(k));
              // NOLINTNEXTLINE(performance-no-int-to-ptr): an offset into the bound buffer
              const void* const at = reinterpret_cast<const void*>(k * sizeof(Command));
              glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_SHORT, at, static_cast<GLsizei>(end - k),
                                          0);
              k = end;
            }
          }};
}

DrawWay plain(const GroundScene& scene) {
  auto ground = std::make_shared<Ground>(scene, scene.mesh, globe::gl::read_shader);
  return {"a draw for each patch", [ground] {
            ground->array.bind();
            for (const Batch& batch : ground->scene.list.batches) {
              const Program& program = ground->use(batch.look);
              if (batch.look.kind == Kind::kRim) program.set(2, rim_word(batch));
              for (const glm::ivec4& instance : batch.instances) {
                glVertexAttribI4i(1, instance.x, instance.y, instance.z, instance.w);
                glDrawElements(GL_TRIANGLES, ground->count[static_cast<std::size_t>(batch.rim)],
                               GL_UNSIGNED_SHORT, ground->index_at(batch.rim));
              }
            }
          }};
}

}  // namespace

DrawWay instanced(const std::string& name, const GroundScene& scene, const globe::clipmap::PatchMesh& mesh) {
  struct Way {
    Ground ground;
    Buffer instances;
  };
  auto way = std::make_shared<Way>(Way{Ground(scene, mesh, globe::gl::read_shader), Buffer(1 << 20)});
  way->ground.add_instances(way->instances);
  return {name, [way] {
            const Ground& ground = way->ground;
            std::size_t first = 0;
            for (const Batch& batch : ground.scene.list.batches) {
              way->instances.upload(first * sizeof(glm::ivec4), batch.instances.data(),
                                    batch.instances.size() * sizeof(glm::ivec4));
              first += batch.instances.size();
            }
            ground.array.bind();
            GLuint base = 0;
            for (const Batch& batch : ground.scene.list.batches) {
              const Program& program = ground.use(batch.look);
              if (batch.look.kind == Kind::kRim) program.set(2, rim_word(batch));
              glDrawElementsInstancedBaseInstance(
                  GL_TRIANGLES, ground.count[static_cast<std::size_t>(batch.rim)], GL_UNSIGNED_SHORT,
                  ground.index_at(batch.rim), static_cast<GLsizei>(batch.instances.size()), base);
              base += static_cast<GLuint>(batch.instances.size());
            }
          }};
}

std::vector<DrawWay> draw_ways(const GroundScene& scene) {
  std::vector<DrawWay> ways{instanced("instances of a look and rim", scene, scene.mesh)};
  if (epoxy_has_gl_extension("GL_ARB_shader_draw_parameters")) ways.push_back(indirect(scene));
  ways.push_back(plain(scene));
  return ways;
}

}  // namespace bench
