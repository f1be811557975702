// H15: the triangles the GPU draws are one closed surface. H3: every pass and program has them in the same
// place.

#include "app/accuracy/mesh_probe.h"
#include "tests/hard/table.h"
#include "tests/render/ground/shader_variant.h"
#include "tests/render/ground/topology.h"
#include "tests/render/ground/views.h"

namespace {

using app::accuracy::MeshProbe;
using globe::clipmap::Positions;
using globe::clipmap::Settings;
using views::Camera;
using views::Place;
using views::topology;
using views::Topology;

Camera camera_at(const Place& place, double h_m) {
  return globe::render::make_camera(globe::geo::kWgs84, {place.lat_deg, place.lon_deg, h_m}, 30.0, -40.0,
                                    60.0, 16.0 / 9.0);
}

struct Sum {
  std::size_t open_edges = 0, edges = 0, frames = 0, not_a_sphere = 0;
};

/// Frames over the places: levels up to three depths, with and without fade, the nadir off the nodes.
Sum meshes(const Settings& settings, const globe::gl::ShaderReader& reader, std::size_t places) {
  Sum sum;
  MeshProbe probe(views::builtin_planet(), settings, reader);
  for (std::size_t p = 0; p < places; ++p) {
    const Place& place = views::hard_places()[p * views::hard_places().size() / places];
    for (const int above_base : {0, 2, 5, 11}) {
      // as high above the sea as the level is made for, at least over all ground
      const double h =
          views::mid_fade_height(settings, *views::builtin_planet(), settings.base_level + above_base);
      const Camera camera = camera_at(place, h + 9000.0);
      probe.load(camera.position, settings.base_level + above_base);
      for (const float fade : {0.0f, 0.5f}) {
        const Topology mesh = topology(probe.triangles(camera, fade, MeshProbe::Space::kRelative));
        sum.open_edges += mesh.open_edges;
        sum.edges += mesh.edges;
        sum.not_a_sphere += mesh.euler != 2 ? 1 : 0;
        ++sum.frames;
      }
    }
  }
  return sum;
}

class H15 : public GlTest, public testing::WithParamInterface<int> {};

TEST_P(H15, TheMeshReadBackFromTheGpuIsClosed) {
  const Sum sum = meshes(Settings::for_detail(GetParam(), 0), globe::gl::read_shader,
                         hard::full() || GetParam() == 16 ? 12 : 4);
  hard::report("H15",
               "edges not used exactly twice, read back, detail " + std::to_string(GetParam()) + ", " +
                   std::to_string(sum.frames) + " frames, " + std::to_string(sum.edges) + " edges",
               "0", std::to_string(sum.open_edges));
  hard::report("H15", "frames with V - E + F other than 2, detail " + std::to_string(GetParam()), "0",
               std::to_string(sum.not_a_sphere));
  EXPECT_EQ(sum.open_edges, 0u);
  EXPECT_EQ(sum.not_a_sphere, 0u);
}

INSTANTIATE_TEST_SUITE_P(Details, H15, testing::Values(16, 64));

TEST_F(GlTest, H15TheMeshIsClosedHoweverVerticesArePlaced) {
  for (const Positions positions : {Positions::kQuadratic, Positions::kChord, Positions::kFloat32}) {
    Settings settings = Settings::for_detail(16, 0);
    settings.positions = positions;
    const Sum sum = meshes(settings, globe::gl::read_shader, hard::full() ? 12 : 4);
    hard::report("H15",
                 "edges not used exactly twice, --positions " +
                     std::string(globe::clipmap::name_of(positions)) + ", " + std::to_string(sum.frames) +
                     " frames, " + std::to_string(sum.edges) + " edges",
                 "0", std::to_string(sum.open_edges));
    EXPECT_EQ(sum.open_edges, 0u);
    EXPECT_EQ(sum.not_a_sphere, 0u);
  }
}

TEST_F(GlTest, H15TheMeshIsClosedWithoutMorphing) {
  Settings settings = Settings::for_detail(16, 0);
  settings.morph = false;
  const Sum sum = meshes(settings, globe::gl::read_shader, hard::full() ? 12 : 4);
  hard::report("H15", "edges not used exactly twice, --morph off, " + std::to_string(sum.edges) + " edges",
               "0", std::to_string(sum.open_edges));
  EXPECT_EQ(sum.open_edges, 0u);
  EXPECT_EQ(sum.not_a_sphere, 0u);
}

TEST_F(GlTest, H15NegativeControlKnotsOfTheFinePatchOpenTheRim) {
  Settings settings = Settings::for_detail(16, 0);
  settings.positions = Positions::kChord;
  const Sum sum =
      meshes(settings,
             views::with_exchange("lib/interpolated_vertices.glsl", "int turn = odd.x + odd.y == 1",
                                  "int turn = odd.x + odd.y != 1"),
             2);
  hard::report("H15",
               "negative control: rims by another coarse patch, " + std::to_string(sum.edges) + " edges",
               "> 0", std::to_string(sum.open_edges));
  EXPECT_GT(sum.open_edges, 0u);
}

TEST_F(GlTest, H15NegativeControlRimsNotTakenFromTheCoarserLevelAreOpen) {
  const Sum sum = meshes(Settings::for_detail(16, 0),
                         views::with_exchange("clipmap.vert", "if (on_rim(ab))", "if (false)"), 2);
  hard::report("H15", "negative control: stitching off, " + std::to_string(sum.edges) + " edges", "> 0",
               std::to_string(sum.open_edges));
  EXPECT_GT(sum.open_edges, 0u);
}

/// Vertices of one view that lie elsewhere when every patch goes through the program for rims.
std::size_t moved_by_the_other_program(const globe::gl::ShaderReader& reader) {
  const auto settings = Settings::for_detail(16, 0);
  std::size_t moved = 0;
  for (const Place& place : views::hard_places()) {
    MeshProbe probe(views::builtin_planet(), settings, reader);
    const Camera camera = camera_at(place, 9000.0);
    probe.load(camera.position, settings.base_level + 10);
    const auto first = probe.triangles(camera, 0.0f, MeshProbe::Space::kClip);
    const auto second = probe.triangles(camera, 0.0f, MeshProbe::Space::kClip, true);
    for (std::size_t k = 0; k < first.size(); ++k) {
      if (first[k].node.level == settings.base_level) continue;  // never drawn by another program
      moved += std::memcmp(&first[k].seen, &second[k].seen, sizeof(glm::vec4)) == 0 ? 0 : 1;
    }
    if (!hard::full() && &place - views::hard_places().data() == 3) break;
  }
  return moved;
}

TEST_F(GlTest, H3EveryProgramPutsAVertexOnTheSameBits) {
  const std::size_t moved = moved_by_the_other_program(globe::gl::read_shader);
  hard::report("H3", "vertices that the programs for plain and for rim patches place differently", "0",
               std::to_string(moved));
  EXPECT_EQ(moved, 0u);
}

TEST_F(GlTest, H3NegativeControlATransformInTwoStepsDiffers) {
  const std::size_t moved = moved_by_the_other_program(views::with_exchange(
      "clipmap.vert", "precise vec4 clip = view.clip_from_relative * vec4(position, 1.0);",
      "#ifdef RIM\n"
      "  vec4 clip = view.clip_from_relative * vec4(position - slot.offset.xyz, 1.0) +\n"
      "              view.clip_from_relative * vec4(slot.offset.xyz, 0.0);\n"
      "#else\n"
      "  precise vec4 clip = view.clip_from_relative * vec4(position, 1.0);\n"
      "#endif\n"));
  hard::report("H3", "negative control: one program projects the offset by itself", "> 0",
               std::to_string(moved));
  EXPECT_GT(moved, 0u);
}

}  // namespace
