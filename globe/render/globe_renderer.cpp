#include "globe/render/globe_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <string>
#include <utility>

#include "globe/clipmap/ground_below.h"
#include "globe/render/ground_program.h"
#include "globe/render/ground_state.h"
#include "globe/render/region_below.h"
#include "globe/render/tone.h"
#include "globe/render/view_block.h"

namespace globe::render {
namespace {

constexpr double kSunMoved =
    1e-3;  ///< radians (0.06 degrees) after which frames in real time light the ground anew

Camera camera_over(const Room& room, const geo::Ellipsoid& ellipsoid) {
  Camera camera;
  camera.position = room.origin + ellipsoid.a * room.axes[2];
  camera.forward = -room.axes[2];
  camera.right = room.axes[0];
  camera.up = room.axes[1];
  return camera;
}

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

GlobeRenderer::GlobeRenderer(std::shared_ptr<const planet::Surface> surface, const RenderSettings& settings,
                             std::vector<NamedEffect> effects, std::unique_ptr<RegionRenderer> region)
    : surface_(std::move(surface)),
      settings_(settings),
      effects_(std::move(effects)),
      switched_off_(effects_.size()),
      effect_shaders_(effects_),
      verdicts_(effects_.size()),
      patches_(settings.clipmap),
      view_(sizeof(ViewBlock)),
      region_(std::move(region)),
      loader_(settings.clipmap, surface_, settings.max_level, settings.load_ahead) {
  make_ground_programs();
  if (!settings_.background) sky_.emplace(has_air(surface_->info()), settings_.air, effect_shaders_);
  if (effect_shaders_.may_keep_light()) light_.emplace();
  for (const NamedEffect& named : effects_) {
    named.effect->compile(effect_host());
    if (auto coloring = named.effect->coloring()) coloring_ = std::move(coloring);
  }
  if (region_) region_->compile(effect_host(), coloring_.get());
}

void GlobeRenderer::make_ground_programs() {
  const bool tinted = settings_.show != Show::kGround || settings_.wireframe;
  for (std::size_t k = 0; k < kLooks.size(); ++k)
    ground_[k] = {ground_sources(kLooks[k], textures(), tinted, settings_.air.haze), effect_shaders_};
  for (std::size_t k = 0; region_ && k < kLooks.size(); ++k)
    around_[k] = {ground_sources(kLooks[k], textures(), tinted, settings_.air.haze, true), effect_shaders_};
}

void GlobeRenderer::show_as(Show show, bool wireframe, bool cull_patches) {
  settings_.cull_patches = cull_patches;
  if (show == settings_.show && wireframe == settings_.wireframe) return;
  settings_.show = show;
  settings_.wireframe = wireframe;
  make_ground_programs();
}

bool GlobeRenderer::moves() const {
  for (std::size_t k = 0; k < effects_.size(); ++k) {
    if (verdicts_[k].active && effects_[k].effect->moves()) return true;
  }
  return false;
}

bool GlobeRenderer::colors_ground(const std::string& name) const {
  return std::any_of(effects_.begin(), effects_.end(), [&](const NamedEffect& named) {
    return named.name == name && named.effect->coloring() != nullptr;
  });
}

void GlobeRenderer::switch_effect(const std::string& name, bool on) {
  for (std::size_t k = 0; k < effects_.size(); ++k) {
    if (effects_[k].name == name) switched_off_[k] = !on;
  }
}

double GlobeRenderer::height_above_ground(const glm::dvec3& position, bool wait) const {
  return render::height_above_ground(settings_.clipmap, *surface_, position, settings_.max_level, wait,
                                     region_ ? region_->below(position) : RegionBelow{});
}

double GlobeRenderer::nearest_drawn(const glm::dvec3& position, bool wait) const {
  return clipmap::nearest_drawn(*surface_, position, height_above_ground(position, wait));
}

void GlobeRenderer::warm_up(const gl::Framebuffer& target) {
  // Software drivers compile a program at its first draw: draw a patch with each, and whatever the first view
  // needs otherwise.
  Camera camera;
  camera.position = glm::dvec3(4.0 * surface_->ellipsoid().a, 0.0, 0.0);
  camera.forward = glm::dvec3(-1, 0, 0);
  camera.right = glm::dvec3(0, 1, 0);
  camera.up = glm::dvec3(0, 0, 1);
  draw(camera, glm::dvec3(1, 0, 0), true, target);
  DrawList list = make_draw_list(settings_.clipmap, state(), textures(), surface_->ellipsoid(), camera,
                                 {settings_.clipmap.base_level, 0.0f}, true);
  std::vector<Batch> batches;
  batches.reserve(2 * kLooks.size());
  for (const RoomSide side : {RoomSide::kOutside, RoomSide::kAcross}) {
    for (const Look& look : kLooks) {
      if (side == RoomSide::kAcross && !region_) continue;
      batches.push_back(
          {look, look.kind == Kind::kRim ? 1 : 0, 0, false, side, {list.batches.front().instances.front()}});
    }
  }
  list.batches = std::move(batches);
  for (const NamedEffect& named : effects_) named.effect->warm_up();
  // Of the sets of effects: those of such a view, none, and whatever a frame in real time meets.
  const ViewBlock view = view_block(camera, *surface_, sun_, near_distance(surface_->ellipsoid(), above_m_));
  const int seen = active_;
  target.bind();
  for (const auto& [active, serving] :
       {std::pair(seen, Serving::kItsSet), std::pair(0, Serving::kItsSet), std::pair(0, Serving::kAny)}) {
    active_ = active;
    serving_ = serving;
    if (region_) draw_region(camera_over(region_->room(), surface_->ellipsoid()), view, target.height());
    draw_ground(list);
    if (sky_) sky_->draw(view, active_, serving_);
  }
}

void GlobeRenderer::begin_frame(const glm::dvec3& position, const glm::dvec3& sun, bool wait,
                                double upload_ms) {
  stats_ = {};
  verdicts_.assign(effects_.size(), {});
  sun_ = sun;
  auto begin = std::chrono::steady_clock::now();
  above_m_ = nearest_drawn(position, wait);
  double away_m = above_m_;  // from the ground that this renderer draws
  if (region_) {
    region_->begin_frame(sun, wait);
    stats_.upload_bytes += region_->upload_bytes();
    const glm::dvec4 inside = region_->room().inside_m(position);
    away_m = std::max(away_m, std::min({inside.x, inside.y, inside.z, inside.w}));
  }
  const auto finest =
      clipmap::finest_level(settings_.clipmap, surface_->root_edge(), away_m, settings_.max_level);
  const geo::Geodetic place = geo::geodetic_from_ecef(surface_->ellipsoid(), position);
  clipmap::Target wanted{geo::normal_from_degrees(place.lat_deg, place.lon_deg),
                         finest.level,
                         {sun, settings_.show == Show::kNormals, coloring_}};
  // Frames in real time keep the light they have while the sun stands still, near enough.
  if (!wait && loader_.state() && glm::distance(sun, state().target.lighting.sun) < kSunMoved &&
      wanted.lighting.normals == state().target.lighting.normals)
    wanted.lighting = state().target.lighting;
  const bool whole = wait || !loader_.state();
  serving_ = whole ? Serving::kItsSet : Serving::kCompiled;
  const Loader::Uploaded uploaded =
      whole ? loader_.load_whole(wanted) : loader_.load_some(wanted, above_m_, upload_ms);
  if (whole) begin = std::chrono::steady_clock::now();
  stats_.upload_bytes += uploaded.bytes;
  stats_.upload_ms = uploaded.ms;
  stats_.queued_jobs = loader_.queued_jobs();
  stats_.queued_bytes = textures().queued_bytes();
  stats_.gpu_bytes = textures().bytes();

  if (wait) admission_.show(finest);
  shown_ = wait ? finest : admission_.next(finest, state().target.finest);
  if (!settings_.clipmap.morph) shown_ = {std::min(finest.level, state().target.finest), 0.0f};
  stats_.finest_level = shown_.level;
  stats_.fade = shown_.fade;
  const int levels = finest.level - settings_.clipmap.base_level + 1;
  const int ready = std::min(clipmap::levels_ready(settings_.clipmap, state(), wanted),
                             shown_.level - settings_.clipmap.base_level + 1);
  stats_.completeness = static_cast<double>(ready) / levels;
  stats_.complete = ready == levels && shown_.fade == finest.fade;
  stats_.cpu_ms = milliseconds_since(begin) - (whole ? 0.0 : stats_.upload_ms);
}

void GlobeRenderer::draw_view(const Camera& camera, const gl::Framebuffer& target) {
  const auto begin = std::chrono::steady_clock::now();
  const ViewBlock view = view_block(camera, *surface_, sun_, near_distance(surface_->ellipsoid(), above_m_));
  const DrawList list = make_draw_list(settings_.clipmap, state(), textures(), surface_->ellipsoid(), camera,
                                       shown_, settings_.cull_patches, region_ ? &region_->room() : nullptr);
  stats_.cpu_ms += milliseconds_since(begin);
  stats_.patches += list.patches;

  view_.upload(0, &view, sizeof(view));
  view_.bind_base(GL_UNIFORM_BUFFER, 0);
  const double height_m = geo::geodetic_from_ecef(surface_->ellipsoid(), camera.position).h_m;
  const EffectHost host = effect_host();
  EffectView effect_view{host,     camera, view,     *surface_, list, target,
                         instant_, sun_,   height_m, above_m_,  {},   0};
  for (std::size_t k = 0; k < effects_.size(); ++k) {
    if (switched_off_[k]) continue;
    if (const auto water_m = effects_[k].effect->water_height_m(effect_view)) effect_view.water_m = water_m;
  }
  effect_view.active = active_ = prepare_effects(effect_view);
  const bool keep_light = (active_ & EffectShaders::kKeepLight) != 0;
  const gl::Framebuffer& picture = keep_light ? light_->in_place_of(target) : target;
  if (sky_) sky_->prepare();

  const glm::vec3 shown = settings_.background.value_or(glm::vec3(0.0f));
  begin_ground(picture, settings_.cull_faces, keep_light ? light_shown_as(shown) : shown);
  if (region_) draw_region(camera, view, target.height());
  draw_ground(list);
  if (sky_) sky_->draw(view, active_, serving_);
  if (!keep_light) return;
  const EffectView light_view{host, camera,   view,     *surface_,           list,    picture, instant_,
                              sun_, height_m, above_m_, effect_view.water_m, active_, serving_};
  for (const Stage stage : {Stage::kHeavens, Stage::kSurface, Stage::kLayer, Stage::kLens}) {
    if (stage == Stage::kSurface || !settings_.background) draw_passes(light_view, stage);
  }
  light_->show(target);
}

int GlobeRenderer::prepare_effects(const EffectView& view) {
  int active = 0;
  for (std::size_t k = 0; k < effects_.size(); ++k) {
    Effect& effect = *effects_[k].effect;
    Verdict verdict = switched_off_[k] ? Verdict{false, "switched off"} : effect.judge(view);
    if (verdict.active) {
      active |= 1 << k;
      if (effect.stage() != Stage::kNone) active |= EffectShaders::kKeepLight;
      effect.prepare(view, effect_shaders_.bindings(k));
    }
    if (!verdicts_[k].active) verdicts_[k] = std::move(verdict);
  }
  return active;
}

void GlobeRenderer::draw_passes(const EffectView& view, Stage stage) {
  for (std::size_t k = 0; k < effects_.size(); ++k) {
    if (effects_[k].effect->stage() != stage || (active_ >> k & 1) == 0) continue;
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_GEQUAL);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    effects_[k].effect->draw(view);
  }
  glDisable(GL_BLEND);
}

EffectHost GlobeRenderer::effect_host() const {
  return {effect_shaders_, textures(), patches_, settings_.air};
}

std::vector<EffectState> GlobeRenderer::effect_states() const {
  std::vector<EffectState> states;
  for (std::size_t k = 0; k < effects_.size(); ++k) {
    const Effect& effect = *effects_[k].effect;
    states.push_back({effects_[k].name, verdicts_[k], effect.gpu_bytes(), effect.passes(),
                      !effect.shader().file.empty() || !effect.shader().replaced.empty()});
  }
  return states;
}

void GlobeRenderer::draw_ground(const DrawList& list) {
  patches_.upload(list);
  stats_.triangles += patches_.triangles(list);
  draw_wired(settings_.wireframe, [&](const glm::vec4& overlay) { draw_batches(list, overlay); });
}

void GlobeRenderer::draw_batches(const DrawList& list, const glm::vec4& overlay) {
  patches_.draw(list, textures(), [&](const Batch& batch) -> const gl::Program* {
    if (batch.room == RoomSide::kInside) return nullptr;
    const gl::Program& program = program_for(batch);
    if (settings_.show != Show::kGround || settings_.wireframe) {
      program.set(3, overlay);
      program.set(4, static_cast<int>(settings_.show));
    }
    return &program;
  });
}

const gl::Program& GlobeRenderer::program_for(const Batch& batch) {
  const auto k =
      static_cast<std::size_t>(std::find(kLooks.begin(), kLooks.end(), batch.look) - kLooks.begin());
  if (batch.room == RoomSide::kOutside) return ground_[k].for_active(active_, serving_);
  const gl::Program& program = around_[k].for_active(active_, serving_);
  program.set(5, glm::mat3(region_->room().axes));
  program.set(6, eye_in_room_);
  return program;
}

void GlobeRenderer::draw_region(const Camera& camera, const ViewBlock& view, int picture_height) {
  eye_in_room_ = glm::vec4(region_->room().inside_m(camera.position));
  region_->draw(
      {camera, view, settings_.clipmap, loader_.state(), shown_, picture_height, active_, serving_});
  stats_.triangles += region_->triangles();
  stats_.patches += region_->patches();
  stats_.gpu_bytes = textures().bytes() + region_->gpu_bytes();
}

}  // namespace globe::render
