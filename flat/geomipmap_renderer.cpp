#include "flat/geomipmap_renderer.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <string>
#include <utility>

#include "flat/box.h"
#include "globe/render/ground_state.h"
#include "globe/render/view_block.h"

namespace globe::flat {
namespace {

constexpr std::size_t kKeptFrames = 60;  ///< that a patch out of view keeps its buffer
constexpr double kSunMoved = 1e-3;       ///< radians after which the lightmap is made anew
constexpr int kCloudTexels = 512;
constexpr double kCloudTile = 12'000.0;   ///< metres after which clouds repeat
constexpr double kCloudHeight = 3'000.0;  ///< above the frame's plane
constexpr double kCloudShade = 0.8;       ///< of the sunlight that the thickest keep off
constexpr double kLeastAbove = 0.1;       ///< metres: no camera counts as nearer to the ground

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

gl::Program ground_program(const GeomipmapSettings& settings, bool material, bool masked) {
  gl::ProgramSources sources;
  sources.files = {"flat/geomipmap.vert", "flat/geomipmap.frag"};
  sources.defines = {"HAZE_STEPS " + std::to_string(settings.air_steps.haze)};
  if (settings.morph == Morph::kGpu) sources.defines.emplace_back("MORPH");
  if (material) sources.defines.emplace_back("MATERIAL");
  if (masked) sources.defines.emplace_back("MASKED");
  if (settings.cloud_cover > 0.0) sources.defines.emplace_back("CLOUD_SHADOWS");
  return gl::Program(sources);
}

/// Column and row, whole, of the post nearest to a place, whether there is one or not.
glm::dvec2 nearest_post(const Terrain& terrain, const dvec3& at) {
  return {std::round((at.x - terrain.x_m(0)) / terrain.spacing_m()),
          std::round((at.y - terrain.y_m(0)) / terrain.spacing_m())};
}

int mip_levels(int side) {
  int levels = 1;
  while (side >> levels > 0) ++levels;
  return levels;
}

gl::Texture grey_texture(const std::vector<std::uint8_t>& texels, int width, int height, GLenum wrap) {
  gl::Texture texture = gl::Texture::flat(GL_R8, width, height, mip_levels(std::max(width, height)));
  texture.upload({0, 0, width, height}, texels.data());
  texture.set_filter(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
  texture.set_wrap(wrap);
  texture.generate_mipmaps();
  return texture;
}

gl::Texture lightmap_for(const Terrain& terrain) {
  const PostRect& posts = terrain.posts();
  gl::Texture texture =
      gl::Texture::flat(GL_RGBA8, posts.columns, posts.rows, mip_levels(std::max(posts.columns, posts.rows)));
  texture.set_filter(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR);
  texture.set_wrap(GL_CLAMP_TO_EDGE);
  return texture;
}

}  // namespace

GeomipmapRenderer::GeomipmapRenderer(std::shared_ptr<const Terrain> terrain, std::vector<glm::vec3> colors,
                                     const GeomipmapSettings& settings)
    : terrain_(std::move(terrain)),
      colors_(std::move(colors)),
      settings_(settings),
      instances_(terrain_->patch_count() * sizeof(Instance)),
      view_(sizeof(render::ViewBlock)),
      array_(gl::VertexArray::create()),
      lightmap_(lightmap_for(*terrain_)),
      active_(terrain_->patch_count()) {
  std::vector<std::uint16_t> indices;
  for (int shape = 0; shape < kShapes; ++shape) {
    const auto k = static_cast<std::size_t>(shape);
    const bool exists = shape / 16 + 1 < kLevels || shape % 16 == 0;
    const std::vector<std::uint16_t> of_shape = exists ? patch_indices(shape) : std::vector<std::uint16_t>{};
    first_index_[k] = indices.size();
    index_count_[k] = of_shape.size();
    indices.insert(indices.end(), of_shape.begin(), of_shape.end());
  }
  indices_ = gl::Buffer::of(indices);
  std::vector<std::uint8_t> posts;
  for (int level = 0; level < kLevels; ++level) {
    first_post_[static_cast<std::size_t>(level)] = posts.size() / 2;
    for (int row = 0; row <= kPatchCells; row += 1 << level) {
      for (int column = 0; column <= kPatchCells; column += 1 << level)
        posts.insert(posts.end(), {static_cast<std::uint8_t>(column), static_cast<std::uint8_t>(row)});
    }
  }
  posts_ = gl::Buffer::of(posts);
  using Kind = gl::Attribute::Kind;
  array_.set_attribute(0, {0, 2, GL_UNSIGNED_BYTE, 0, Kind::kInteger});
  const bool moves = settings_.morph == Morph::kGpu;
  array_.set_attribute(1, {1, 1, GL_FLOAT, moves ? static_cast<GLuint>(offsetof(PatchVertex, z)) : 0u});
  if (moves) {
    array_.set_attribute(1, {2, 1, GL_FLOAT, static_cast<GLuint>(offsetof(PatchVertex, self))});
    array_.set_attribute(1, {3, 4, GL_FLOAT, static_cast<GLuint>(offsetof(PatchVertex, side))});
    array_.set_attribute(1, {4, 4, GL_FLOAT, static_cast<GLuint>(offsetof(PatchVertex, both))});
  }
  array_.set_vertices(2, instances_, 0, sizeof(Instance), 1);
  array_.set_attribute(2, {5, 4, GL_INT, static_cast<GLuint>(offsetof(Instance, at)), Kind::kInteger});
  array_.set_attribute(2, {6, 4, GL_FLOAT, static_cast<GLuint>(offsetof(Instance, sides))});
  array_.set_attribute(2, {7, 1, GL_FLOAT, static_cast<GLuint>(offsetof(Instance, share))});
  array_.set_indices(indices_);
  if (!settings_.background) sky_.emplace(settings_.air, settings_.air_steps, no_effects_);
  make_passes();
}

void GeomipmapRenderer::make_passes() {
  const PostRect& posts = terrain_->posts();
  if (settings_.cloud_cover > 0.0) {
    const Tile tile = cloud_tile(kCloudTexels, settings_.cloud_cover, 5);
    clouds_ = grey_texture(tile.texels, tile.side, tile.side, GL_REPEAT);
  }
  if (settings_.materials.empty()) {
    passes_.emplace_back().program = ground_program(settings_, false, false);
    return;
  }
  for (Material& material : settings_.materials) {
    Pass& pass = passes_.emplace_back();
    pass.program = ground_program(settings_, true, !material.mask.empty());
    pass.tile = grey_texture(material.tile.texels, material.tile.side, material.tile.side, GL_REPEAT);
    if (!material.mask.empty())
      pass.mask = grey_texture(material.mask, posts.columns, posts.rows, GL_CLAMP_TO_EDGE);
    pass.u_row = material.u_row;
    pass.v_row = material.v_row;
    pass.in_patch = std::move(material.in_patch);
  }
  settings_.materials.clear();
}

std::size_t GeomipmapRenderer::inactive_patch_bytes() const {
  return sizeof(PatchSummary) + sizeof(levels_[0]) + sizeof(active_[0]) + (passes_.size() + 7) / 8;
}

double GeomipmapRenderer::height_above_ground(const glm::dvec3& position, bool /*wait*/) const {
  const dvec3 local = terrain_->frame().local_from_ecef(position);
  return local.z - terrain_->z_at(local.x, local.y);
}

double GeomipmapRenderer::nearest_drawn(const glm::dvec3& position, bool wait) const {
  return std::max(height_above_ground(position, wait), kLeastAbove);
}

void GeomipmapRenderer::warm_up(const gl::Framebuffer& target) {
  const PostRect& posts = terrain_->posts();
  const double x = terrain_->x_m(posts.columns / 2);
  const double y = terrain_->y_m(posts.rows / 2);
  render::Camera camera;
  camera.position =
      terrain_->frame().ecef_from_local({x, y, terrain_->z_at(x, y) + posts.columns * terrain_->spacing_m()});
  camera.forward = -terrain_->frame().axes()[2];
  camera.right = terrain_->frame().axes()[0];
  camera.up = terrain_->frame().axes()[1];
  draw(camera, lit_by_.value_or(terrain_->frame().axes()[2]), true, target);
}

void GeomipmapRenderer::begin_frame(const glm::dvec3& position, const glm::dvec3& sun, bool wait,
                                    double /*upload_ms*/) {
  stats_ = {};
  ++frame_;
  sun_ = sun;
  above_m_ = nearest_drawn(position, wait);
  if (lit_by_ && (wait ? *lit_by_ == sun : glm::distance(*lit_by_, sun) < kSunMoved)) return;
  lit_by_ = sun;
  const std::vector<glm::u8vec4> texels =
      settings_.show == render::Show::kNormals
          ? shown_normals(*terrain_)
          : light_posts(*terrain_, colors_, sun * terrain_->frame().axes(), settings_.shadows);
  lightmap_.upload({0, 0, lightmap_.width(), lightmap_.height()}, texels.data());
  lightmap_.generate_mipmaps();
  stats_.upload_bytes += texels.size() * sizeof(texels[0]);
}

void GeomipmapRenderer::find_visible(const render::Camera& camera, const dvec3& eye) {
  visible_.clear();
  const dmat3& axes = terrain_->frame().axes();
  const clipmap::Frustum frustum(camera.forward * axes, camera.right * axes, camera.up * axes, camera.tan_x(),
                                 camera.tan_y());
  for (std::size_t k = 0; k < terrain_->patch_count(); ++k) {
    if (settings_.culling && !is_in_view(frustum, patch_box(*terrain_, k), eye)) continue;
    if (settings_.visibility && !settings_.visibility->may_see(eye, k)) continue;
    visible_.push_back(k);
  }
}

void GeomipmapRenderer::make_ready(std::size_t patch, const PatchState& state) {
  if (!active_[patch]) {
    active_[patch] = std::make_unique<Active>();
    held_.push_back(patch);
  }
  Active& active = *active_[patch];
  active.last_frame = frame_;
  if (active.shape == state.shape()) return;
  active.shape = state.shape();
  std::vector<PatchVertex> vertices = patch_vertices(*terrain_, patch, state);
  switch (settings_.morph) {
    case Morph::kGpu:
      active.buffer = gl::Buffer::of(vertices);
      break;
    case Morph::kCpu:
      active.vertices = std::move(vertices);
      return;
    case Morph::kOff: {
      std::vector<float> z(vertices.size());
      std::transform(vertices.begin(), vertices.end(), z.begin(), [](const PatchVertex& v) { return v.z; });
      active.buffer = gl::Buffer::of(z);
      break;
    }
  }
  stats_.upload_bytes += active.buffer.size();
}

/// Every vertex in view, morphed by this program, once a frame.
void GeomipmapRenderer::upload_heights() {
  height_offsets_.clear();
  std::vector<float> z;
  for (std::size_t k = 0; k < visible_.size(); ++k) {
    height_offsets_.push_back(z.size() * sizeof(float));
    for (const PatchVertex& vertex : active_[visible_[k]]->vertices)
      z.push_back(morphed_z(vertex, states_[k]));
  }
  if (z.empty()) return;
  const std::size_t bytes = z.size() * sizeof(float);
  if (heights_.size() < bytes) heights_ = gl::Buffer(bytes + bytes / 2);
  heights_.upload(0, z.data(), bytes);
  stats_.upload_bytes += bytes;
}

void GeomipmapRenderer::draw_passes(const glm::vec4& overlay) {
  lightmap_.bind(2);
  if (settings_.cloud_cover > 0.0) clouds_.bind(6);
  array_.bind();
  for (const Pass& pass : passes_) {
    if (&pass != &passes_.front()) {
      glEnable(GL_BLEND);
      glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
      glDepthFunc(GL_EQUAL);
      glDepthMask(GL_FALSE);
    }
    pass.program.use();
    pass.program.set(4, overlay);
    pass.program.set(5, static_cast<int>(settings_.show));
    draw_patches(pass);
  }
  glDisable(GL_BLEND);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_TRUE);
}

void GeomipmapRenderer::draw_patches(const Pass& pass) {
  if (!pass.in_patch.empty()) {
    pass.tile.bind(3);
    if (pass.mask.width() > 0) pass.mask.bind(5);
    pass.program.set(6, pass.u_row);
    pass.program.set(7, pass.v_row);
  }
  for (std::size_t k = 0; k < visible_.size(); ++k) {
    if (!pass.in_patch.empty() && !pass.in_patch[visible_[k]]) continue;
    const auto shape = static_cast<std::size_t>(states_[k].shape());
    const auto level = static_cast<std::size_t>(states_[k].level);
    array_.set_vertices(0, posts_, first_post_[level] * 2, 2);
    if (settings_.morph == Morph::kCpu) {
      array_.set_vertices(1, heights_, height_offsets_[k], sizeof(float));
    } else {
      array_.set_vertices(1, active_[visible_[k]]->buffer, 0,
                          settings_.morph == Morph::kGpu ? sizeof(PatchVertex) : sizeof(float));
    }
    stats_.triangles += index_count_[shape] / 3;
    // OpenGL takes an offset into the bound buffer as a pointer.
    // NOLINTNEXTLINE(performance-no-int-to-ptr)
    const void* const first = reinterpret_cast<const void*>(first_index_[shape] * sizeof(std::uint16_t));
    glDrawElementsInstancedBaseInstance(GL_TRIANGLES, static_cast<GLsizei>(index_count_[shape]),
                                        GL_UNSIGNED_SHORT, first, 1, static_cast<GLuint>(k));
  }
}

/// What all passes know of the view. Posts are counted from the one nearest to the eye.
void GeomipmapRenderer::set_uniforms(const gl::Program& program, const render::Camera& camera) const {
  const Terrain& terrain = *terrain_;
  const dvec3 eye = terrain.frame().local_from_ecef(camera.position);
  const double spacing = terrain.spacing_m();
  const glm::dvec2 eye_post = nearest_post(terrain, eye);
  const glm::dvec2 eye_at(terrain.x_m(0) + eye_post.x * spacing, terrain.y_m(0) + eye_post.y * spacing);
  const auto eye_z = static_cast<float>(eye.z);
  program.set(0, glm::mat3(terrain.frame().axes()));
  program.set(1, glm::vec4(glm::dvec4(spacing, eye.x - eye_at.x, eye.y - eye_at.y,
                                      0.5 / terrain.frame().ellipsoid().mean_radius())));
  program.set(2, glm::vec4(eye_z, static_cast<float>(eye.z - static_cast<double>(eye_z)),
                           static_cast<float>(eye_at.x), static_cast<float>(eye_at.y)));
  const glm::dvec2 texels(terrain.posts().columns, terrain.posts().rows);
  program.set(3, glm::vec4(glm::dvec4((eye_post + 0.5) / texels, 1.0 / texels)));
  if (settings_.cloud_cover <= 0.0) return;
  // A shadow lies where the sun's ray through its cloud comes down.
  const dvec3 sun = sun_ * terrain.frame().axes();
  const glm::dvec2 aside = sun.z > 0.05 ? glm::dvec2(sun) / sun.z * kCloudHeight : glm::dvec2(0.0);
  const glm::dvec2 at = (aside - settings_.wind * instant_.time_s) / kCloudTile;
  program.set(8, glm::vec4(glm::dvec4(at - glm::floor(at), 1.0 / kCloudTile, kCloudShade)));
}

void GeomipmapRenderer::let_go() {
  const auto gone = std::remove_if(held_.begin(), held_.end(), [&](std::size_t patch) {
    if (active_[patch]->last_frame + kKeptFrames >= frame_) return false;
    active_[patch].reset();
    return true;
  });
  held_.erase(gone, held_.end());
}

void GeomipmapRenderer::draw_view(const render::Camera& camera, const gl::Framebuffer& target) {
  const auto begin = std::chrono::steady_clock::now();
  const Terrain& terrain = *terrain_;
  const dvec3 eye = terrain.frame().local_from_ecef(camera.position);
  const ErrorBound bound = error_bound(settings_.error_px, camera.fov_y_deg, camera.aspect, target.height());
  levels_ = settings_.lod ? patch_levels(terrain, eye, bound, settings_.morph)
                          : std::vector<float>(terrain.patch_count(), 0.0f);
  find_visible(camera, eye);
  states_.clear();
  std::vector<Instance> instances;
  const glm::ivec2 eye_post(nearest_post(terrain, eye));
  for (const std::size_t patch : visible_) {
    const auto east = static_cast<std::size_t>(terrain.patches_east());
    const PatchState& state =
        states_.emplace_back(patch_state(levels_, terrain.patches_east(), terrain.patches_north(), patch));
    make_ready(patch, state);
    instances.push_back(
        {{static_cast<int>(patch % east) * kPatchCells - eye_post.x,
          static_cast<int>(patch / east) * kPatchCells - eye_post.y, state.level, static_cast<int>(patch)},
         {state.side_morph[0], state.side_morph[1], state.side_morph[2], state.side_morph[3]},
         state.morph});
  }
  stats_.patches += visible_.size();
  stats_.cpu_ms += milliseconds_since(begin);
  if (settings_.morph == Morph::kCpu) upload_heights();
  if (!instances.empty()) instances_.upload(0, instances.data(), instances.size() * sizeof(Instance));
  stats_.upload_bytes += instances.size() * sizeof(Instance);

  const render::ViewBlock view =
      render::view_block(camera, terrain.frame().ellipsoid(), settings_.air, sun_,
                         render::near_distance(terrain.frame().ellipsoid(), above_m_));
  view_.upload(0, &view, sizeof(view));
  view_.bind_base(GL_UNIFORM_BUFFER, 0);
  if (sky_) sky_->prepare();
  render::begin_ground(target, settings_.cull_faces, settings_.background.value_or(glm::vec3(0.0f)));

  for (const Pass& pass : passes_) set_uniforms(pass.program, camera);
  render::draw_wired(settings_.wireframe, [&](const glm::vec4& overlay) { draw_passes(overlay); });
  if (settings_.wireframe) stats_.triangles /= 2;  // drawn twice
  if (sky_) sky_->draw(view, 0, render::Serving::kItsSet);
  let_go();
  stats_.gpu_bytes = lightmap_.bytes() + heights_.size() + instances_.size() + indices_.size();
  for (const std::size_t patch : held_) stats_.gpu_bytes += active_[patch]->buffer.size();
  stats_.finest_level =
      levels_.empty() ? 0 : static_cast<int>(*std::min_element(levels_.begin(), levels_.end()));
}

}  // namespace globe::flat
