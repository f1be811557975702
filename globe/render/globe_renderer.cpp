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
#include "globe/clipmap/morph.h"
#include "globe/render/ground_program.h"
#include "globe/render/view_block.h"

namespace globe::render {
namespace {

constexpr std::size_t kMaxInstances = 32768;
constexpr double kSunMoved =
    1e-3;  ///< radians (0.06 degrees) after which frames in real time light the ground anew

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

GlobeRenderer::GlobeRenderer(std::shared_ptr<const planet::Surface> surface, const RenderSettings& settings)
    : surface_(std::move(surface)),
      settings_(settings),
      mesh_(clipmap::make_patch_mesh(settings.clipmap.m)),
      vertices_(gl::Buffer::of(mesh_.vertices)),
      instances_(kMaxInstances * sizeof(glm::ivec4)),
      view_(sizeof(ViewBlock)),
      slots_(kMaxSlots * sizeof(SlotBlock)),
      ground_array_(gl::VertexArray::create()),
      loader_(settings.clipmap, surface_, settings.max_level, settings.load_ahead) {
  std::vector<std::uint16_t> indices;
  for (std::size_t rim = 0; rim < 8; ++rim) {
    index_offset_[rim] = indices.size() * sizeof(std::uint16_t);
    indices.insert(indices.end(), mesh_.indices[rim].begin(), mesh_.indices[rim].end());
  }
  indices_ = gl::Buffer::of(indices);
  ground_array_.set_vertices(0, vertices_, 0, 2);
  ground_array_.set_attribute(0, {0, 2, GL_UNSIGNED_BYTE, 0, gl::Attribute::Kind::kInteger});
  ground_array_.set_vertices(1, instances_, 0, sizeof(glm::ivec4), 1);
  ground_array_.set_attribute(1, {1, 4, GL_INT, 0, gl::Attribute::Kind::kInteger});
  ground_array_.set_indices(indices_);
  const bool tinted = settings_.show != Show::kGround || settings_.wireframe;
  for (std::size_t k = 0; k < kLooks.size(); ++k)
    ground_[k] = ground_program(kLooks[k], textures(), tinted, settings_.air.haze);
  if (!settings_.background) sky_.emplace(has_air(surface_->info()), settings_.air);
}

double GlobeRenderer::height_above_ground(const glm::dvec3& position, bool wait) const {
  return clipmap::height_above_ground(settings_.clipmap, *surface_, position, settings_.max_level, wait);
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
                                 settings_.clipmap.base_level, 0.0f, true);
  std::vector<Batch> batches;
  batches.reserve(kLooks.size());
  for (const Look& look : kLooks) {
    batches.push_back({look, look.kind == Kind::kRim ? 1 : 0, 0, {list.batches.front().instances.front()}});
  }
  list.batches = std::move(batches);
  target.bind();
  draw_ground(list);
}

FrameStats GlobeRenderer::draw(const Camera& camera, const glm::dvec3& sun, bool wait,
                               const gl::Framebuffer& target, double upload_ms) {
  begin_frame(camera.position, sun, wait, upload_ms);
  draw_view(camera, target);
  return stats_;
}

void GlobeRenderer::begin_frame(const glm::dvec3& position, const glm::dvec3& sun, bool wait,
                                double upload_ms) {
  stats_ = {};
  sun_ = sun;
  auto begin = std::chrono::steady_clock::now();
  above_m_ =
      std::max(height_above_ground(position, wait), clipmap::least_above_ground(surface_->ellipsoid()));
  const auto finest =
      clipmap::finest_level(settings_.clipmap, surface_->root_edge(), above_m_, settings_.max_level);
  const geo::Geodetic place = geo::geodetic_from_ecef(surface_->ellipsoid(), position);
  clipmap::Target wanted{geo::normal_from_degrees(place.lat_deg, place.lon_deg),
                         finest.level,
                         {sun, settings_.show == Show::kNormals}};
  // Frames in real time keep the light they have while the sun stands still, near enough.
  if (!wait && loader_.state() && glm::distance(sun, state().target.lighting.sun) < kSunMoved)
    wanted.lighting = state().target.lighting;
  const bool whole = wait || !loader_.state();
  const Loader::Uploaded uploaded =
      whole ? loader_.load_whole(wanted) : loader_.load_some(wanted, above_m_, upload_ms);
  if (whole) begin = std::chrono::steady_clock::now();
  stats_.upload_bytes = uploaded.bytes;
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
                                       shown_.level, shown_.fade, settings_.cull_patches);
  stats_.cpu_ms += milliseconds_since(begin);
  stats_.patches += list.patches;

  view_.upload(0, &view, sizeof(view));
  view_.bind_base(GL_UNIFORM_BUFFER, 0);
  if (sky_) sky_->prepare();

  target.bind();
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);
  if (settings_.cull_faces) {
    glEnable(GL_CULL_FACE);
    glCullFace(GL_BACK);
    glFrontFace(GL_CCW);
  } else {
    glDisable(GL_CULL_FACE);
  }
  const glm::vec3 background = settings_.background.value_or(glm::vec3(0.0f));
  target.clear_color(background.r, background.g, background.b, 1.0f);
  target.clear_depth(0.0f);

  draw_ground(list);
  if (sky_) sky_->draw(view);
}

void GlobeRenderer::draw_ground(const DrawList& list) {
  slots_.upload(0, list.slots.data(), list.slots.size() * sizeof(SlotBlock));
  slots_.bind_base(GL_UNIFORM_BUFFER, 1);
  std::size_t first = 0;
  for (const Batch& batch : list.batches) {
    instances_.upload(first * sizeof(glm::ivec4), batch.instances.data(),
                      batch.instances.size() * sizeof(glm::ivec4));
    first += batch.instances.size();
    stats_.triangles +=
        batch.instances.size() * mesh_.indices[static_cast<std::size_t>(batch.rim)].size() / 3;
  }
  textures().bind();
  ground_array_.bind();
  if (settings_.wireframe) {
    draw_batches(list, glm::vec4(0.0f, 0.0f, 0.0f, 0.35f));
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    glEnable(GL_POLYGON_OFFSET_LINE);
    glPolygonOffset(1.0f, 1.0f);
    draw_batches(list, glm::vec4(1.0f, 1.0f, 1.0f, 0.75f));
    glDisable(GL_POLYGON_OFFSET_LINE);
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  } else {
    draw_batches(list, glm::vec4(0.0f));
  }
}

void GlobeRenderer::draw_batches(const DrawList& list, const glm::vec4& overlay) {
  const clipmap::Settings& c = settings_.clipmap;
  const clipmap::MorphBand band = clipmap::morph_band(c);
  std::size_t first = 0;
  const gl::Program* bound = nullptr;
  for (const Batch& batch : list.batches) {
    const gl::Program& program = ground_[static_cast<std::size_t>(
        std::find(kLooks.begin(), kLooks.end(), batch.look) - kLooks.begin())];
    if (bound != &program) {
      program.use();
      program.set(0, glm::ivec4(c.window(), band.begin, band.end, c.m));
      if (settings_.show != Show::kGround || settings_.wireframe) {
        program.set(3, overlay);
        program.set(4, static_cast<int>(settings_.show));
      }
      bound = &program;
    }
    if (batch.look.kind == Kind::kRim) program.set(2, batch.rim | batch.rim_corners << 3);
    const auto rim = static_cast<std::size_t>(batch.rim);
    // OpenGL takes an offset into the bound buffer as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
    const void* const first_index = reinterpret_cast<const void*>(index_offset_[rim]);
    glDrawElementsInstancedBaseInstance(
        GL_TRIANGLES, static_cast<GLsizei>(mesh_.indices[rim].size()), GL_UNSIGNED_SHORT, first_index,
        static_cast<GLsizei>(batch.instances.size()), static_cast<GLuint>(first));
    first += batch.instances.size();
  }
}

}  // namespace globe::render
