// E3, E4, E6: the sea as it is drawn.

#include "app/accuracy/mesh_probe.h"
#include "globe/effects/list.h"
#include "globe/effects/waves.h"
#include "globe/planet/drawn_ground.h"
#include "tests/hard/table.h"
#include "tests/render/ground/topology.h"
#include "tests/render/ground/views.h"

namespace {

using globe::gl::Framebuffer;
using globe::planet::SeaFloor;
using views::Camera;
using views::dvec3;
using views::GlobeRenderer;
using views::Surface;

constexpr int kSeaWidth = 192;
constexpr int kSeaHeight = 108;

std::shared_ptr<const Surface> bare_planet() {
  static const std::shared_ptr<const Surface> planet =
      Surface::builtin(1, Surface::kDefaultCache, 1.0, SeaFloor::kBare);
  return planet;
}

GlobeRenderer renderer_with(const std::string& effects) {
  const auto scene = globe::scene::parse_scene("planet = \"procedural\"\n[camera]\nat = \"0,0\"\n" + effects,
                                               "s.toml", globe::effects::effect_kinds());
  globe::render::RenderSettings settings;
  settings.clipmap = globe::clipmap::Settings::for_detail(32);
  return {bare_planet(), settings, globe::effects::make_effects(scene, *bare_planet())};
}

/// An island with a coast on all sides.
constexpr double kSeaLat = -42.93, kSeaLon = -109.31;
/// Far from any.
constexpr double kOffLat = -43.3, kOffLon = -110.6;

Camera camera_at(double lat_deg, double lon_deg, double h_m, double pitch_deg) {
  return globe::render::make_camera(globe::geo::kWgs84, {lat_deg, lon_deg, h_m}, 70.0, pitch_deg, 50.0,
                                    static_cast<double>(kSeaWidth) / kSeaHeight);
}

dvec3 morning(const Camera& camera) {
  const dvec3 up = glm::normalize(camera.position);
  return glm::normalize(up + glm::normalize(glm::cross(up, dvec3(0.3, 0.5, 0.8))));
}

std::vector<std::uint8_t> picture(GlobeRenderer& renderer, const Camera& camera, double time_s,
                                  const Framebuffer& target) {
  renderer.set_instant({time_s});
  renderer.draw(camera, morning(camera), true, target);
  return target.read_rgba8();
}

TEST_F(GlTest, TheSeaAfterTwoSecondsIsTheSameAtTenAndAtSixtyFramesASecond) {
  const Framebuffer target(kSeaWidth, kSeaHeight, {});
  const Camera camera = camera_at(kOffLat, kOffLon, 12.0, -8.0);
  std::vector<std::vector<std::uint8_t>> ends;
  for (const int fps : {10, 60, 0}) {
    GlobeRenderer renderer = renderer_with("[effects.sea]\n[effects.underwater]\n");
    for (int k = 0; k < 2 * fps; ++k) picture(renderer, camera, static_cast<double>(k) / fps, target);
    ends.push_back(picture(renderer, camera, 2.0, target));
    EXPECT_TRUE(renderer.effect_states()[0].verdict.active);
    EXPECT_EQ(renderer.effect_states()[1].verdict.why, "the eye is above the water");
    if (fps == 0) {
      EXPECT_NE(picture(renderer, camera, 3.0, target), ends[0]) << "waves do not move";
    }
  }
  EXPECT_EQ(ends[0], ends[1]);
  EXPECT_EQ(ends[0], ends[2]);
}

TEST_F(GlTest, InlandTheSeaHasNothingToDo) {
  const Framebuffer target(kSeaWidth, kSeaHeight, {});
  GlobeRenderer renderer = renderer_with("[effects.sea]\n");
  const Camera camera = camera_at(-43.42, -106.43, 3000.0, -90.0);
  picture(renderer, camera, 0.0, target);
  EXPECT_FALSE(renderer.effect_states()[0].verdict.active);
  EXPECT_EQ(renderer.effect_states()[0].verdict.why, "no water in view");
}

TEST_F(GlTest, UnderWaterThePictureIsTheWaters) {
  const Framebuffer target(kSeaWidth, kSeaHeight, {});
  GlobeRenderer renderer = renderer_with("[effects.sea]\n[effects.underwater]\nvisibility = 5\n");
  const std::vector<std::uint8_t> deep =
      picture(renderer, camera_at(kOffLat, kOffLon, -8.0, 0.0), 0.0, target);
  EXPECT_EQ(renderer.effect_states()[1].verdict.why, "the eye is under water");
  EXPECT_EQ(renderer.effect_states()[0].verdict.why, "the eye is under it");
  std::size_t blue = 0;
  for (std::size_t k = 0; k < deep.size(); k += 4) blue += deep[k + 2] > deep[k] ? 1 : 0;
  EXPECT_GT(blue, deep.size() / 4 * 95 / 100);
  const std::vector<std::uint8_t> deeper =
      picture(renderer, camera_at(kOffLat, kOffLon, -25.0, 0.0), 0.0, target);
  const auto middle = static_cast<std::size_t>((kSeaHeight / 2 * kSeaWidth + kSeaWidth / 2) * 4 + 1);
  EXPECT_LT(deeper[middle], deep[middle]) << "light does not fall with depth";
}

/// The sea as murk of one colour over a flat sea: what shows it, and where the heights say it is.
TEST_F(GlTest, TheCoastIsWhereHeightsAreZero) {
  const Framebuffer target(kSeaWidth, kSeaHeight, {});
  GlobeRenderer renderer =
      renderer_with("[effects.sea]\nwind_speed = 0\ncolor = \"ff00ff\"\nclarity = 0.1\nfoam = false\n");
  std::size_t pixels = 0, wrong = 0, far = 0;
  for (const double h : {1500.0, 6000.0, 25000.0}) {
    const Camera camera = camera_at(kSeaLat, kSeaLon, h, -90.0);
    const std::vector<std::uint8_t> seen = picture(renderer, camera, 0.0, target);
    const int level = renderer.frame_stats().finest_level;
    std::vector<bool> wet(static_cast<std::size_t>(kSeaWidth * kSeaHeight)), drawn(wet.size());
    for (int y = 0; y < kSeaHeight; ++y) {
      for (int x = 0; x < kSeaWidth; ++x) {
        const dvec3 ray =
            views::ray(camera, (2.0 * x + 1.0) / kSeaWidth - 1.0, 1.0 - (2.0 * y + 1.0) / kSeaHeight);
        const double away = globe::geo::ray_ellipsoid(globe::geo::kWgs84, 0.0, camera.position, ray);
        const auto place = globe::geo::geodetic_from_ecef(globe::geo::kWgs84, camera.position + ray * away);
        const std::size_t k = static_cast<std::size_t>(y * kSeaWidth + x);
        wet[k] =
            bare_planet()->height(globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg), level) < 0.0;
        drawn[k] = seen[4 * k] > seen[4 * k + 1] + 40 && seen[4 * k + 2] > seen[4 * k + 1] + 40;
      }
    }
    for (int y = 2; y < kSeaHeight - 2; ++y) {
      for (int x = 2; x < kSeaWidth - 2; ++x) {
        const std::size_t k = static_cast<std::size_t>(y * kSeaWidth + x);
        ++pixels;
        if (wet[k] == drawn[k]) continue;
        ++wrong;
        bool near = false;  // the coast within a pixel
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx)
            near = near ||
                   wet[k + static_cast<std::size_t>(dy * kSeaWidth + dx + 2 * kSeaWidth) - 2 * kSeaWidth] !=
                       wet[k];
        }
        far += near ? 0 : 1;
      }
    }
  }
  hard::report(
      "E3",
      "sea drawn where heights are not below 0 or the reverse, more than a pixel from the coast, of " +
          std::to_string(pixels) + " px",
      "< 1 %", std::to_string(far));
  hard::report("E3", "the same with the coast's own pixels", "< 3 %", std::to_string(wrong));
  EXPECT_LT(far, pixels / 100);
  EXPECT_LT(wrong, pixels * 3 / 100);
}

/// Mirrors `Sea` in shaders/effects/sea_block.glsl.
struct SeaBlock {
  glm::vec4 level{0.0f}, color{0.0f}, dimming{0.0f};
  std::array<glm::vec4, 40> along{}, form{};
};

TEST_F(GlTest, TheMeshOfTheSeaIsClosedAndStandsAtTheWavesHeights) {
  const globe::gl::ShaderReader reader = [](const std::string& name) {
    auto text = globe::gl::read_shader(name);
    if (name == "clipmap.vert") text = "#define SEA\n#define SEA_BLOCK 2\n#define MAX_WAVES 40\n" + *text;
    return text;
  };
  const globe::clipmap::Settings settings = globe::clipmap::Settings::for_detail(16, 0);
  app::accuracy::MeshProbe probe(bare_planet(), settings, reader);
  const globe::effects::Sea sea(globe::geo::kWgs84, {kOffLat, kOffLon, 0.0},
                                globe::effects::wind_waves(15.0, 250.0));
  std::size_t open = 0, edges = 0, raised = 0;
  for (const auto& [lat, lon] : {std::pair{kSeaLat, kSeaLon}, std::pair{kOffLat, kOffLon}}) {
    for (const double h : {9.0, 60.0, 2000.0}) {
      const Camera camera = camera_at(lat, lon, h, -20.0);
      SeaBlock block;
      block.level = {static_cast<float>(sea.waves().size()), static_cast<float>(sea.radius_m()),
                     static_cast<float>(sea.amplitudes_m()), 0.0f};
      for (std::size_t k = 0; k < sea.waves().size(); ++k) {
        const auto local = sea.at(k, sea.foot(camera.position), 1.5);
        block.along[k] = glm::vec4(glm::dvec4(local.along, 6.283185307179586 / sea.waves()[k].wavelength_m));
        block.form[k] = glm::vec4(glm::dvec4(sea.waves()[k].amplitude_m, local.phase, local.cotangent, 0.0));
      }
      const globe::gl::Buffer buffer(sizeof block, &block);
      buffer.bind_base(GL_UNIFORM_BUFFER, 2);
      probe.load(camera.position,
                 globe::clipmap::finest_level(settings, bare_planet()->root_edge(), h, 26).level);
      for (const float fade : {0.0f, 0.5f}) {
        const auto triangles = probe.triangles(camera, fade, app::accuracy::MeshProbe::Space::kRelative);
        const views::Topology mesh = views::topology(triangles);
        open += mesh.open_edges;
        edges += mesh.edges;
        for (const auto& vertex : triangles) {
          const dvec3 place = camera.position + dvec3(vertex.seen);
          if (std::abs(globe::geo::geodetic_from_ecef(globe::geo::kWgs84, place).h_m) > 0.3) ++raised;
        }
      }
    }
  }
  hard::report(
      "E4", "edges of the sea's mesh not used exactly twice, read back, " + std::to_string(edges) + " edges",
      "0", std::to_string(open));
  EXPECT_EQ(open, 0u);
  EXPECT_GT(raised, 100u) << "waves do not raise the mesh";
}

}  // namespace
