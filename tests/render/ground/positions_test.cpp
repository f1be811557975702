// --positions: each way to place vertices errs by what it should, and draws the same ground.

#include <array>

#include "app/accuracy/position_error.h"
#include "tests/hard/table.h"
#include "tests/render/ground/tour.h"
#include "tests/render/ground/views.h"

namespace {

using app::accuracy::MeshProbe;
using app::accuracy::Sighting;
using globe::clipmap::Positions;
using globe::clipmap::Settings;
using views::Surface;

constexpr double kHighest = 9000.0;    ///< of the built-in planet, metres
constexpr double kMaxPixels = 0.1;     ///< what H1 asks of the default
constexpr double kParabola = 0.1;      ///< third-order rest of a patch's parabola over c³/R²; 0.07 seen
constexpr double kRounding = 0x1p-23;  ///< two roundings to fp32

constexpr std::array kModes{Positions::kExact, Positions::kQuadratic, Positions::kChord, Positions::kFloat32};

std::string word_of(Positions positions) { return std::string(globe::clipmap::name_of(positions)); }

Settings settings_for(int detail, Positions positions) {
  Settings settings = Settings::for_detail(detail, 0);
  settings.positions = positions;
  return settings;
}

/// How far a vertex may be off, metres. Of chords, their sag, c²/2R, c being the circumradius of the largest
/// patch of its level (edge 1.56 times 2^-level of a root's for each cell); of parabolas their third-order
/// rest; heights along what the normals between corners lack in length; and what fp32 rounds.
double bound(const Settings& settings, const Surface& surface, const Sighting& sighting) {
  const int level = sighting.vertex.node.level - (sighting.vertex.on_rim ? 1 : 0);
  const double radius = surface.ellipsoid().b() * surface.ellipsoid().b() / surface.ellipsoid().a;
  const double cell = std::ldexp(1.56 * surface.root_edge(), -level);
  const double window = std::min(4.0 * cell * settings.s, 2.0 * surface.ellipsoid().a);
  const double rounded = (window + glm::length(sighting.truth)) * kRounding;
  const double c = cell * settings.m / std::sqrt(3.0);
  const double sag = c * c / (2.0 * radius);
  const double heights = kHighest * (sag / radius + 2.0 * kRounding);
  switch (settings.positions) {
    case Positions::kExact:
      return rounded;
    case Positions::kQuadratic:
      return kParabola * c * c * c / (radius * radius) + heights + rounded;
    case Positions::kChord:
      return sag + heights + rounded;
    case Positions::kFloat32:
      break;
  }
  return 4.0 * (surface.ellipsoid().a + glm::length(sighting.truth)) * kRounding;
}

struct PositionsErrors {
  double worst_px = 0, sum_px2 = 0, worst_m = 0, sum_m2 = 0;
  double worst_share = 0;  ///< of its bound
  std::size_t count = 0;

  void add(const Sighting& sighting, double bound_m) {
    worst_px = std::max(worst_px, sighting.off_px);
    worst_m = std::max(worst_m, sighting.off_m);
    sum_px2 += sighting.off_px * sighting.off_px;
    sum_m2 += sighting.off_m * sighting.off_m;
    worst_share = std::max(worst_share, sighting.off_m / bound_m);
    ++count;
  }
  std::string text() const {
    const double n = static_cast<double>(count);
    return hard::figure(worst_m) + " m, RMS " + hard::figure(std::sqrt(sum_m2 / n)) + " m; " +
           hard::figure(worst_px) + " px, RMS " + hard::figure(std::sqrt(sum_px2 / n)) + " px";
  }
};

/// By the camera's height above ground.
struct Band {
  std::string name;
  double below_m;
};
const std::array<Band, 3> kBands{
    {{"below 100 m", 100.0}, {"100 m to 100 km", 1e5}, {"100 km to 100,000 km", 1e9}}};

std::array<PositionsErrors, 3> errors_of(const Settings& settings) {
  const auto surface = views::builtin_planet();
  MeshProbe probe(surface, settings);
  std::array<PositionsErrors, 3> errors;
  std::mt19937_64 random(10);
  const std::size_t cameras = hard::full() ? 90 : 12;
  for (std::size_t k = 0; k < cameras; ++k) {
    const auto [camera, above] = views::tour_stop(*surface, k, cameras, random);
    const std::size_t band = above < kBands[0].below_m ? 0 : above < kBands[1].below_m ? 1 : 2;
    app::accuracy::see_vertices(*surface, probe, camera, above, 2000, [&](const Sighting& s) {
      if (app::accuracy::is_hidden(*surface, camera, s.truth)) return;
      errors[band].add(s, bound(settings, *surface, s));
    });
  }
  return errors;
}

TEST_F(GlTest, H1EachWayToPlaceVerticesErrsByWhatItShould) {
  std::array<std::array<PositionsErrors, 3>, 4> seen;
  for (std::size_t mode = 0; mode < kModes.size(); ++mode) {
    seen[mode] = errors_of(settings_for(hard::full() ? 64 : 32, kModes[mode]));
    double share = 0;
    for (std::size_t band = 0; band < kBands.size(); ++band) {
      const PositionsErrors& errors = seen[mode][band];
      share = std::max(share, errors.worst_share);
      EXPECT_GT(errors.count, 1000u) << word_of(kModes[mode]);
      hard::report("H1", "--positions " + word_of(kModes[mode]) + ", cameras " + kBands[band].name,
                   "its bound", errors.text());
    }
    hard::report("H1", "--positions " + word_of(kModes[mode]) + ", largest share of its bound", "1",
                 hard::figure(share));
    EXPECT_LE(share, 1.0) << word_of(kModes[mode]);
    EXPECT_GT(share, 0.1) << word_of(kModes[mode]) << ": the bound says nothing";
  }
  const auto& [exact, quadratic, chord, float32] = seen;
  for (const PositionsErrors& errors : exact) EXPECT_LE(errors.worst_px, kMaxPixels);
  EXPECT_GT(float32[0].worst_px, kMaxPixels);  // jitters at the ground
  EXPECT_GT(chord[2].worst_px, kMaxPixels);    // an angular planet, seen from orbit
  EXPECT_LT(quadratic[2].worst_m, chord[2].worst_m / 10.0);
}

TEST(Positions, AreNamedAsTheCommandLineHasThem) {
  for (const Positions mode : kModes) EXPECT_EQ(globe::clipmap::positions_by_name(word_of(mode)), mode);
  EXPECT_EQ(globe::clipmap::positions_by_name("Exact"), std::nullopt);
  EXPECT_EQ(globe::clipmap::positions_by_name(""), std::nullopt);
}

TEST_F(GlTest, ThePlacesOnTheCpuAreThoseTheShaderInterpolates) {
  const auto surface = views::builtin_planet();
  for (const Positions mode : kModes) {
    const Settings settings = settings_for(16, mode);
    MeshProbe probe(surface, settings);
    std::size_t different = 0, compared = 0;
    for (const auto& place : views::hard_places()) {
      const auto camera = globe::render::make_camera(
          surface->ellipsoid(), {place.lat_deg, place.lon_deg, 20000.0}, 0.0, -90.0, 60.0, 16.0 / 9.0);
      probe.load(camera.position, settings.base_level + 8);
      for (const auto& v : probe.triangles(camera, 0.0f, MeshProbe::Space::kRelative)) {
        if (v.on_rim || v.kind != globe::render::Kind::kPlain) continue;
        const auto& data =
            *probe.state().levels[static_cast<std::size_t>(v.node.level - settings.base_level)];
        const auto& rect = data.vertices[static_cast<std::size_t>(v.node.d)];
        const std::size_t index =
            static_cast<std::size_t>(v.node.j - rect.j0) * static_cast<std::size_t>(rect.width()) +
            static_cast<std::size_t>(v.node.i - rect.i0);
        const glm::vec3 offset(data.anchor - camera.position);
        const glm::vec3 expected =
            glm::vec3(data.positions[static_cast<std::size_t>(v.node.d)][index]) + offset;
        different += expected == glm::vec3(v.seen) ? 0 : 1;
        ++compared;
      }
    }
    hard::report("positions",
                 word_of(mode) + ": vertices off the CPU's places, of " + std::to_string(compared), "0",
                 std::to_string(different));
    EXPECT_EQ(different, 0u) << word_of(mode);
    EXPECT_GT(compared, 10000u);
  }
}

}  // namespace
