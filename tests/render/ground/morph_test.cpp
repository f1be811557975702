// H17: levels turn into each other without a pop.

#include <map>
#include <tuple>

#include "app/accuracy/pop.h"
#include "globe/clipmap/morph.h"
#include "tests/hard/directions.h"
#include "tests/hard/table.h"
#include "tests/render/ground/shader_variant.h"
#include "tests/render/ground/views.h"

namespace {

using app::accuracy::is_odd;
using app::accuracy::MeshProbe;
using app::accuracy::NodeName;
using app::accuracy::on_screen;
using app::accuracy::places;
using globe::clipmap::kSubcell;
using globe::planet::Node;
using views::Camera;
using views::dvec3;

constexpr double kSlack = 0.02;  ///< pixels
constexpr double kPop = 1.0;

dvec3 exact_place(const views::Surface& surface, const Node& node) {
  return globe::geo::ecef_from_normal(surface.ellipsoid(), globe::planet::node_direction(node),
                                      std::max(surface.height(node), 0.0));
}

/// Fine place minus coarse place of an odd node.
dvec3 detail_of(const views::Surface& surface, const Node& node) {
  const auto ends = globe::planet::halved_edge(node.i, node.j);
  return exact_place(surface, node) -
         0.5 * (exact_place(surface, {node.d, node.level, ends[0].x, ends[0].y}) +
                exact_place(surface, {node.d, node.level, ends[1].x, ends[1].y}));
}

struct Worst {
  double beyond_bound = -1e9;  ///< pixels a vertex moved more than the bound
  double vanished = 0;         ///< pixels from its coarse place of a vertex that came or went
  std::size_t vertices = 0;
};

/// Moves the nadir by 1e-3 of the finest ring's width again and again, the eye staying where it is: what
/// moves on the screen then is the morph.
Worst morph_motion(const globe::gl::ShaderReader& reader) {
  const auto surface = views::builtin_planet();
  const auto settings = globe::clipmap::Settings::for_detail(16, 0);
  const globe::clipmap::MorphBand band = globe::clipmap::morph_band(settings);
  MeshProbe probe(surface, settings, reader);
  Worst worst;
  std::mt19937_64 random(17);
  const std::size_t walks = hard::full() ? 24 : 6;
  for (std::size_t walk = 0; walk < walks; ++walk) {
    const auto& place = views::hard_places()[walk * 5 % views::hard_places().size()];
    const int finest = settings.base_level + 3 + static_cast<int>(walk % 4) * 3;
    const double above = surface->root_edge() * settings.s / std::exp2(finest + 0.75);
    globe::geo::Geodetic at{place.lat_deg, place.lon_deg, 0};
    dvec3 u = globe::geo::normal_from_degrees(at.lat_deg, at.lon_deg);
    at.h_m = std::max(surface->height(u, 20), 0.0) + above;
    const Camera camera = globe::render::make_camera(surface->ellipsoid(), at, 0.0, -90.0, 60.0, 16.0 / 9.0);
    const double ring_m = above / 2.0;  // s/2 cells of the finest level
    const dvec3 step = glm::cross(u, hard::random_direction(random)) * (1e-3 * ring_m / globe::geo::kWgs84.a);
    std::map<NodeName, std::pair<Node, dvec3>> before;
    dvec3 u_before = u;
    for (int n = 0; n < (hard::full() ? 40 : 12); ++n) {
      probe.load(globe::geo::ecef_from_normal(surface->ellipsoid(), u, 0.0), finest);
      auto now = places(probe, camera, 0.0f);
      for (const auto& [name, drawn] : before) {
        const auto& [node, was] = drawn;
        const auto found = now.find(name);
        if (!is_odd(node)) continue;
        ++worst.vertices;
        const dvec3 detail = detail_of(*surface, node);
        if (found == now.end()) {
          const dvec3 off = camera.position + was - (exact_place(*surface, node) - detail);
          // a vertex also goes when the finer level takes its place: then it stood at its own
          const double from_own = on_screen(camera.position + was - exact_place(*surface, node), was);
          worst.vanished = std::max(worst.vanished, std::min(on_screen(off, was), from_own));
          continue;
        }
        const auto p = globe::clipmap::nadir(u_before, node.level), q = globe::clipmap::nadir(u, node.level);
        const globe::clipmap::LatticePoint at_node{node.i * kSubcell, node.j * kSubcell};
        const auto moved = std::abs(globe::clipmap::hex_distance(globe::clipmap::images(p, node.d), at_node) -
                                    globe::clipmap::hex_distance(globe::clipmap::images(q, node.d), at_node));
        const double share = static_cast<double>(moved) / static_cast<double>(band.end - band.begin);
        worst.beyond_bound = std::max(
            worst.beyond_bound, on_screen(found->second.second - was, was) - on_screen(detail, was) * share);
      }
      before = std::move(now);
      u_before = u;
      // small steps, and now and then a leap onto the next node of the regions' lattice
      u = glm::normalize(u + step * (n % 4 == 3 ? 300.0 : 1.0));
      if (n % 4 == 3) before.clear();
    }
  }
  return worst;
}

TEST_F(GlTest, H17NoVertexMovesMoreThanTheMorphAllows) {
  const Worst worst = morph_motion(globe::gl::read_shader);
  hard::report("H17", "vertices beyond |fine - coarse| * step / width, " + std::to_string(worst.vertices),
               "0.02 px", hard::figure(std::max(worst.beyond_bound, 0.0)) + " px");
  hard::report("H17", "vertices that come or go, from the edge they come from", "0.02 px",
               hard::figure(worst.vanished) + " px");
  EXPECT_GT(worst.vertices, 10000u);
  EXPECT_LE(worst.beyond_bound, kSlack);
  EXPECT_LE(worst.vanished, kSlack);
}

/// The largest pop where levels are admitted over the hard places, pixels.
double pop(float fade, std::size_t& vertices) {
  const auto settings = globe::clipmap::Settings::for_detail(16, 0);
  MeshProbe probe(views::builtin_planet(), settings);
  app::accuracy::ErrorSum sum;
  for (const auto& place : views::hard_places()) {
    for (const int level : {settings.base_level + 1, settings.base_level + 4, settings.base_level + 9})
      vertices += app::accuracy::add_pops(*views::builtin_planet(), probe, {place.lat_deg, place.lon_deg, 0},
                                          level, fade, sum);
  }
  return sum.figure().max;
}

TEST_F(GlTest, H17ALevelIsAdmittedAndLetGoWithoutAPop) {
  std::size_t vertices = 0;
  const double seen = pop(1.0f, vertices);
  const double off = pop(0.0f, vertices);
  hard::report("H17", "pop where a level is admitted, " + std::to_string(vertices / 2) + " vertices", "1 px",
               hard::figure(seen) + " px");
  hard::report("H17", "negative control: admitted without a fade", "> 1 px", hard::figure(off) + " px");
  EXPECT_LE(seen, kPop);
  EXPECT_GT(off, kPop);
  EXPECT_GT(vertices, 2000u);
}

TEST_F(GlTest, H17NegativeControlWithoutMorphVerticesLeapWhereRingsMeet) {
  const Worst worst = morph_motion(
      views::with_exchange("clipmap.vert", "max(morph_factor(distance, window.y, window.z), slot.offset.w)",
                           "(distance > (window.y + window.z) / 2 ? 1.0 : 0.0)"));
  hard::report("H17", "negative control: morph in one step", "> 0.02 px",
               hard::figure(worst.beyond_bound) + " px");
  EXPECT_GT(worst.beyond_bound, kSlack);
}

TEST(FinestLevel, FadesInFromWhollyCoarseAtTheHeightWhereItIsAdmitted) {
  const auto settings = globe::clipmap::Settings::for_detail(64);
  for (int level = settings.base_level + 1; level <= 26; ++level) {
    const double threshold = 1e7 * settings.s / std::exp2(level);
    const auto above = globe::clipmap::finest_level(settings, 1e7, threshold * (1 + 1e-9), 26);
    const auto below = globe::clipmap::finest_level(settings, 1e7, threshold * (1 - 1e-9), 26);
    EXPECT_EQ(above.level, level - 1);
    EXPECT_EQ(above.fade, 0.0f);
    EXPECT_EQ(below.level, level);
    EXPECT_NEAR(below.fade, 1.0f, 1e-6f);
  }
}

}  // namespace
