#include "tests/bench/submission/ground_scene.h"

#include <epoxy/gl.h>

#include <utility>

#include "globe/clipmap/morph.h"
#include "globe/geo/sun.h"
#include "globe/planet/scenic.h"
#include "globe/render/view_block.h"

namespace bench {

namespace clipmap = globe::clipmap;
namespace geo = globe::geo;
namespace render = globe::render;

GroundScene::GroundScene(int detail, double above_m, double pitch_deg)
    : surface(globe::planet::Surface::builtin(1)),
      settings(clipmap::Settings::for_detail(detail)),
      mesh(clipmap::make_patch_mesh(settings.m)),
      textures(settings) {
  const globe::planet::ScenicView scenic = globe::planet::scenic_place(*surface);
  geo::Geodetic place = scenic.place;
  const glm::dvec3 u = geo::normal_from_degrees(place.lat_deg, place.lon_deg);
  const auto finest = clipmap::finest_level(settings, surface->root_edge(), above_m, 26);
  place.h_m = surface->drawn_height(surface->height(u, finest.level)) + above_m;
  const glm::dvec3 sun = geo::morning_sun(place.lon_deg);
  auto update =
      clipmap::advance(settings, *surface, {u, finest.level, {sun, false}}, nullptr, clipmap::Stride::kWhole);
  state = update.state;
  textures.apply(std::move(update));
  const render::Camera camera =
      render::make_camera(surface->ellipsoid(), place, scenic.heading_deg, pitch_deg, 60.0, 1280.0 / 720.0);
  list = render::make_draw_list(settings, *state, textures, surface->ellipsoid(), camera, finest, true);
  const render::ViewBlock block =
      render::view_block(camera, *surface, sun, render::near_distance(surface->ellipsoid(), above_m));
  view = globe::gl::Buffer(sizeof block, &block);
  slots = globe::gl::Buffer(render::kMaxSlots * sizeof(render::SlotBlock));
  slots.upload(0, list.slots.data(), list.slots.size() * sizeof(render::SlotBlock));
}

void GroundScene::begin_frame() const {
  view.bind_base(GL_UNIFORM_BUFFER, 0);
  slots.bind_base(GL_UNIFORM_BUFFER, 1);
  textures.bind();
  target.bind();
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);
  glEnable(GL_CULL_FACE);
  target.clear_color(0.0f, 0.0f, 0.0f, 1.0f);
  target.clear_depth(0.0f);
}

}  // namespace bench
