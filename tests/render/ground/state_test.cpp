// H24: the same camera, the same bytes. H18: however the windows were filled. Memory.

#include <tbb/global_control.h>

#include <random>

#include "tests/hard/directions.h"
#include "tests/hard/table.h"
#include "tests/render/ground/resident.h"
#include "tests/render/ground/shader_variant.h"
#include "tests/render/ground/views.h"

namespace {

using globe::clipmap::Positions;
using globe::clipmap::Settings;
using globe::clipmap::Windows;
using globe::gl::Framebuffer;
using globe::render::ClipmapTextures;
using globe::render::FrameStats;
using views::Camera;
using views::dvec3;
using views::GlobeRenderer;
using views::Place;
using views::RenderSettings;

using Bytes = std::vector<std::uint8_t>;

RenderSettings full_settings() {
  RenderSettings settings;
  settings.clipmap = Settings::for_detail(16, 2);
  return settings;
}

Bytes picture_of(GlobeRenderer& renderer, const Camera& camera, const Framebuffer& picture) {
  renderer.draw(camera, glm::normalize(dvec3(camera.position) + 3e6), true, picture);
  return picture.read_rgba8();
}

std::vector<Camera> tour(const GlobeRenderer& renderer, std::size_t count) {
  std::vector<Camera> cameras;
  for (std::size_t k = 0; k < count; ++k) {
    const Place& place = views::hard_places()[k * 7 % views::hard_places().size()];
    const double above = 3.0 * std::pow(1e6, static_cast<double>(k * 5 % count) / static_cast<double>(count));
    cameras.push_back(views::camera_above(renderer, *views::builtin_planet(), place, above, 50.0 * double(k),
                                          -15.0 - 7.0 * static_cast<double>(k % 8)));
  }
  return cameras;
}

std::size_t different(const Bytes& a, const Bytes& b) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < a.size(); ++k) count += a[k] == b[k] ? 0 : 1;
  return count;
}

TEST_F(GlTest, H24TheSameCameraGivesTheSameBytes) {
  const auto surface = views::builtin_planet();
  const Framebuffer picture(320, 180);
  GlobeRenderer travelled(surface, full_settings());
  std::size_t twice = 0, back = 0, one_thread = 0, pictures = 0;
  for (const Camera& camera : tour(travelled, hard::full() ? 24 : 5)) {
    const Bytes first = picture_of(travelled, camera, picture);
    twice += different(first, picture_of(travelled, camera, picture));
    GlobeRenderer fresh(surface, full_settings());
    back += different(first, picture_of(fresh, camera, picture));
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    GlobeRenderer alone(views::Surface::builtin(1), full_settings());
    one_thread += different(first, picture_of(alone, camera, picture));
    ++pictures;
  }
  const std::string of = ", " + std::to_string(pictures) + " pictures";
  hard::report("H24", "bytes that differ between two frames of one camera" + of, "0", std::to_string(twice));
  hard::report("H24", "bytes that differ after flying elsewhere and back, against a fresh renderer" + of, "0",
               std::to_string(back));
  hard::report("H24", "bytes that differ with one thread and a planet made anew" + of, "0",
               std::to_string(one_thread));
  EXPECT_EQ(twice, 0u);
  EXPECT_EQ(back, 0u);
  EXPECT_EQ(one_thread, 0u);
}

TEST_F(GlTest, H12PicturesAreTheSameWithoutCulling) {
  const auto surface = views::builtin_planet();
  const Framebuffer picture(320, 180);
  for (const auto positions : {Positions::kExact, Positions::kChord}) {
    RenderSettings settings = full_settings();
    settings.clipmap = Settings::for_detail(32, 1);
    settings.clipmap.positions = positions;
    GlobeRenderer culled(surface, settings);
    settings.cull_patches = false;
    GlobeRenderer whole(surface, settings);
    std::size_t different_bytes = 0, drawn = 0, all = 0;
    const auto cameras = tour(culled, hard::full() ? 60 : 7);
    for (const Camera& camera : cameras) {
      const dvec3 sun = glm::normalize(camera.position);
      drawn += culled.draw(camera, sun, true, picture).patches;
      const Bytes first = picture.read_rgba8();
      all += whole.draw(camera, sun, true, picture).patches;
      different_bytes += different(first, picture.read_rgba8());
    }
    hard::report("H12",
                 "bytes of pictures that culling changes, --positions " +
                     std::string(globe::clipmap::name_of(positions)) + ", " + std::to_string(cameras.size()) +
                     " pictures, " + std::to_string(drawn) + " of " + std::to_string(all) + " patches drawn",
                 "0", std::to_string(different_bytes));
    EXPECT_EQ(different_bytes, 0u);
    EXPECT_LT(drawn, all / 2);
  }
}

struct Walked {
  std::size_t different_texels = 0, texels = 0, moves = 0;
};

/// Walks from every stride-th of the hard places.
Walked walk(const Settings& settings, std::size_t stride) {
  const auto surface = views::builtin_planet();
  std::mt19937_64 random(18);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Walked sum;
  for (std::size_t p = 0; p < views::hard_places().size(); p += stride) {
    const Place& place = views::hard_places()[p];
    ClipmapTextures walked(settings);
    std::shared_ptr<const globe::clipmap::ClipmapState> state;
    dvec3 u = globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg);
    for (std::size_t k = 0; k < (hard::full() ? 40u : 8u); ++k, ++sum.moves) {
      // steps of a cell of some level, in places far beyond every window
      const double reach = std::exp2(-22.0 * unit(random));
      u = glm::normalize(u + hard::random_direction(random) * (k % 5 == 4 ? 0.7 : reach));
      if (k % 4 == 2) u = globe::geo::normal_from_degrees(place.lat_deg, place.lon_deg);
      const dvec3 sun = glm::normalize(dvec3(1.0, static_cast<double>(k / 3), 0.5));  // it moves now and then
      const globe::clipmap::Target target{
          u, settings.base_level + 3 + static_cast<int>(random() % 14), {sun, false}};
      auto update =
          globe::clipmap::advance(settings, *surface, target, state.get(), globe::clipmap::Stride::kWhole);
      state = update.state;
      walked.apply(std::move(update));
      ClipmapTextures fresh(settings);
      auto refill =
          globe::clipmap::advance(settings, *surface, target, nullptr, globe::clipmap::Stride::kWhole);
      const auto refilled = refill.state;
      fresh.apply(std::move(refill));
      for (std::size_t l = 0; l < refilled->levels.size(); ++l) {
        EXPECT_EQ(state->levels[l]->anchor, refilled->levels[l]->anchor);
        EXPECT_EQ(state->levels[l]->vertices, refilled->levels[l]->vertices);
        EXPECT_EQ(state->levels[l]->shading, refilled->levels[l]->shading);
      }
      if (k % 4 == 3 || k + 1 == 8) {
        const views::Resident seen = views::resident(settings, *refilled, walked);
        sum.different_texels += seen.differing(views::resident(settings, *refilled, fresh));
        sum.texels += seen.size();
      }
    }
  }
  return sum;
}

/// Ways to store vertices, and how many of the hard places to walk from for each.
struct Storage {
  Positions positions;
  Windows windows;
  std::size_t stride;

  Settings settings(int detail, int shading_levels) const {
    Settings result = Settings::for_detail(detail, shading_levels);
    result.positions = positions;
    result.windows = windows;
    return result;
  }
  std::string text() const {
    return "--positions " + std::string(name_of(positions)) + " --window " + std::string(name_of(windows));
  }
};
constexpr std::array kStorages{Storage{Positions::kExact, Windows::kPlain, 1},
                               Storage{Positions::kQuadratic, Windows::kPlain, 4},
                               Storage{Positions::kExact, Windows::kHexagon, 3}};

TEST_F(GlTest, H18WindowsAfterAnyWalkHoldWhatARefillWould) {
  for (const Storage& storage : kStorages) {
    const Walked sum = walk(storage.settings(16, 1), hard::full() ? 1 : storage.stride);
    hard::report("H18",
                 "texels that differ from a refill after walks of " + std::to_string(sum.moves) + " moves, " +
                     storage.text() + ", " + std::to_string(sum.texels),
                 "0", std::to_string(sum.different_texels));
    EXPECT_EQ(sum.different_texels, 0u);
  }
}

/// Bytes of pictures that differ between plain windows and hexagons, seen on a tour of both.
std::size_t changed_by_hexagons(int detail, std::size_t cameras, const Settings& hexagon) {
  const auto surface = views::builtin_planet();
  const Framebuffer picture(320, 180);
  RenderSettings settings = full_settings();
  settings.clipmap = Settings::for_detail(detail, 0);
  GlobeRenderer plain(surface, settings);
  settings.clipmap = hexagon;
  GlobeRenderer packed(surface, settings);
  std::size_t different_bytes = 0;
  for (const Camera& camera : tour(plain, cameras)) {
    Camera walking = camera;
    for (int step = 0; step < 3; ++step) {  // and on from there, by steps of some level
      const Bytes first = picture_of(plain, walking, picture);
      different_bytes += different(first, picture_of(packed, walking, picture));
      walking.position += (camera.right + camera.forward * 0.3) * 0.02 * glm::length(camera.position) *
                          std::exp2(-5.0 * step);
    }
  }
  return different_bytes;
}

TEST_F(GlTest, HexagonsShowTheSamePicturesBitForBit) {
  for (const int detail : {16, 28}) {
    Settings hexagon = Settings::for_detail(detail, 0);
    hexagon.windows = Windows::kHexagon;
    const std::size_t cameras = hard::full() ? 48 : 4;
    const std::size_t different_bytes = changed_by_hexagons(detail, cameras, hexagon);
    hard::report("windows",
                 "bytes of pictures that hexagons change, detail " + std::to_string(detail) + ", " +
                     std::to_string(3 * cameras) + " pictures",
                 "0", std::to_string(different_bytes));
    EXPECT_EQ(different_bytes, 0u);
  }
}

TEST_F(GlTest, HexagonsNegativeControlAnotherShiftShowsOtherPictures) {
  const views::ShaderVariant shifted("lib/clipmap.glsl", "texel.x - wraps * brick.z",
                                     "texel.x - wraps * (brick.z - 1)");
  Settings hexagon = Settings::for_detail(16, 0);
  hexagon.windows = Windows::kHexagon;
  const std::size_t different_bytes = changed_by_hexagons(16, 3, hexagon);
  hard::report("windows", "negative control: bricks shifted by one texel less, bytes", "> 0",
               std::to_string(different_bytes));
  EXPECT_GT(different_bytes, 0u);
}

std::size_t layer_formula(const Settings& settings) {
  const auto w = static_cast<std::size_t>(settings.window());
  const std::size_t shading = w << settings.shading_levels;
  const std::size_t knots = w / static_cast<std::size_t>(settings.knot_step());
  const auto side = static_cast<std::size_t>(settings.s + 3 * settings.m / 2 - 1);
  const std::size_t texels = settings.windows == Windows::kHexagon ? (3 * side + 1) * (side + 1) : w * w;
  const bool interpolated = globe::clipmap::is_interpolated(settings.positions);
  return (interpolated ? 4 * texels + 2 * 16 * knots * knots : 2 * 16 * texels) + 5 * shading * shading;
}

TEST_F(GlTest, ClipmapMemoryIsWhatItsFormulaSays) {
  const auto surface = views::builtin_planet();
  const Framebuffer picture(64, 36);
  GlobeRenderer renderer(surface, full_settings());
  const std::size_t layer = layer_formula(full_settings().clipmap);
  std::size_t most = 0;
  for (const Camera& camera : tour(renderer, 10)) {
    renderer.draw(camera, dvec3(1, 0, 0), true, picture);
    const ClipmapTextures& textures = renderer.textures();
    EXPECT_EQ(textures.layer_bytes(), layer);
    EXPECT_EQ(textures.vertex_layers(), textures.shading_layers());
    EXPECT_EQ(textures.bytes(), layer * static_cast<std::size_t>(textures.vertex_layers()));
    most = std::max(most, textures.bytes());
  }
  hard::report(
      "memory",
      "bytes of the clipmap's textures in a flight, detail 16, against layers * (32 w^2 + 5 (4w)^2)", "equal",
      std::to_string(most) + " B in " + std::to_string(renderer.textures().vertex_layers()) + " layers");
  for (const Storage& storage : kStorages) {
    const Settings settings = storage.settings(64, 2);
    const ClipmapTextures textures(settings);
    EXPECT_EQ(textures.layer_bytes(), layer_formula(settings));
    hard::report("memory", "bytes of a layer at detail 64, " + storage.text(), "its formula",
                 std::to_string(textures.layer_bytes()));
  }
}

}  // namespace
