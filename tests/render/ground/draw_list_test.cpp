// How each patch is drawn, against what its vertices call for.

#include "globe/render/draw_list.h"

#include "app/accuracy/mesh_probe.h"
#include "globe/clipmap/morph.h"
#include "tests/hard/table.h"
#include "tests/render/ground/views.h"

namespace {

namespace clipmap_shader {
using namespace glm;
#include "shaders/lib/clipmap.glsl"
[[maybe_unused]] const auto kUnused = std::make_tuple(&exact_mix, &torus_texel, &brick_texel);
}  // namespace clipmap_shader

namespace geo = globe::geo;
using globe::clipmap::LevelData;
using globe::clipmap::Settings;
using globe::render::Batch;
using globe::render::DrawList;
using globe::render::Kind;
using globe::render::Shading;
using globe::render::SlotBlock;
using views::Camera;
using views::dvec3;

/// A patch of a draw list with the level it belongs to.
struct DrawnPatch {
  const Batch& batch;
  const SlotBlock& slot;
  const LevelData& data;
  int d;
  glm::ivec4 instance;

  glm::ivec2 node(int a, int b) const { return glm::ivec2(instance) + instance.z * glm::ivec2(a, b); }
  glm::vec4 vertex(int a, int b) const {
    const auto k = static_cast<std::size_t>(d);
    const glm::ivec2 at = node(a, b);
    return data.positions[k][static_cast<std::size_t>(at.y * data.vertices[k].width() + at.x)];
  }
};

template <class Visit>
void for_each_patch(const app::accuracy::MeshProbe& probe, const DrawList& list, const Visit& visit) {
  for (const Batch& batch : list.batches) {
    for (const glm::ivec4& instance : batch.instances) {
      const SlotBlock& slot = list.slots[static_cast<std::size_t>(instance.w)];
      for (const auto& level : probe.state().levels) {
        for (int d = 0; d < globe::planet::kDiamonds; ++d) {
          if (level->region.level == slot.coarse.z &&
              probe.textures().vertex_layer(level->region.level, d) == slot.torus.z)
            visit(DrawnPatch{batch, slot, *level, d, instance});
        }
      }
    }
  }
}

float morph_of(const DrawnPatch& patch, const glm::ivec2& node, const globe::clipmap::MorphBand& band) {
  const glm::ivec2 p = node * 1024;
  const auto from = [&](int x, int y) { return clipmap_shader::hex_length(p - glm::ivec2(x, y)); };
  const SlotBlock& s = patch.slot;
  const int distance = std::min(std::min(from(s.images_a.x, s.images_a.y), from(s.images_a.z, s.images_a.w)),
                                std::min(from(s.images_b.x, s.images_b.y), from(s.images_b.z, s.images_b.w)));
  return std::max(clipmap_shader::morph_factor(distance, band.begin, band.end), s.offset.w);
}

std::vector<Camera> cameras(const views::GlobeRenderer& renderer) {
  std::vector<Camera> result;
  for (std::size_t k = 0; k < (hard::full() ? 60u : 14u); ++k) {
    const auto& place = views::hard_places()[k * 5 % views::hard_places().size()];
    result.push_back(views::camera_above(renderer, *views::builtin_planet(), place,
                                         3.0 * std::pow(1e6, static_cast<double>(k % 14) / 14.0), 0.0,
                                         -60.0));
  }
  return result;
}

TEST_F(GlTest, PatchesShowOneLevelWhereNoVertexCallsForTwo) {
  const auto surface = views::builtin_planet();
  const Settings settings = Settings::for_detail(32, 1);
  views::RenderSettings render;
  render.clipmap = settings;
  const views::GlobeRenderer renderer(surface, render);
  app::accuracy::MeshProbe probe(surface, settings);
  const auto band = globe::clipmap::morph_band(settings);
  std::size_t wrong = 0, single = 0, both = 0, needless = 0;
  for (const Camera& camera : cameras(renderer)) {
    probe.load(camera.position, settings.base_level + 8);
    for (const float fade : {0.0f, 0.4f, 0.6f, 0.8f}) {
      const DrawList list =
          globe::render::make_draw_list(settings, probe.state(), probe.textures(), surface->ellipsoid(),
                                        camera, {probe.state().target.finest, fade}, false);
      for_each_patch(probe, list, [&](const DrawnPatch& patch) {
        if (patch.data.region.level == settings.base_level || patch.batch.look.shading == Shading::kGlint)
          return;
        float least = 1.0f, most = 0.0f, morph = 0.0f;
        for (int b = 0; b <= settings.m; ++b) {
          for (int a = 0; a + b <= settings.m; ++a) {
            const float alpha = morph_of(patch, patch.node(a, b), band);
            morph = std::max(morph, alpha);
            least = std::min(least, clipmap_shader::shading_share(alpha));
            most = std::max(most, clipmap_shader::shading_share(alpha));
          }
        }
        const auto [kind, shading] = patch.batch.look;
        wrong += kind == Kind::kPlain && morph > 0.0f;
        wrong += shading == Shading::kFine && most > 0.0f;
        wrong += shading == Shading::kCoarse && least < 1.0f;
        single += shading != Shading::kBoth;
        both += shading == Shading::kBoth;
        needless += shading == Shading::kBoth && kind != Kind::kRim && (most == 0.0f || least == 1.0f);
      });
    }
  }
  hard::report("looks",
               "patches shown by one level's shading whose vertices call for two, " + std::to_string(single) +
                   " patches",
               "0", std::to_string(wrong));
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(both, 0u);
  EXPECT_LE(needless, both / 10) << "of " << both;
}

TEST_F(GlTest, TheSunGlintsOnlyInPatchesDrawnForIt) {
  const auto surface = views::builtin_planet();
  const Settings settings = Settings::for_detail(32, 1);
  app::accuracy::MeshProbe probe(surface, settings);
  double strongest = 0, shown = 0;
  std::size_t drawn_for_it = 0, all = 0;
  for (std::size_t k = 0; k < (hard::full() ? 120u : 24u); ++k) {
    // Over the sea, toward where the sun is mirrored, from the beach to orbit.
    const double away = 0.02 * static_cast<double>(k % 6);
    const dvec3 sun = glm::normalize(dvec3(1.0, 0.1 + away, 0.02));
    const geo::Geodetic place = geo::degrees_from_normal(glm::normalize(dvec3(1.0, 0.1 - away, 0.02)));
    const double height = 100.0 * std::pow(1e5, static_cast<double>(k / 6 % 4) / 3.0);
    const Camera camera = globe::render::make_camera(
        surface->ellipsoid(), {place.lat_deg, place.lon_deg, height}, 90.0, -40.0, 60.0, 16.0 / 9.0);
    probe.load(camera.position, settings.base_level + 8, {sun, false});
    const DrawList list =
        globe::render::make_draw_list(settings, probe.state(), probe.textures(), surface->ellipsoid(), camera,
                                      {probe.state().target.finest, 0.0f}, false);
    for_each_patch(probe, list, [&](const DrawnPatch& patch) {
      ++all;
      const bool for_glint = patch.batch.look.shading == Shading::kGlint;
      drawn_for_it += for_glint;
      for (int b = 0; b <= settings.m; ++b) {
        for (int a = 0; a + b <= settings.m; ++a) {
          const glm::vec4 vertex = patch.vertex(a, b);
          if (vertex.w > 0.0f) continue;
          const dvec3 at = patch.data.anchor + dvec3(glm::vec3(vertex));
          const dvec3 up = glm::normalize(at);
          if (glm::dot(up, sun) < 0.0) continue;
          const dvec3 half_way = glm::normalize(sun + glm::normalize(camera.position - at));
          const double glint = 0.22 * std::pow(std::max(glm::dot(up, half_way), 0.0), 120.0);
          (for_glint ? shown : strongest) = std::max(for_glint ? shown : strongest, glint);
        }
      }
    });
  }
  hard::report("glint",
               "strongest glint left out, shares of sunlight (" + std::to_string(drawn_for_it) + " of " +
                   std::to_string(all) + " patches drawn for it)",
               "0.001", hard::figure(strongest));
  EXPECT_LE(strongest, 1e-3);
  EXPECT_GT(shown, 0.1);
  EXPECT_LT(drawn_for_it, all / 2);
}

}  // namespace
